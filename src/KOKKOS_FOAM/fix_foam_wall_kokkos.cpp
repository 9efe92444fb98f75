/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_wall_kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixFoamWallKokkos<DeviceType>::FixFoamWallKokkos(LAMMPS *lmp, int narg, char **arg)
    : FixFoamWall(lmp, narg, arg), space(lmp, F_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = datamask_modify = EMPTY_MASK;    // the loops see to it
  space.groupbit = groupbit;
  space.keep(all_columns);
}

template <class DeviceType> void FixFoamWallKokkos<DeviceType>::push()
{
  push_in(space);
}

template <class DeviceType> Foam::WallTotals FixFoamWallKokkos<DeviceType>::fetch()
{
  return totals.on_device ? space.fetch(totals.on_device) : totals.known;
}

template <class DeviceType> void FixFoamWallKokkos<DeviceType>::host_reads()
{
  atomKK->sync(Host, MASK_MASK);
}

namespace LAMMPS_NS {
template class FixFoamWallKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixFoamWallKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
