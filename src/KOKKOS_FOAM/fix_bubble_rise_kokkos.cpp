/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_rise_kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixBubbleRiseKokkos<DeviceType>::FixBubbleRiseKokkos(LAMMPS *lmp, int narg, char **arg)
    : FixBubbleRise(lmp, narg, arg), space(lmp, F_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = datamask_modify = EMPTY_MASK;    // the loops see to it
  space.groupbit = groupbit;
  space.keep(all_columns);
  foam_strip_suffix(style);
}

namespace LAMMPS_NS {
template class FixBubbleRiseKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixBubbleRiseKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
