/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/coarsen/kk,FixFoamCoarsenKokkos<LMPDeviceType>);
FixStyle(foam/coarsen/kk/device,FixFoamCoarsenKokkos<LMPDeviceType>);
FixStyle(foam/coarsen/kk/host,FixFoamCoarsenKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_COARSEN_KOKKOS_H
#define LMP_FIX_FOAM_COARSEN_KOKKOS_H

#include "fix_foam_coarsen.h"
#include "foam_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType> class FixFoamCoarsenKokkos : public FixFoamCoarsen {
 public:
  FixFoamCoarsenKokkos(class LAMMPS *, int, char **);
  void post_constructor() override { foam_strip_suffix(style); }
  double critical_radius() override;

 protected:
  void take_out_dead() override;

 private:
  FoamKokkos<DeviceType> space;
  DAT::tdual_double_2d_lr k_buf;    // where packed bubbles go, to be forgotten
  DAT::tdual_int_1d k_dead, k_fill;

  bool all_on_device() const;
  void compact();
};

}    // namespace LAMMPS_NS

#endif
#endif
