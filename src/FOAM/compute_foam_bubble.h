/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(foam/bubble,ComputeFoamBubble);
// clang-format on
#else

#ifndef LMP_COMPUTE_FOAM_BUBBLE_H
#define LMP_COMPUTE_FOAM_BUBBLE_H

#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

// Per-bubble quantities of the present state, one column for each name given.

class ComputeFoamBubble : public Compute {
 public:
  ComputeFoamBubble(class LAMMPS *, int, char **);
  ~ComputeFoamBubble() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

 private:
  enum Quantity { CONTACTS, AREA, FREE, VFILM, VLIQUID, RDOT, ESPRING, EDURIAN };
  std::vector<Quantity> quantities;
  class PairDurianFoam *pair;
  class FixFoamCoarsen *gas;    // null: no gas is exchanged
  int nmax;
  double *vector;
  double **array;
};

}    // namespace LAMMPS_NS

#endif
#endif
