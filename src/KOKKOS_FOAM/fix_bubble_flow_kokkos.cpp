/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_flow_kokkos.h"

#include "fix_liquid_flow.h"

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

template <class DeviceType> void FixBubbleFlowKokkos<DeviceType>::advance(double dt)
{
  using B = typename FoamKokkos<DeviceType>::Bubbles;
  space.for_each(this->atom->nlocal,
                 Liquid::Advance<B>{space.bubbles(), FixLiquidFlow::of(this->lmp)->walls, dt});
}

template <class DeviceType> void FixBubbleFlowKokkos<DeviceType>::go_back()
{
  this->go_back_in(space);
}

template <class DeviceType> void FixBubbleFlowKokkos<DeviceType>::pre_exchange()
{
  if (this->next_reneighbor != this->update->ntimestep) return;
  foam_on_host(this->lmp, [&] { FixBubbleFlow::pre_exchange(); });
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
