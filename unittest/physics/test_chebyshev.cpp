// Coefficients of the Runge-Kutta-Chebyshev method: its stability, its order, its estimate of the error.

#include "foam_chebyshev.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <array>

using namespace Foam;

namespace {

const std::vector<int> COUNTS = {3, 4, 5, 6, 7, 8, 10, 13, 20, 37, 50, 100, 199, 200};

using One = std::array<double, 1>;
using Two = std::array<double, 2>;

template <class State> struct Step {
  std::vector<State> stages;    // Y_0 ... Y_s
  State estimate;
};

// one step of y' = f(y), as fix foam/rkc makes it

template <class State, class Function>
Step<State> step_of(const Chebyshev &c, double h, const State &start, Function f)
{
  const int s = c.count();
  const State rate = f(start);
  Step<State> step{std::vector<State>(s + 1, start), {}};
  for (size_t k = 0; k < start.size(); k++) step.stages[1][k] += h * c[1].rate_start * rate[k];
  for (int j = 2; j <= s; j++) {
    const State &last = step.stages[j - 1], now = f(last);
    for (size_t k = 0; k < start.size(); k++) {
      step.stages[j][k] =
          advance(start[k], last[k], step.stages[j - 2][k], now[k], rate[k], h, c[j]);
      if (j == s)
        step.estimate[k] = stage_error(start[k], last[k], now[k], rate[k], h, c[s - 1].place);
    }
  }
  return step;
}

// y' = z y from 1 with h = 1: the end, which is the stability polynomial at z, and the estimate

struct Linear {
  double end, estimate;
};
Linear linear(const Chebyshev &c, double z)
{
  const auto step = step_of(c, 1.0, One{1.0}, [=](const One &y) { return One{z * y[0]}; });
  return {step.stages.back()[0], step.estimate[0]};
}

}    // namespace

// ---------------------------------------------------------------------- coefficients

TEST(Chebyshev, StagesOfThreeInClosedForm)
{
  // T_2 = 2 w^2 - 1, T_3 = 4 w^3 - 3 w
  const double w = 1.0 + 1.0 / 9.0, w1 = (12.0 * w * w - 3.0) / (24.0 * w);
  const double b2 = 4.0 / (16.0 * w * w), first = 12.0 * w * w - 3.0;
  const double b3 = 24.0 * w / (first * first);
  const Chebyshev c(3);
  EXPECT_EQ(c.count(), 3);
  constexpr double ROUNDED = 20.0 * EPS;    // some ten operations
  EXPECT_NEAR(c[1].rate_start, b2 * w1, ROUNDED);
  EXPECT_NEAR(c[1].place, w1 / (4.0 * w * w), ROUNDED);    // so that y' = 1 has Y_1 = c_1 h
  EXPECT_NEAR(c[2].last, 2.0 * w, ROUNDED);
  EXPECT_NEAR(c[2].before, -1.0, ROUNDED);
  EXPECT_NEAR(c[2].rate, 2.0 * w1, ROUNDED);
  EXPECT_NEAR(c[2].rate_start, -(1.0 - b2 * w) * 2.0 * w1, ROUNDED);
  EXPECT_NEAR(c[2].place, w1 / w, ROUNDED);
  EXPECT_NEAR(c[3].last, 2.0 * b3 * w / b2, ROUNDED);
  EXPECT_NEAR(c[3].before, -b3 / b2, ROUNDED);
  EXPECT_NEAR(c[3].rate, 2.0 * b3 * w1 / b2, ROUNDED);
  EXPECT_NEAR(c[3].rate_start, -(1.0 - b2 * (2.0 * w * w - 1.0)) * 2.0 * b3 * w1 / b2, ROUNDED);
  EXPECT_NEAR(c[3].place, 1.0, ROUNDED);
}

TEST(Chebyshev, StagesAreInOrderAndTheLastIsTheEnd)
{
  for (int s = Chebyshev::FEWEST; s <= Chebyshev::MOST; s++) {
    const Chebyshev c(s);
    EXPECT_NEAR(c[s].place, 1.0, 1.0e-12);
    for (int j = 2; j <= s; j++) EXPECT_GT(c[j].place, c[j - 1].place) << s << " " << j;
    EXPECT_GT(c[1].place, 0.0);
    // without damping c_j = (j^2 - 1) / (s^2 - 1); damping moves it a little
    for (int j = 2; j <= s; j++)
      EXPECT_NEAR(c[j].place, (j * j - 1.0) / (s * s - 1.0), 0.029) << s << " " << j;
  }
}

