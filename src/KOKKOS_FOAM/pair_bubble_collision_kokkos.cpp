/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_bubble_collision_kokkos.h"

#include "neigh_request.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

template <class DeviceType>
PairBubbleCollisionKokkos<DeviceType>::PairBubbleCollisionKokkos(LAMMPS *lmp)
    : PairBubbleCollision(lmp), space(lmp, F_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = X_MASK | V_MASK | F_MASK | RADIUS_MASK | TYPE_MASK | TAG_MASK;
  datamask_modify = F_MASK | ENERGY_MASK | VIRIAL_MASK;
  space.keep(all_columns);
}

template <class DeviceType> void PairBubbleCollisionKokkos<DeviceType>::init_style()
{
  PairBubbleCollision::init_style();
  if (!model.integral.first) return;
  using Here = Kokkos::View<double *, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>;
  table_there = Kokkos::View<double *, DeviceType>("bubble/collision:table", table.size());
  Kokkos::deep_copy(table_there, Here(table.data(), table.size()));
  model.integral.first = table_there.data();
}

template <class DeviceType>
const char *PairBubbleCollisionKokkos<DeviceType>::style_of_films() const
{
  return FoamKokkos<DeviceType>::SPACE == Device ? "bubble/films/kk" : "bubble/films/kk/host";
}

template <class DeviceType> void PairBubbleCollisionKokkos<DeviceType>::request_list()
{
  auto *const request = neighbor->add_request(this, NeighConst::REQ_NEWTON_OFF);
  request->set_kokkos_host(std::is_same_v<DeviceType, LMPHostType> &&
                           !std::is_same_v<DeviceType, LMPDeviceType>);
  request->set_kokkos_device(std::is_same_v<DeviceType, LMPDeviceType>);
}

template <class DeviceType> void PairBubbleCollisionKokkos<DeviceType>::take_list()
{
  atomKK->sync(execution_space, TAG_MASK);
  const auto near = comes_near(space.bubbles());
  foam_make_rows(space, FoamMakeRows::HalfList<DeviceType, decltype(near)>(list, near),
                 atomKK->k_tag.view<DeviceType>(), atom->nlocal, atom->nmax, 1, 0.0, false, rows);
}

template <class DeviceType> double PairBubbleCollisionKokkos<DeviceType>::memory_usage()
{
  return PairBubbleCollision::memory_usage() + bytes(rows);
}

namespace LAMMPS_NS {
template class PairBubbleCollisionKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class PairBubbleCollisionKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
