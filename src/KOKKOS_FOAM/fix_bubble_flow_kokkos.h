/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/flow/kk,FixBubbleFlowKokkos<LMPDeviceType>);
FixStyle(bubble/flow/kk/device,FixBubbleFlowKokkos<LMPDeviceType>);
FixStyle(bubble/flow/kk/host,FixBubbleFlowKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_FLOW_KOKKOS_H
#define LMP_FIX_BUBBLE_FLOW_KOKKOS_H

#include "fix_bubble_flow.h"
#include "foam_travelling_kokkos.h"

namespace LAMMPS_NS {

// Bubbles are born and taken out on the host

template <class DeviceType>
class FixBubbleFlowKokkos : public FoamTravellingKokkos<FixBubbleFlow, DeviceType> {
 public:
  FixBubbleFlowKokkos(class LAMMPS *, int, char **);
  void init() override;
  void advance(double dt) override;
  void go_back() override;
  void pre_exchange() override;
  double compute_vector(int) override;

 protected:
  using FoamTravellingKokkos<FixBubbleFlow, DeviceType>::space;
};

}    // namespace LAMMPS_NS

#endif
#endif