TEST(Chebyshev, LinearRatesAreExactAtEveryStageButTheFirst)
{
  // (y, z) with y' = 1, z' = y
  constexpr double h = 0.7, ROUNDED = 1.0e-12;    // 200^2 EPS at most
  for (const int s : COUNTS) {
    const Chebyshev c(s);
    const auto step = step_of(c, h, Two{0.3, 0.2}, [](const Two &u) { return Two{1.0, u[0]}; });
    for (int j = 1; j <= s; j++) {
      const double t = h * c[j].place;
      const double second = j == 1 ? 0.0 : 0.5 * t * t;    // the first stage is Euler's
      EXPECT_NEAR(step.stages[j][0], 0.3 + t, ROUNDED) << s << " " << j;
      EXPECT_NEAR(step.stages[j][1], 0.2 + 0.3 * t + second, ROUNDED) << s << " " << j;
    }
    for (const double estimate : step.estimate) EXPECT_NEAR(estimate, 0.0, ROUNDED);
  }
}

// ---------------------------------------------------------------------- stability

// Up to stable(s) decaying components are damped: |P(z)| stays below 1 by the damping,
// 22 to 25 %, once z has left 0, where P = exp z

TEST(Chebyshev, StableUpToTheBound)
{
  for (int s = Chebyshev::FEWEST; s <= Chebyshev::MOST; s++) {
    const Chebyshev c(s);
    const double bound = Chebyshev::stable(s);
    double largest = 0.0, inside = 0.0;
    const int points = 20 * s;    // P has s - 2 minima and maxima
    for (int n = 0; n <= points; n++) {
      const double z = -bound * n / points;
      const double P = std::fabs(linear(c, z).end);
      largest = std::fmax(largest, P);
      if (z < -0.3) inside = std::fmax(inside, P);
    }
    EXPECT_LE(largest, 1.0) << s;
    EXPECT_LT(inside, 0.785) << s;
  }
}

TEST(Chebyshev, BoundIsNotGivenAway)
{
  // the polynomial leaves [-1, 1] within 27 % (s = 3) or 11 % (others) beyond
  for (const int s : COUNTS) {
    const Chebyshev c(s);
    const double beyond = -(s == 3 ? 1.27 : 1.11) * Chebyshev::stable(s);
    EXPECT_GT(std::fabs(linear(c, beyond).end), 1.0) << s;
  }
}

TEST(Chebyshev, FewestStagesThatAreStable)
{
  Samples samples(1);
  EXPECT_EQ(Chebyshev::count_for(0.0), Chebyshev::FEWEST);
  for (int n = 0; n < 1000; n++) {
    const double needed = samples.decades(1.0e-2, Chebyshev::stable(Chebyshev::MOST));
    const int s = Chebyshev::count_for(needed);
    EXPECT_GE(Chebyshev::stable(s), needed);
    EXPECT_TRUE(s == Chebyshev::FEWEST || Chebyshev::stable(s - 1) < needed);
  }
  for (int s = Chebyshev::FEWEST; s <= Chebyshev::MOST; s++)
    EXPECT_EQ(Chebyshev::count_for(Chebyshev::stable(s)), s);
  EXPECT_EQ(Chebyshev::count_for(1.0e9), Chebyshev::MOST);
  EXPECT_EQ(Chebyshev::count_for(INFINITY), Chebyshev::MOST);
}

// ---------------------------------------------------------------------- order of convergence

