/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(bubble/collision,ComputeBubbleCollision);
// clang-format on
#else

#ifndef LMP_COMPUTE_BUBBLE_COLLISION_H
#define LMP_COMPUTE_BUBBLE_COLLISION_H

#include "bubble_collision.h"
#include "compute.h"

#include <vector>

namespace LAMMPS_NS {

// The forces on each bubble by term, and its closest contact, in the present state

class ComputeBubbleCollision : public Compute {
 public:
  ComputeBubbleCollision(class LAMMPS *, int, char **);
  ~ComputeBubbleCollision() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

 private:
  enum { OF_LIQUID = Bubble::LOOKS };    // those before are the pair style's
  std::vector<int> wanted;               // numbers of quantities
  class PairBubbleCollision *pair = nullptr;
  int nmax = 0;
  double *vector = nullptr, **array = nullptr;
};

}    // namespace LAMMPS_NS

#endif
#endif
