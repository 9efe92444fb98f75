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
#include "foam_physics.h"

namespace Foam {

// Overlap spring [D95]

struct SpringLaw {
  static constexpr const char *NAME = "spring";
  static constexpr std::array<LawParameter, 0> PARAMETERS{};
  explicit SpringLaw(const double *) {}

  FOAM_FUNCTION double force(double stiffness, double overlap, double Rsum) const
  {
    return spring_force(stiffness, overlap, Rsum);
  }
  FOAM_FUNCTION double energy(double stiffness, double overlap, double Rsum) const
  {
    return spring_energy(stiffness, overlap, Rsum);
  }
};

}    // namespace Foam

#endif
