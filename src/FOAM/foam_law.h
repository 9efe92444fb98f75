/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAW_H
#define LMP_FOAM_LAW_H

#include "foam_physics.h"

#include <array>
#include <cmath>

// A contact law: the force of two bubbles along the line of their centres, from their overlap and their radii, and
// its potential.  It is a struct, derived from ContactLaw, with
//   NAME                                 its word behind the keyword law of the pair style
//   PARAMETERS                           numbers that follow it
//   Law(const double *parameters)
//   force(stiffness, overlap, Ri, Rj)    > 0 pushes apart; stiffness = sigma0 <R_in>; the same for (Rj, Ri)
//   energy(stiffness, overlap, Ri, Rj)   force = -d energy / dr, energy = 0 where the force ends
// in a file of its own, and stands in the list of foam_laws.h.  The loop over contacts takes it as a
// template argument, so that a law costs what its formula costs.
//
// A wall does not deform: it is a partner with Rj = 0, whose surface the overlap is counted from.

namespace Foam {

struct LawParameter {
  const char *name;
  double limit;             // a number > limit
  bool or_equal = false;    // or >= limit
  bool allows(double value) const { return or_equal ? value >= limit : value > limit; }
};

// What most laws have in common

struct ContactLaw {
  static constexpr bool BEYOND = false;    // acts beyond contact: at r < range() (Ri + Rj)
  static constexpr bool ONLY_3D = false;
  FOAM_FUNCTION static constexpr double range() { return 1.0; }
  double spring(double sigma0) const
  {
    return sigma0;
  }    // force per overlap of like bubbles, its scale
};

// A law as the user has chosen it, with room for its parameters

struct LawChoice {
  static constexpr int MOST = 3;
  int index = 0;    // in the list of laws
  std::array<double, MOST> parameters{};
};

}    // namespace Foam

#endif
