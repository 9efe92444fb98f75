/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_foam_bubble_kokkos.h"

#include "memory_kokkos.h"
#include "update.h"

using namespace LAMMPS_NS;

template <class DeviceType>
ComputeFoamBubbleKokkos<DeviceType>::ComputeFoamBubbleKokkos(LAMMPS *lmp, int narg, char **arg)
    : ComputeFoamBubble(lmp, narg, arg), space(lmp, EMPTY_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = datamask_modify = EMPTY_MASK;
}

template <class DeviceType> ComputeFoamBubbleKokkos<DeviceType>::~ComputeFoamBubbleKokkos()
{
  memoryKK->destroy_kokkos(k_vector, vector);
  memoryKK->destroy_kokkos(k_array, array);
  vector = nullptr;
  array = nullptr;
}

template <class DeviceType> void ComputeFoamBubbleKokkos<DeviceType>::compute_peratom()
{
  invoked_peratom = update->ntimestep;

  const bool one = wanted.count == 1;
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    if (one) {
      memoryKK->destroy_kokkos(k_vector, vector);
      memoryKK->create_kokkos(k_vector, vector, nmax, "foam/bubble:vector");
    } else {
      memoryKK->destroy_kokkos(k_array, array);
      memoryKK->create_kokkos(k_array, array, nmax, wanted.count, "foam/bubble:array");
    }
    vector_atom = vector;
    array_atom = array;
  }

  gather();
  const auto mask = atomKK->k_mask.view<DeviceType>();
  atomKK->sync(execution_space, MASK_MASK);
  fill(space, mask, one ? k_vector.view<DeviceType>().data() : k_array.view<DeviceType>().data());
  if (one) {
    k_vector.modify<DeviceType>();
    k_vector.sync_host();
  } else {
    k_array.modify<DeviceType>();
    k_array.sync_host();
  }
}

namespace LAMMPS_NS {
template class ComputeFoamBubbleKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class ComputeFoamBubbleKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
