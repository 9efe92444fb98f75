/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAW_STICKY_H
#define LMP_FOAM_LAW_STICKY_H

#include "foam_law.h"

namespace Foam {

// The spring with an attractive shell [Koeze, Tighe, Phys. Rev. Lett. 121, 188002 (2018), eq. 1], with delta = overlap /
// (R_i + R_j), negative beyond contact, and stiffness = sigma0 <R_in>:
//   F = stiffness delta              for delta > -A
//     = -stiffness (delta + 2 A)     for -2 A < delta <= -A, and nothing beyond
//   U = stiffness (R_i + R_j) (delta^2 / 2 - A^2)  and  -stiffness (R_i + R_j) (delta + 2 A)^2 / 2
// The attraction is largest, A stiffness, where the two meet.  A = 0 is the spring.

struct StickyLaw : ContactLaw {
  static constexpr const char *NAME = "sticky";
  static constexpr std::array<LawParameter, 1> PARAMETERS{{{"A", 0.0, true}}};
  static constexpr bool BEYOND = true;
  double a;
  explicit StickyLaw(const double *parameters) : a(parameters[0]) {}

  FOAM_FUNCTION double range() const { return 1.0 + 2.0 * a; }

  FOAM_FUNCTION double force(double stiffness, double overlap, double Ri, double Rj) const
  {
    const double delta = overlap / (Ri + Rj);
    if (delta > -a) return stiffness * delta;
    return delta > -2.0 * a ? -stiffness * (delta + 2.0 * a) : 0.0;
  }
  FOAM_FUNCTION double energy(double stiffness, double overlap, double Ri, double Rj) const
  {
    const double delta = overlap / (Ri + Rj), unit = stiffness * (Ri + Rj);
    if (delta > -a) return unit * (0.5 * delta * delta - a * a);
    const double left = delta + 2.0 * a;
    return left > 0.0 ? -0.5 * unit * left * left : 0.0;
  }
};

}    // namespace Foam

#endif