namespace {

// y' = -y^2 cos(t), y = 1 / (2 + sin t), with t as a component, since stages have times of their own

Two rate(const Two &u)
{
  return {1.0, -u[1] * u[1] * std::cos(u[0])};
}
Two solution(double t)
{
  return {t, 1.0 / (2.0 + std::sin(t))};
}

// orders are from h against h / 2; the next term of the error changes them by some h

constexpr double H = 4.0e-3, SAME_ORDER = 0.03;

double error_at(const Chebyshev &c, double h, int stage)    // of one step
{
  const double t = 0.4;
  return std::fabs(step_of(c, h, solution(t), rate).stages[stage][1] -
                   solution(t + h * c[stage].place)[1]);
}

double error_at_end(const Chebyshev &c, int steps)    // from t = 0 to 2
{
  Two u = solution(0.0);
  for (int n = 0; n < steps; n++) u = step_of(c, 2.0 / steps, u, rate).stages.back();
  return std::fabs(u[1] - solution(2.0)[1]);
}

}    // namespace

TEST(Chebyshev, PathIsOfOrderTwo)
{
  for (const int s : {3, 4, 5, 10, 50}) {
    const Chebyshev c(s);
    EXPECT_NEAR(std::log2(error_at_end(c, 200) / error_at_end(c, 400)), 2.0, SAME_ORDER) << s;
  }
}

TEST(Chebyshev, EveryStageIsOfOrderTwoAtItsTime)
{
  for (const int s : {3, 4, 5, 10, 50}) {
    const Chebyshev c(s);
    for (int j = 2; j <= s; j++) {
      const double h = H / c[j].place;    // early stages step less far
      EXPECT_NEAR(std::log2(error_at(c, h, j) / error_at(c, 0.5 * h, j)), 3.0, SAME_ORDER)
          << s << " " << j;
    }
    const double h = H / c[1].place;    // Euler
    EXPECT_NEAR(std::log2(error_at(c, h, 1) / error_at(c, 0.5 * h, 1)), 2.0, SAME_ORDER) << s;
  }
}

TEST(Chebyshev, EstimateIsOfOrderThreeWhichStepControlCountsOn)
{
  for (const int s : {3, 4, 5, 10, 50}) {
    const Chebyshev c(s);
    auto estimate = [&](double h) {
      return std::fabs(step_of(c, h, solution(0.4), rate).estimate[1]);
    };
    EXPECT_NEAR(std::log2(estimate(H) / estimate(0.5 * H)), 3.0, SAME_ORDER) << s;
  }
}

TEST(Chebyshev, EstimateIsUpToTwiceTheErrorOfSlowComponents)
{
  // y' = y: 1.82 (s = 5) to 2.00 (s = 3) times the error, 1.92 for many stages, as with the estimate
  // of [SSV98] at the end of the step
  for (int s = Chebyshev::FEWEST; s <= Chebyshev::MOST; s++) {
    const double h = -1.0e-2;    // rounding, s^2 EPS / h^3, is 1e-5 at most
    const Linear step = linear(Chebyshev(s), h);
    const double ratio = std::fabs(step.estimate / (step.end - std::exp(h)));
    EXPECT_GT(ratio, 1.8) << s;
    EXPECT_LT(ratio, 2.01) << s;
  }
}

TEST(Chebyshev, EstimateIsNotBelowTheErrorOfFastComponents)
{
  // A component that has died away adds nothing; one that has not is a reason for shorter steps
  for (const int s : COUNTS) {
    const Chebyshev c(s);
    for (int n = 1; n <= 1000; n++) {
      const double z = -Chebyshev::stable(s) * n / 1000;
      const Linear step = linear(c, z);
      EXPECT_GT(std::fabs(step.estimate), std::fabs(step.end - std::exp(z))) << s << " " << z;
    }
  }
}

// ---------------------------------------------------------------------- invariants

TEST(Chebyshev, LinearInvariantIsKept)
{
  // Rates of two components that cancel keep the sum, whatever the steps: so it is with gas
  Samples samples(2);
  for (const int s : COUNTS) {
    const Chebyshev c(s);
    Two y{0.7, 0.3};
    for (int n = 1; n <= 20; n++) {
      const auto step = step_of(c, samples.decades(1.0e-3, 0.1), y, [](const Two &u) {
        const double rate = std::sin(9.0 * u[0]);
        return Two{rate, -rate};
      });
      // rounding adds up as the square of the number of stages at most, [SSV98] section 2
      for (const Two &stage : step.stages)
        EXPECT_NEAR(stage[0] + stage[1], 1.0, n * s * s * EPS) << s << " " << n;
      y = step.stages.back();
    }
  }
}
