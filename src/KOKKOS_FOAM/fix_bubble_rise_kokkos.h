/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/rise/kk,FixBubbleRiseKokkos<LMPDeviceType>);
FixStyle(bubble/rise/kk/device,FixBubbleRiseKokkos<LMPDeviceType>);
FixStyle(bubble/rise/kk/host,FixBubbleRiseKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_RISE_KOKKOS_H
#define LMP_FIX_BUBBLE_RISE_KOKKOS_H

#include "fix_bubble_rise.h"
#include "foam_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType> class FixBubbleRiseKokkos : public FixBubbleRise {
 public:
  FixBubbleRiseKokkos(class LAMMPS *, int, char **);

 protected:
  void act() override { act_in(space); }
  void fill_looks() override { fill_looks_in(space); }
  double kinetic() override { return kinetic_in(space); }
  void host_reads() override { atomKK->sync(Host, ALL_MASK); }

 private:
  FoamKokkos<DeviceType> space;
};

}    // namespace LAMMPS_NS

#endif
#endif
