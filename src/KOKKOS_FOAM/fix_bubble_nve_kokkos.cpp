/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_nve_kokkos.h"

#include "error.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixBubbleNVEKokkos<DeviceType>::FixBubbleNVEKokkos(LAMMPS *lmp, int narg, char **arg)
    : FoamTravellingKokkos<FixBubbleNVE, DeviceType>(lmp, narg, arg, X_MASK | V_MASK | F_MASK)
{
  space.groupbit = this->groupbit;

  // A step moves a bubble by less than single precision can tell at the coordinates of a large box

  if (!std::is_same_v<KK_FLOAT, double>)
    this->error->all(FLERR,
                     "Fix bubble/nve/kk needs a LAMMPS whose KOKKOS package has double precision, "
                     "KOKKOS_PREC=double: use the suffix off");
}

namespace LAMMPS_NS {
template class FixBubbleNVEKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixBubbleNVEKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
