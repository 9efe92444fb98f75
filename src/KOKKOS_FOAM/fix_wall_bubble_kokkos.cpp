/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_wall_bubble_kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixWallBubbleKokkos<DeviceType>::FixWallBubbleKokkos(LAMMPS *lmp, int narg, char **arg)
    : FoamTravellingKokkos<FixWallBubble, DeviceType>(lmp, narg, arg, F_MASK)
{
  space.groupbit = this->groupbit;
}

template <class DeviceType> void FixWallBubbleKokkos<DeviceType>::push()
{
  if (!this->at_region()) return this->push_in(space);
  host_reads();
  FixWallBubble::push();
  this->atomKK->modified(Host, F_MASK);
}

template <class DeviceType> void FixWallBubbleKokkos<DeviceType>::add_looks(FoamColumns &looks)
{
  if (!this->at_region()) return this->add_looks_in(space, looks);
  host_reads();
  FixWallBubble::add_looks(looks);
}

template <class DeviceType> void FixWallBubbleKokkos<DeviceType>::host_reads()
{
  this->atomKK->sync(Host, X_MASK | V_MASK | F_MASK | RADIUS_MASK | RMASS_MASK | TAG_MASK |
                               TYPE_MASK | MASK_MASK);
}

namespace LAMMPS_NS {
template class FixWallBubbleKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixWallBubbleKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
