/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_START_H
#define LMP_FOAM_START_H

#include "foam_physics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

// The foam that a simulation starts from: sites, displacements, radii.  Every number of bubble n is drawn from a
// generator of its own, so that neither ranks nor order matter.

namespace Foam {

// Numbers n = 0, 1, ... of one bubble: the mixer of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014) of seed, bubble and n

class Draws {
  std::uint64_t key;
  FOAM_FUNCTION static std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  static constexpr std::uint64_t STEP = 0x9e3779b97f4a7c15u;

 public:
  FOAM_FUNCTION Draws(std::uint64_t seed, std::uint64_t bubble)
      : key(mix(mix(seed + STEP) + bubble * STEP))
  {
  }

  FOAM_FUNCTION double uniform(unsigned n) const    // in (0, 1), neither of them
  {
    return (static_cast<double>(mix(key + (n + 1) * STEP) >> 11) + 0.5) * 0x1.0p-53;
  }
  FOAM_FUNCTION double normal(unsigned n) const    // Box & Muller, of numbers n and n + 1
  {
    return std::sqrt(-2.0 * std::log(uniform(n))) * std::cos(2.0 * PI * uniform(n + 1));
  }
};

// the first of a bubble's numbers for each use

enum Draw : unsigned { SIZE = 0, PLACE = 2, DIRECTION = 5, LENGTH = 11 };

// Distribution of radii.  Its numbers are those of the command; mean and std are of radii as drawn, before those
// below the smallest are lifted to it.

struct Sizes {
  enum Kind { EQUAL, NORMAL, LOGNORMAL, BIDISPERSE, LISTED };
  Kind kind = NORMAL;
  double mean = 1.0;
  double std = 0.21;                  // NORMAL, LOGNORMAL
  double ratio = 1.4, share = 0.5;    // BIDISPERSE: large to small, and the chance to be large
  std::vector<double> listed;         // LISTED: radii
  double rmin = 0.1;                  // none below rmin * mean

  double radius(const Draws &draws, std::uint64_t bubble, std::uint64_t bubbles) const
  {
    const double R = drawn(draws, bubble, bubbles);
    return kind == LISTED ? R : std::max(R, rmin * mean);    // those of a file are as they are
  }

 private:
  double drawn(const Draws &draws, std::uint64_t bubble, std::uint64_t bubbles) const
  {
    switch (kind) {
      case EQUAL:
        return mean;
      case NORMAL:    // none is negative
        return std::abs(mean + std * draws.normal(SIZE));
      case LOGNORMAL: {    // ln R is normal, of variance s^2; its mean gives <R> = mean
        const double s2 = std::log1p(std * std / (mean * mean));
        return mean * std::exp(std::sqrt(s2) * draws.normal(SIZE) - 0.5 * s2);
      }
      case BIDISPERSE: {
        const double small = mean / (1.0 + share * (ratio - 1.0));
        return draws.uniform(SIZE) < share ? ratio * small : small;
      }
      case LISTED:    // each once if there are as many, else any of them
        if (listed.size() == bubbles) return listed[bubble];
        return listed[static_cast<size_t>(draws.uniform(SIZE) *
                                          static_cast<double>(listed.size()))];
    }
    return mean;
  }
};

// A grid of about so many sites in each dimension as the box's relative lengths have it: whole rows, with room for
// all bubbles.  Sites that stay empty are spread evenly.

struct Grid {
  std::int64_t bubbles, all = 1;
  std::int64_t sites[3] = {1, 1, 1};

  Grid(int dimension, std::int64_t bubbles, const double (&relative)[3]) : bubbles(bubbles)
  {
    const double n = static_cast<double>(bubbles);
    auto whole = [](double x) {
      return std::max<std::int64_t>(1, std::llround(std::ceil(x - 1.0e-9)));
    };
    auto rest = [](std::int64_t all, std::int64_t part) {
      return (all + part - 1) / part;
    };
    const double x = relative[0], y = relative[1], z = relative[2];
    if (dimension == 2) {
      sites[0] = whole(std::sqrt(n * x / y));
      sites[1] = rest(bubbles, sites[0]);
    } else {
      sites[0] = whole(std::cbrt(n * x * x / (y * z)));
      sites[1] = whole(std::cbrt(n * y * y / (x * z)));
      sites[2] = rest(bubbles, sites[0] * sites[1]);
    }
    all = sites[0] * sites[1] * sites[2];
  }

  double centre(int k, std::int64_t bubble) const    // of its site, in spacings
  {
    std::int64_t site = bubble * all / bubbles;
    for (int j = 0; j < k; j++) site /= sites[j];
    return static_cast<double>(site % sites[k]) + 0.5;
  }
};

// By how much a bubble is off its site, in halves of a site: in any direction, by a length uniform in (0, 1)

inline void displacement(int dimension, const Draws &draws, double (&by)[3])
{
  double squared = 0.0;
  for (int k = 0; k < 3; k++) {
    by[k] = k < dimension ? draws.normal(DIRECTION + 2 * k) : 0.0;
    squared += by[k] * by[k];
  }
  const double length = draws.uniform(LENGTH) / std::sqrt(squared);
  for (double &one : by) one *= length;
}

}    // namespace Foam

#endif
