/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/abm/kk,FixFoamABMKokkos<LMPDeviceType>);
FixStyle(foam/abm/kk/device,FixFoamABMKokkos<LMPDeviceType>);
FixStyle(foam/abm/kk/host,FixFoamABMKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_ABM_KOKKOS_H
#define LMP_FIX_FOAM_ABM_KOKKOS_H

#include "fix_foam_abm.h"
#include "fix_foam_integrate_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixFoamABMKokkos : public FixFoamIntegrateKokkos<FixFoamABM, DeviceType> {
 public:
  FixFoamABMKokkos(class LAMMPS *lmp, int narg, char **arg)
      : FixFoamIntegrateKokkos<FixFoamABM, DeviceType>(lmp, narg, arg)
  {
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
