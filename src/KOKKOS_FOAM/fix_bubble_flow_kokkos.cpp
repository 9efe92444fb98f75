/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_flow_kokkos.h"

#include "fix_liquid_flow.h"

#include "kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixBubbleFlowKokkos<DeviceType>::FixBubbleFlowKokkos(LAMMPS *lmp, int narg, char **arg)
    : FoamTravellingKokkos<FixBubbleFlow, DeviceType>(lmp, narg, arg, X_MASK | V_MASK)
{
  space.groupbit = this->groupbit;
}

template <class DeviceType> void FixBubbleFlowKokkos<DeviceType>::init()
{
  this->atomKK->sync(Host, RADIUS_MASK | MASK_MASK | TAG_MASK);
  FixBubbleFlow::init();
}

template <class DeviceType> void FixBubbleFlowKokkos<DeviceType>::initial_integrate(int)
{
  using B = typename FoamKokkos<DeviceType>::Bubbles;
  space.for_each(
      this->atom->nlocal,
      Liquid::Advance<B>{space.bubbles(), FixLiquidFlow::of(this->lmp)->walls, this->update->dt});
}

// Arrays that grow when a bubble is born bring the host's numbers along if they are known to be the last ones

template <class DeviceType> void FixBubbleFlowKokkos<DeviceType>::pre_exchange()
{
  if (this->next_reneighbor != this->update->ntimestep) return;
  AtomKokkos *const atoms = this->atomKK;
  int &auto_sync = this->lmp->kokkos->auto_sync;
  const int before = auto_sync;
  auto_sync = 1;
  atoms->sync(Host, ALL_MASK);
  atoms->modified(Host, ALL_MASK);
  FixBubbleFlow::pre_exchange();
  atoms->modified(Host, ALL_MASK);
  auto_sync = before;
}

template <class DeviceType> double FixBubbleFlowKokkos<DeviceType>::compute_vector(int n)
{
  this->atomKK->sync(Host, RADIUS_MASK | MASK_MASK);
  return FixBubbleFlow::compute_vector(n);
}

namespace LAMMPS_NS {
template class FixBubbleFlowKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixBubbleFlowKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
