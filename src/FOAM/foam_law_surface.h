/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAW_SURFACE_H
#define LMP_FOAM_LAW_SURFACE_H

#include "foam_law.h"

namespace Foam {

// The elastic force of a bubble in 3D that is deformed by Delta [Heitkam et al., J. Phys.: Condens. Matter 29, 124005
// (2017), eq. 9], with x = Delta / R and the surface tension SIGMA:
//   F = SIGMA R (18.5 x^2 + 2 x),  U = SIGMA R^2 (18.5 x^3 / 3 + x^2)
// Two bubbles are two elements in series, as two of Durian's springs are: the same force deforms both, Delta_i + Delta_j
// = overlap.  A wall (R_j = 0) does not deform.  With f = F / SIGMA,
//   Delta(f; R) = 2 f / (2 + s),  s = sqrt(4 + 74 f / R) = df / dDelta,
// so that f of the overlap is the root of a concave function.  Newton's method finds it from the sum of the limits for small
// and for large overlaps: to 1e-14 in four steps for radii up to 100 to 1, in fewer for like ones: see
// unittest/physics/test_laws.cpp.
//
// sigma0 of the pair's types does not enter, but for 0, which switches the pair off.

struct SurfaceLaw : ContactLaw {
  static constexpr const char *NAME = "surface";
  static constexpr std::array<LawParameter, 1> PARAMETERS{{{"SIGMA", 0.0}}};
  static constexpr bool ONLY_3D = true;
  double sigma;
  explicit SurfaceLaw(const double *parameters) : sigma(parameters[0]) {}

  double spring(double sigma0) const { return sigma0 > 0.0 ? sigma : 0.0; }

  FOAM_FUNCTION double force(double stiffness, double overlap, double Ri, double Rj) const
  {
    return stiffness > 0.0 ? sigma * reduced_force(overlap, Ri, Rj) : 0.0;
  }
  FOAM_FUNCTION double energy(double stiffness, double overlap, double Ri, double Rj) const
  {
    if (!(stiffness > 0.0)) return 0.0;
    const double f = reduced_force(overlap, Ri, Rj);
    return sigma * (energy_of_one(f, Ri) + (Rj > 0.0 ? energy_of_one(f, Rj) : 0.0));
  }

 private:
  FOAM_FUNCTION static double slope(double f, double R) { return std::sqrt(4.0 + 74.0 * f / R); }
  FOAM_FUNCTION static double deformed(double overlap, double R)    // f of Delta = overlap
  {
    return overlap * (18.5 * overlap / R + 2.0);
  }
  FOAM_FUNCTION static double reduced_force(double overlap, double Ri, double Rj)
  {
    if (!(Rj > 0.0)) return deformed(overlap, Ri);
    if (Ri == Rj) return deformed(0.5 * overlap, Ri);
    const double roots = std::sqrt(Ri) + std::sqrt(Rj);
    double f = overlap * (18.5 * overlap / (roots * roots) + 1.0);
    for (int step = 0; step < 4; step++) {
      const double si = slope(f, Ri), sj = slope(f, Rj);
      const double sum = 2.0 * f / (2.0 + si) + 2.0 * f / (2.0 + sj);
      const double change = (overlap - sum) / (1.0 / si + 1.0 / sj);
      f += change;
      if (std::fabs(change) < 1.0e-8 * f) break;    // its square is left
    }
    return f;
  }
  FOAM_FUNCTION static double energy_of_one(double f, double R)
  {
    const double x = 2.0 * f / (2.0 + slope(f, R)) / R;
    return R * R * x * x * (18.5 / 3.0 * x + 1.0);
  }
};

}    // namespace Foam

#endif
