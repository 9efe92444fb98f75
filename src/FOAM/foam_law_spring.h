/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAW_SPRING_H
#define LMP_FOAM_LAW_SPRING_H

#include "foam_law.h"

namespace Foam {

// Overlap spring [D95]: magnitude of the repulsion and its potential, with stiffness = sigma0 <R_in>,
//   F = stiffness overlap / (R_i + R_j),  U = stiffness overlap^2 / (2 (R_i + R_j))

struct SpringLaw : ContactLaw {
  static constexpr const char *NAME = "spring";
  static constexpr std::array<LawParameter, 0> PARAMETERS{};
  explicit SpringLaw(const double *) {}

  FOAM_FUNCTION double force(double stiffness, double overlap, double Ri, double Rj) const
  {
    return stiffness * overlap / (Ri + Rj);
  }
  FOAM_FUNCTION double energy(double stiffness, double overlap, double Ri, double Rj) const
  {
    return 0.5 * stiffness * overlap * overlap / (Ri + Rj);
  }
};

}    // namespace Foam

#endif
