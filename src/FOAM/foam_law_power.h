/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAW_POWER_H
#define LMP_FOAM_LAW_POWER_H

#include "foam_law.h"

namespace Foam {

// A power of the overlap, delta = overlap / (R_i + R_j), with stiffness = sigma0 <R_in>:
//   F = stiffness delta^(ALPHA-1),  U = stiffness (R_i + R_j) delta^ALPHA / ALPHA
// ALPHA = 2 is the spring, 5/2 like Hertz' contact [O'Hern, Silbert, Liu, Nagel, Phys. Rev. E 68, 011306
// (2003), eq. 1; for emulsions Lacasse et al., Phys. Rev. Lett. 76, 3448 (1996)].

struct PowerLaw : ContactLaw {
  static constexpr const char *NAME = "power";
  static constexpr std::array<LawParameter, 1> PARAMETERS{
      {{"ALPHA", 1.0}}};    // no force at contact
  double alpha;
  explicit PowerLaw(const double *parameters) : alpha(parameters[0]) {}

  FOAM_FUNCTION double force(double stiffness, double overlap, double Ri, double Rj) const
  {
    return stiffness * std::pow(overlap / (Ri + Rj), alpha - 1.0);
  }
  FOAM_FUNCTION double energy(double stiffness, double overlap, double Ri, double Rj) const
  {
    return stiffness * (Ri + Rj) * std::pow(overlap / (Ri + Rj), alpha) / alpha;
  }
};

}    // namespace Foam

#endif
