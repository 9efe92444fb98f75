/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/rkc/kk,FixFoamRKCKokkos<LMPDeviceType>);
FixStyle(foam/rkc/kk/device,FixFoamRKCKokkos<LMPDeviceType>);
FixStyle(foam/rkc/kk/host,FixFoamRKCKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_RKC_KOKKOS_H
#define LMP_FIX_FOAM_RKC_KOKKOS_H

#include "fix_foam_rkc.h"
#include "fix_foam_integrate_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixFoamRKCKokkos : public FixFoamIntegrateKokkos<FixFoamRKC, DeviceType> {
 public:
  FixFoamRKCKokkos(class LAMMPS *lmp, int narg, char **arg)
      : FixFoamIntegrateKokkos<FixFoamRKC, DeviceType>(lmp, narg, arg)
  {
    // well above the rounding of coordinates, else there is no telling how rates change

    if (std::is_same_v<KK_FLOAT, float>) this->scheme.spectral.displaced = 1.0e-2;
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
