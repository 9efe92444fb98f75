/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_liquid_flow_kokkos.h"

#include "fix_liquid_flow_loops.h"

#include "comm.h"
#include "error.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixLiquidFlowKokkos<DeviceType>::FixLiquidFlowKokkos(LAMMPS *lmp, int narg, char **arg)
    : FoamTravellingKokkos<FixLiquidFlow, DeviceType>(lmp, narg, arg, X_MASK | V_MASK)
{
  this->forward_comm_device = std::is_same_v<DeviceType, LMPDeviceType>;
  space.groupbit = this->groupbit;

  // The pressure is found to 1e-6 and better from differences of velocities

  if (!std::is_same_v<KK_FLOAT, double>)
    this->error->all(FLERR,
                     "Fix liquid/flow/kk needs a LAMMPS whose KOKKOS package has double precision, "
                     "KOKKOS_PREC=double: use the suffix off");
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::post_constructor()
{
  FoamTravellingKokkos<FixLiquidFlow, DeviceType>::post_constructor();
  this->atomKK->sync(Host, ALL_MASK);
  FixLiquidFlow::post_constructor();
}

template <class DeviceType>
const PairLiquidSPHKokkos<DeviceType> &FixLiquidFlowKokkos<DeviceType>::near() const
{
  return static_cast<const PairLiquidSPHKokkos<DeviceType> &>(*this->pair);    // init() has looked
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::look()
{
  this->look_in(space);
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::keep_pressure()
{
  this->keep_pressure_in(space);
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::advance(double dt)
{
  this->advance_in(space, dt);
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::order()
{
  foam_on_host(this->lmp, [&] { FixLiquidFlow::order(); });
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::gather(double dt)
{
  if (this->neighbor->ago == 0) make_owners();
  this->gather_in(space, near(), room_there, dt);
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::project(double dt)
{
  this->project_in(space, near(), room_there, dt);
}

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::move(double dt)
{
  this->move_in(space, dt);
}

template <class Numbers> static void make_room(Numbers &numbers, const char *name, size_t size)
{
  if (numbers.extent(0) >= size) return;
  numbers = {};    // before there is room for more
  numbers =
      Numbers(Kokkos::view_alloc(std::string(name), Kokkos::WithoutInitializing), size + size / 10);
}

template <class DeviceType>
auto FixLiquidFlowKokkos<DeviceType>::RoomThere::close(size_t rows, size_t width)
    -> Liquid::CloseRows<BY_ROWS>
{
  make_room(partners, "liquid/flow:partners", rows * width);
  make_room(sizes, "liquid/flow:sizes", rows);
  return {partners.data(), sizes.data(), rows, width};
}

template <class DeviceType>
auto FixLiquidFlowKokkos<DeviceType>::RoomThere::matrix(const Liquid::CloseRows<BY_ROWS> &close)
    -> Liquid::Matrix<BY_ROWS>
{
  make_room(entries, "liquid/flow:entries", close.rows * close.width);
  make_room(used, "liquid/flow:used", close.rows);
  return {close, entries.data(), used.data()};
}

template <class DeviceType> double FixLiquidFlowKokkos<DeviceType>::memory_usage()
{
  const RoomThere &its = room_there;
  return FixLiquidFlow::memory_usage() + sizeof(double) * double(its.entries.extent(0)) +
         sizeof(int) * double(its.partners.extent(0) + its.sizes.extent(0) + its.used.extent(0));
}

/* ----------------------------------------------------------------------
   columns of ghosts
------------------------------------------------------------------------- */

namespace {

struct SomeColumns {    // one after the other in memory
  double *first;
  size_t length;
  int count;
  FOAM_FUNCTION double &operator()(int c, int i) const { return first[c * length + i]; }
};

template <class List> struct PackColumns {
  static constexpr const char *NAME = "liquid: pack columns";
  SomeColumns all;
  List list;
  double *buf;
  int n;
  KOKKOS_INLINE_FUNCTION void operator()(int m) const
  {
    for (int c = 0; c < all.count; c++) buf[static_cast<size_t>(c) * n + m] = all(c, list(m));
  }
};
template <class List> PackColumns(SomeColumns, List, double *, int) -> PackColumns<List>;

struct UnpackColumns {
  static constexpr const char *NAME = "liquid: unpack columns";
  SomeColumns all;
  const double *buf;
  int first, n;
  FOAM_FUNCTION void operator()(int m) const
  {
    for (int c = 0; c < all.count; c++) all(c, first + m) = buf[static_cast<size_t>(c) * n + m];
  }
};

struct CopyColumns {
  static constexpr const char *NAME = "liquid: columns of ghosts";
  SomeColumns all;
  const int *owner;
  int nlocal;
  FOAM_FUNCTION void operator()(int n) const
  {
    const int o = owner[n];
    for (int c = 0; c < all.count; c++) all(c, nlocal + n) = all(c, o);
  }
};

struct OwnIndices {
  static constexpr const char *NAME = "liquid: own indices";
  double *column;
  FOAM_FUNCTION void operator()(int i) const { column[i] = i; }
};

struct TakeOwners {
  static constexpr const char *NAME = "liquid: owners of ghosts";
  const double *column;
  int *owner;
  int nlocal;
  FOAM_FUNCTION void operator()(int n) const { owner[n] = static_cast<int>(column[nlocal + n]); }
};

template <class Space> SomeColumns some(Space &space, FoamColumns &columns, int first, int count)
{
  return {space.column(columns, first), static_cast<size_t>(columns.rows()), count};
}

}    // namespace

// Indices go the way of all columns, also from ghost to ghost: as a vector of the solver, which is not in use now

template <class DeviceType> void FixLiquidFlowKokkos<DeviceType>::make_owners()
{
  owners_known = false;
  if (this->comm->nprocs > 1) return;
  const int nlocal = this->atom->nlocal, nghost = this->atom->nghost;
  if (static_cast<int>(owner.extent(0)) < nghost)
    owner = Kokkos::View<int *, DeviceType>("liquid/flow:owner", nghost + nghost / 5);
  space.for_all(nlocal, OwnIndices{space.column(this->vectors, 0)});
  send(this->vectors, 0, 1);
  space.for_all(nghost, TakeOwners{space.column(this->vectors, 0), owner.data(), nlocal});
  owners_known = true;
}

template <class DeviceType>
void FixLiquidFlowKokkos<DeviceType>::send(FoamColumns &columns, int first, int count)
{
  if (owners_known) {
    space.for_all(this->atom->nghost, CopyColumns{some(space, columns, first, count), owner.data(),
                                                  this->atom->nlocal});
  } else {
    FixLiquidFlow::send(columns, first, count);
    space.column(columns, first);    // back to where loops have it, if it went through the host
  }
}

template <class DeviceType>
int FixLiquidFlowKokkos<DeviceType>::pack_forward_comm_kokkos(int n, DAT::tdual_int_1d k_list,
                                                              DAT::tdual_double_1d &k_buf, int,
                                                              int *)
{
  space.for_all(n, PackColumns{some(space, *this->sent, this->sent_first, this->sent_count),
                               k_list.view<DeviceType>(), k_buf.view<DeviceType>().data(), n});
  return n * this->sent_count;
}

template <class DeviceType>
void FixLiquidFlowKokkos<DeviceType>::unpack_forward_comm_kokkos(int n, int first,
                                                                 DAT::tdual_double_1d &k_buf)
{
  space.for_all(n, UnpackColumns{some(space, *this->sent, this->sent_first, this->sent_count),
                                 k_buf.view<DeviceType>().data(), first, n});
}

namespace LAMMPS_NS {
template class FixLiquidFlowKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixLiquidFlowKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
