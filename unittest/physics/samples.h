// What the tests of the formulae share: reproducible random numbers, and the spacing of doubles.

#ifndef FOAM_TEST_SAMPLES_H
#define FOAM_TEST_SAMPLES_H

#include <cmath>
#include <limits>
#include <random>
#include <vector>

inline constexpr double EPS = std::numeric_limits<double>::epsilon();

class Samples {
 public:
  explicit Samples(unsigned seed) : engine(seed) {}

  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }

  // from low to high, every decade equally often

  double decades(double low, double high)
  {
    return std::exp(uniform(std::log(low), std::log(high)));
  }

 private:
  std::mt19937 engine;
};

#endif
