/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/bubble/kk,FixWallBubbleKokkos<LMPDeviceType>);
FixStyle(wall/bubble/kk/device,FixWallBubbleKokkos<LMPDeviceType>);
FixStyle(wall/bubble/kk/host,FixWallBubbleKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_WALL_BUBBLE_KOKKOS_H
#define LMP_FIX_WALL_BUBBLE_KOKKOS_H

#include "fix_wall_bubble.h"
#include "foam_travelling_kokkos.h"

namespace LAMMPS_NS {

// LAMMPS finds the surface of a region on the host: there, bubbles meet it

template <class DeviceType>
class FixWallBubbleKokkos : public FoamTravellingKokkos<FixWallBubble, DeviceType> {
 public:
  FixWallBubbleKokkos(class LAMMPS *, int, char **);
  void add_looks(FoamColumns &) override;

 protected:
  using FoamTravellingKokkos<FixWallBubble, DeviceType>::space;
  void push() override;

 private:
  void host_reads();
};

}    // namespace LAMMPS_NS

#endif
#endif
