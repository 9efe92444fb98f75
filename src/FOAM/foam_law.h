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

// A contact law: the repulsion of two bubbles along the line of their centres, from their overlap and the
// sum of their radii, and its potential.  It is a struct with
//   NAME                                 its word behind the keyword law of the pair style
//   PARAMETERS                           numbers that follow it
//   Law(const double *parameters)
//   force(stiffness, overlap, Rsum)      > 0 pushes apart; stiffness = sigma0 <R_in>
//   energy(stiffness, overlap, Rsum)     force = -d energy / dr, energy = 0 at contact
// in a file of its own, and stands in the list of foam_laws.h.  The loop over contacts takes it as a
// template argument, so that a law costs what its formula costs.

namespace Foam {

struct LawParameter {
  const char *name;
  double above;    // a number > above
};

// A law as the user has chosen it, with room for its parameters

struct LawChoice {
  static constexpr int MOST = 3;
  int index = 0;    // in the list of laws
  std::array<double, MOST> parameters{};
};

}    // namespace Foam

#endif
