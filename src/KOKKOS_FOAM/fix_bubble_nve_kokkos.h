/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/nve/kk,FixBubbleNVEKokkos<LMPDeviceType>);
FixStyle(bubble/nve/kk/device,FixBubbleNVEKokkos<LMPDeviceType>);
FixStyle(bubble/nve/kk/host,FixBubbleNVEKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_NVE_KOKKOS_H
#define LMP_FIX_BUBBLE_NVE_KOKKOS_H

#include "fix_bubble_nve.h"
#include "foam_travelling_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixBubbleNVEKokkos : public FoamTravellingKokkos<FixBubbleNVE, DeviceType> {
 public:
  FixBubbleNVEKokkos(class LAMMPS *, int, char **);

 protected:
  using FoamTravellingKokkos<FixBubbleNVE, DeviceType>::space;
  void take_predicted() override { this->take_predicted_in(space); }
  void give_back() override { this->give_back_in(space); }
  void advance() override { this->advance_in(space); }
  void finish() override { this->finish_in(space); }
};

}    // namespace LAMMPS_NS

#endif
#endif
