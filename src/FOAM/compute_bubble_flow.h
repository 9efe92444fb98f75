/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(bubble/flow,ComputeBubbleFlow);
// clang-format on
#else

#ifndef LMP_COMPUTE_BUBBLE_FLOW_H
#define LMP_COMPUTE_BUBBLE_FLOW_H

#include "compute_liquid_columns.h"

namespace LAMMPS_NS {

// What fix bubble/flow has found for each bubble

class ComputeBubbleFlow : public ComputeLiquidColumns {
 public:
  ComputeBubbleFlow(class LAMMPS *, int, char **);
  void init() override;

 protected:
  FoamColumns &columns(int place) override;
  int members() const override;

 private:
  class FixBubbleFlow *gas = nullptr;
};

}    // namespace LAMMPS_NS

#endif
#endif
