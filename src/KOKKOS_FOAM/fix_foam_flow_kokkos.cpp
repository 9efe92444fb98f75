/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_flow_kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixFoamFlowKokkos<DeviceType>::FixFoamFlowKokkos(LAMMPS *lmp, int narg, char **arg)
    : FixFoamFlow(lmp, narg, arg), space(lmp, EMPTY_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = datamask_modify = EMPTY_MASK;
  space.keep(all_columns);
  foam_strip_suffix(style);
}

template <class DeviceType> void FixFoamFlowKokkos<DeviceType>::host_reads()
{
  atomKK->sync(Host, ALL_MASK);
}

template <class DeviceType> Foam::FlowTotals FixFoamFlowKokkos<DeviceType>::totals_there()
{
  return totals_in(space);
}

namespace LAMMPS_NS {
template class FixFoamFlowKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixFoamFlowKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
