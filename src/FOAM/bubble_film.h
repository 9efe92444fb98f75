/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_FILM_H
#define LMP_BUBBLE_FILM_H

#include "bubble_physics.h"

#include <vector>

// The integral of the viscous force in a film that grows, for which [H17] give a fit.
//
// A flat film of radius a and thickness h ends in a rim whose profile is a quarter of a circle of the bubble's radius:
// at the distance y from the film the gap is h + 1 - sqrt(1 - y^2), 0 < y < 1 (lengths in R).  While a grows, the rim moves
// outward as it is.  It so displaces, between the film and y, the liquid
//
//   q = 2 pi integral_0^y (a + z) z / sqrt(1 - z^2) dz = pi [asin y - y sqrt(1 - y^2) + 2 a (1 - sqrt(1 - y^2))]
//
// for each unit of a.  It leaves through a ring of circumference 2 pi (a + y) and dissipates (6 mu / pi) (da/dt)^2 I,
//
//   I = integral_0^1 q^2 / [(a + y) (h + 1 - sqrt(1 - y^2))^3] dy.

namespace Bubble {

// With y = sin t; the integrand is smooth but on the scale t ~ sqrt(h), hence equal steps in asinh(t / sqrt(h)).

inline double film_integral(double h, double a, int steps = 400)
{
  const double scale = std::sqrt(2.0 * h), end = std::asinh(0.5 * PI / scale);
  auto integrand = [&](double s) {
    const double t = scale * std::sinh(s), y = std::sin(t),
                 low = 2.0 * std::pow(std::sin(0.5 * t), 2);
    if (!(t > 0.0)) return 0.0;
    // t - sin t cos t, without cancellation where t is small
    const double square = t * t;
    const double bulge =
        t < 0.1 ? t * square * (2.0 / 3.0 - square * (2.0 / 15.0 - square * 4.0 / 315.0))
                : t - y * std::cos(t);
    const double q = PI * (bulge + 2.0 * a * low), width = h + low;
    return q * q / ((a + y) * width * width * width) * std::cos(t) * scale * std::cosh(s);
  };
  double sum = integrand(0.0) + integrand(end);    // Simpson's rule
  for (int n = 1; n < steps; n++) sum += (n % 2 ? 4.0 : 2.0) * integrand(end * n / steps);
  return sum * end / (3.0 * steps);
}

// ln I on a grid of ln h and the cube root of a, between which it is a bicubic.  Outside of the grid its edge is taken: h from
// 1e-7 to 1, a from 0 to 1.

struct FilmTable {
  static constexpr int NH = 65, NA = 49;
  static constexpr double FIRST = -16.2, LAST = 0.0;    // of ln h
  const double *first = nullptr;                        // [NH][NA]

  FOAM_FUNCTION static double h_of(int n)
  {
    return std::exp(FIRST + (LAST - FIRST) * n / (NH - 1));
  }
  FOAM_FUNCTION static double a_of(int m)
  {
    const double root = double(m) / (NA - 1);
    return root * root * root;
  }

  FOAM_FUNCTION double operator()(double h, double a) const
  {
    const Place row(NH, (std::log(h) - FIRST) / (LAST - FIRST)), column(NA, std::cbrt(a));
    double value = 0.0;
    for (int n = 0; n < 4; n++)
      for (int m = 0; m < 4; m++)
        value += row.weight[n] * column.weight[m] * first[(row.begin + n) * NA + column.begin + m];
    return std::exp(value);
  }

 private:
  struct Place {    // four nodes round a place, and the weights of the cubic through them
    int begin;
    double weight[4];
    FOAM_FUNCTION Place(int nodes, double part)
    {
      const double at = (part > 0.0 ? (part < 1.0 ? part : 1.0) : 0.0) * (nodes - 1);
      begin = static_cast<int>(at) - 1;
      if (begin < 0) begin = 0;
      if (begin > nodes - 4) begin = nodes - 4;
      const double t = at - begin;    // 0 .. 3
      weight[0] = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0;
      weight[1] = t * (t - 2.0) * (t - 3.0) / 2.0;
      weight[2] = -t * (t - 1.0) * (t - 3.0) / 2.0;
      weight[3] = t * (t - 1.0) * (t - 2.0) / 6.0;
    }
  };
};

inline std::vector<double> film_table()
{
  std::vector<double> table;
  for (int n = 0; n < FilmTable::NH; n++)
    for (int m = 0; m < FilmTable::NA; m++)
      table.push_back(std::log(film_integral(FilmTable::h_of(n), FilmTable::a_of(m))));
  return table;
}

}    // namespace Bubble

#endif
