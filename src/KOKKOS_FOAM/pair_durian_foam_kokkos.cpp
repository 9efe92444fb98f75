/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_durian_foam_kokkos.h"

#include "foam_contact_loops.h"
#include "foam_pass_kokkos.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "kokkos.h"
#include "memory_kokkos.h"
#include "modify.h"
#include "neigh_request.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

template <class DeviceType>
PairDurianFoamKokkos<DeviceType>::PairDurianFoamKokkos(LAMMPS *lmp)
    : PairDurianFoam(lmp), space(lmp, F_MASK)
{
  kokkosable = 1;
  execution_space = ExecutionSpaceFromDevice<DeviceType>::space;
  datamask_read = X_MASK | V_MASK | F_MASK | RADIUS_MASK | TYPE_MASK | TAG_MASK;
  datamask_modify = F_MASK | ENERGY_MASK | VIRIAL_MASK;
  list_flags |= NeighConst::REQ_NEWTON_OFF;
  space.keep(all_columns);
}

template <class DeviceType> PairDurianFoamKokkos<DeviceType>::~PairDurianFoamKokkos()
{
  memoryKK->destroy_kokkos(k_eatom, eatom);
  memoryKK->destroy_kokkos(k_vatom, vatom);
  if (neighbor && has_own_bins()) neighbor->binsizeflag = 0;
}

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::init_style()
{
  atomKK->sync(Host, RADIUS_MASK | MASK_MASK);    // refresh() may call this in a run
  PairDurianFoam::init_style();
  auto *request = neighbor->find_request(this);
  request->set_kokkos_host(std::is_same_v<DeviceType, LMPHostType> &&
                           !std::is_same_v<DeviceType, LMPDeviceType>);
  request->set_kokkos_device(std::is_same_v<DeviceType, LMPDeviceType>);
  rows_known = owners_known = ghosts_fresh = sigma0_known = false;
  if (FoamKokkos<DeviceType>::ON_HOST) choose_bins();

  if (comm->style == Comm::TILED && !lmp->kokkos->forward_comm_legacy)
    error->all(FLERR,
               "Pair style durian/foam/kk with comm_style tiled needs forward communication on the "
               "host: use package kokkos comm/forward no");

  // Forces of owned bubbles only, written and not added to: then nobody need clear them first. Those of ghosts are 0
  // with each list, and stay so: there is nothing to send back.

  fuse_force_clear_flag = !utils::strmatch(force->pair_style, "^hybrid");
}

// on a GPU LAMMPS does

template <class DeviceType> bool PairDurianFoamKokkos<DeviceType>::can_make_lists() const
{
  return FoamKokkos<DeviceType>::ON_HOST && PairDurianFoam::can_make_lists();
}

// Where LAMMPS makes the list: without newton it looks at all bins around a bubble for half of its pairs, and most pairs
// reach half as far as the largest: few bins as wide as the cutoff are searched faster than many of half that width,
// LAMMPS' own without a GPU. What users ask for stays. LAMMPS refuses bins a hundred times as wide as the box.

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::choose_bins()
{
  if (neighbor->binsizeflag && !has_own_bins()) return;
  constexpr double WIDEST = 50.0;
  const double width = 2.0 * cutoff_radius + neighbor->skin,
               side = MIN(MIN(domain->xprd, domain->yprd), domain->zprd);
  const bool wanted = !(range() > 1.0) && width > 0.0 && width < WIDEST * side;
  neighbor->binsizeflag = wanted;
  neighbor->binsize_user = bin_width = wanted ? width : 0.0;
}

template <class DeviceType> bool PairDurianFoamKokkos<DeviceType>::has_own_bins() const
{
  return bin_width > 0.0 && neighbor->binsizeflag && neighbor->binsize_user == bin_width;
}

// other coefficients in mid-run, by fix adapt

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::reinit()
{
  PairDurianFoam::reinit();
  sigma0_known = false;
}

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag, 0);
  if (eflag_atom) {
    memoryKK->destroy_kokkos(k_eatom, eatom);
    memoryKK->create_kokkos(k_eatom, eatom, maxeatom, "pair:eatom");
  }
  if (vflag_atom) {
    memoryKK->destroy_kokkos(k_vatom, vatom);
    memoryKK->create_kokkos(k_vatom, vatom, maxvatom, "pair:vatom");
  }

  take_list();
  if (sends_radii() && !ghosts_fresh && !refresh_ghosts(Ghosts::RADII)) {
    sending = RADII;
    comm->forward_comm(this);
  }
  ghosts_fresh = false;
  gather(gathered_with_forces());

  if (eflag_atom) {
    k_eatom.template modify<DeviceType>();
    k_eatom.sync_host();
  }
  if (vflag_atom) {
    k_vatom.template modify<DeviceType>();
    k_vatom.sync_host();
  }
}

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::take_list()
{
  if (!sigma0_known) {
    const int n = (atom->ntypes + 1) * (atom->ntypes + 1);
    sigma0_there = Kokkos::View<double *, DeviceType>("durian/foam:sigma0", n);
    Kokkos::deep_copy(
        sigma0_there,
        Kokkos::View<double *, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>(sigma0[0], n));
    sigma0_known = true;
  }
  if (rows_known && rows_ncalls == neighbor->ncalls && rows_lastcall == neighbor->lastcall) return;
  make_rows();
  make_owners();
  if (force->newton && fuse_force_clear_flag)
    space.for_all(atom->nghost, ClearGhostForces{space.bubbles(), atom->nlocal});
  rows_known = true;
  rows_ncalls = neighbor->ncalls;
  rows_lastcall = neighbor->lastcall;
}

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::make_rows()
{
  const int nlocal = atom->nlocal;
  const bool halves = FoamKokkos<DeviceType>::ON_HOST && lmp->kokkos->neighflag != FULL;
  const int threads = halves ? DeviceType().concurrency() : nlocal;
  chunk = MAX(1, (nlocal + threads - 1) / MAX(1, threads));

  atomKK->sync(execution_space, TAG_MASK);
  const auto tag = atomKK->k_tag.view<DeviceType>();
  const bool in_blocks = FoamKokkos<DeviceType>::AS_WITHOUT && chunk > 1 && foam_has_wide_vectors();
  auto make = [&](const auto &pairs) {
    foam_make_rows(space, pairs, tag, nlocal, atom->nmax, chunk, range(), in_blocks, rows);
  };
  auto of_list = [&]<class Near>(const Near &near) {
    make(FoamMakeRows::HalfList<DeviceType, Near>(list, near));
  };
  if (list->occasional && can_make_lists()) {    // fixes may exclude pairs, later than init_style()
    if constexpr (FoamKokkos<DeviceType>::ON_HOST)
      Foam::with_dimension(domain->dimension, [&]<int D>() {
        make(found.template find<D>(space, nlocal, nlocal + atom->nghost, near()));
      });
    tell_sizes();
  } else {
    if (list->occasional) neighbor->build_one(list);
    if (range() > 1.0)
      of_list(Foam::ComesNear<typename FoamKokkos<DeviceType>::Bubbles, Foam::ReachOfContact>{
          space.bubbles(), {range()}, neighbor->skin});
    else
      of_list(FoamMakeRows::All());    // it knows sizes
  }
  if constexpr (FoamKokkos<DeviceType>::AS_WITHOUT) {
    if (in_blocks) foam_own_pairs(space, nlocal, rows);
  }
}

// to LAMMPS, whose list of pairs is filled by nobody else

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::tell_sizes()
{
  const int nlocal = atom->nlocal;
  list->grow(nlocal, nlocal + atom->nghost);
  auto *const listed = static_cast<NeighListKokkos<DeviceType> *>(list);
  listed->grow(nlocal);
  space.for_all(nlocal, FoamMakeRows::TellSizes<DeviceType>{rows, listed->d_ilist,
                                                            listed->d_numneigh, nlocal});
  list->inum = nlocal;
  list->gnum = 0;
}

// each bubble's index goes the way of its other numbers, also from ghost to ghost

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::make_owners()
{
  owners_known = ghosts_fresh = false;
  if (comm->nprocs > 1 || !utils::strmatch(atom->atom_style, "^sphere")) return;
  const int nlocal = atom->nlocal, nghost = atom->nghost;
  if (static_cast<int>(k_owner.extent(0)) < nlocal + nghost)
    k_owner = DAT::tdual_int_1d("durian/foam:owner", atom->nmax);
  if (static_cast<int>(boxes.extent(0)) < nghost) boxes = Boxes("durian/foam:boxes", 1.2 * nghost);

  space.for_each(nlocal, OwnIndex<DeviceType>{k_owner.view<DeviceType>()});
  k_owner.modify<DeviceType>();
  sending = OWNERS;
  comm->forward_comm(this);
  k_owner.sync<DeviceType>();
  space.for_each(nghost, ghosts());
  owners_known = true;
}

template <class DeviceType> FoamGhosts<DeviceType> PairDurianFoamKokkos<DeviceType>::ghosts() const
{
  const Domain &d = *domain;
  return {space.bubbles(),
          k_owner.view<DeviceType>(),
          boxes,
          atom->nlocal,
          d.xprd,
          d.yprd,
          d.zprd,
          d.xy,
          d.xz,
          d.yz};
}

template <class DeviceType> bool PairDurianFoamKokkos<DeviceType>::refresh_ghosts(Ghosts what)
{
  if (!owners_known) return false;
  const bool velocities = comm->ghost_velocity;
  if (what == Ghosts::EVERYTHING && velocities && domain->deform_vremap) return false;
  const auto all = ghosts();
  if (what == Ghosts::RADII) {
    space.for_each(atom->nghost, RefreshGhosts<DeviceType, false>{all, false});
    atomKK->modified(execution_space, RADIUS_MASK);
  } else {
    space.for_each(atom->nghost, RefreshGhosts<DeviceType, true>{all, velocities});
    atomKK->modified(execution_space, X_MASK | RADIUS_MASK | (velocities ? V_MASK : EMPTY_MASK));
    ghosts_fresh = true;
  }
  return true;
}

template <class DeviceType> bool PairDurianFoamKokkos<DeviceType>::sends_radii() const
{
  return hub.radii_change && !lmp->kokkos->forward_comm_legacy;
}

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::send_given()
{
  take_list();
  if (owners_known) {
    space.for_each(atom->nghost, CopyFromOwners<DeviceType>{ghosts(), given_there()});
  } else {
    sending = GIVEN;
    comm->forward_comm(this);
  }
}

template <class DeviceType> Foam::Given PairDurianFoamKokkos<DeviceType>::given_there()
{
  return {{space.column(given, 0), space.column(given, 1), space.column(given, 2)}};
}

template <class DeviceType>
int PairDurianFoamKokkos<DeviceType>::pack_forward_comm(int n, int *sent, double *buf, int only,
                                                        int *list)
{
  if (sending == GIVEN) return PairDurianFoam::pack_forward_comm(n, sent, buf, only, list);
  if (sending == OWNERS) {
    k_owner.sync_host();
    for (int m = 0; m < n; m++) buf[m] = k_owner.view_host()(sent[m]);
  } else {
    atomKK->sync(HostKK, RADIUS_MASK);
    for (int m = 0; m < n; m++) buf[m] = atomKK->k_radius.view_hostkk()(sent[m]);
  }
  return n;
}

template <class DeviceType>
void PairDurianFoamKokkos<DeviceType>::unpack_forward_comm(int n, int first, double *buf)
{
  if (sending == GIVEN) return PairDurianFoam::unpack_forward_comm(n, first, buf);
  if (sending == OWNERS) {
    k_owner.sync_host();
    for (int m = 0; m < n; m++) k_owner.view_host()(first + m) = static_cast<int>(buf[m]);
    k_owner.modify_host();
  } else {
    atomKK->sync(HostKK, RADIUS_MASK);
    for (int m = 0; m < n; m++) atomKK->k_radius.view_hostkk()(first + m) = buf[m];
    atomKK->modified(HostKK, RADIUS_MASK);
  }
}

template <class DeviceType>
int PairDurianFoamKokkos<DeviceType>::pack_forward_comm_kokkos(int n, DAT::tdual_int_1d k_sent,
                                                               DAT::tdual_double_1d &k_buf, int,
                                                               int *)
{
  const auto sent = k_sent.view<DeviceType>();
  double *const buf = k_buf.view<DeviceType>().data();
  if (sending == GIVEN) {
    space.for_each(n, PackGiven{given_there(), sent, buf});
    return 3 * n;
  }
  if (sending == OWNERS)
    space.for_each(n, PackOne{k_owner.view<DeviceType>(), sent, buf});
  else
    space.for_each(n, PackOne{space.bubbles().radius, sent, buf});
  return n;
}

template <class DeviceType>
void PairDurianFoamKokkos<DeviceType>::unpack_forward_comm_kokkos(int n, int first,
                                                                  DAT::tdual_double_1d &k_buf)
{
  const double *const buf = k_buf.view<DeviceType>().data();
  if (sending == GIVEN) {
    space.for_each(n, UnpackGiven{given_there(), buf, first});
  } else if (sending == OWNERS) {
    space.for_each(n, UnpackOne{k_owner.view<DeviceType>(), buf, first});
    k_owner.modify<DeviceType>();
  } else {
    space.for_each(n, UnpackOne{space.bubbles().radius, buf, first});
    atomKK->modified(execution_space, RADIUS_MASK);
  }
}

/* ----------------------------------------------------------------------
   one pass over the rows
------------------------------------------------------------------------- */

template <class DeviceType> void PairDurianFoamKokkos<DeviceType>::gather(unsigned what)
{
  make_room(what);
  take_list();
  if (what & Foam::FORCE) hub.free_surface_known = false;
  Foam::with_loop(
      law, what, evflag, domain->dimension,
      [&]<int D, unsigned WHAT>(const auto &chosen) { gather_in<D, WHAT>(chosen, what); });
}

template <class DeviceType>
template <int D, unsigned WHAT, class Law>
void PairDurianFoamKokkos<DeviceType>::gather_in(const Law &chosen, unsigned what)
{
  using namespace FoamPass;
  using B = typename FoamKokkos<DeviceType>::Bubbles;
  using Rows = FoamRows<DeviceType>;
  const int nlocal = atom->nlocal;
  const bool clear = fuse_force_clear_flag && !modify->n_pre_force;
  const Foam::ContactSums sums = contact_sums(space);

  auto run = [&]<bool CHUNKS>() {
    const int n = CHUNKS ? (nlocal + chunk - 1) / chunk : nlocal;
    using Tally =
        std::conditional_t<(WHAT & Foam::TALLY) != 0, KokkosTally<DeviceType>, Foam::NoTally>;
    using Loop = Foam::ContactLoop<D, WHAT, !CHUNKS, Law, B, Rows, Tally>;
    using Blocks = std::conditional_t<FOAM_MAKES_VECTORS && FoamKokkos<DeviceType>::AS_WITHOUT,
                                      Foam::ContactBlocks<D, WHAT, Law, B>, NoBlocks>;
    const Pass<CHUNKS, Loop, Blocks> pass{
        {space.bubbles(), rows, chosen, coefficients(), sums, !clear, what}, chunk, nlocal, clear};
    if constexpr (WHAT & Foam::TALLY) {
      const Tally tally{nullptr, eflag_atom != 0, vflag_atom != 0,
                        k_eatom.template view<DeviceType>(), k_vatom.template view<DeviceType>()};
      const auto all = space.template reduce<EnergyVirial>(
          n, TalliedContacts<Pass<CHUNKS, Loop, Blocks>, DeviceType>{pass, tally});
      if (eflag_global) eng_vdwl += all.energy;
      if (vflag_global)
        for (int k = 0; k < 6; k++) virial[k] += all.virial[k];
    } else if constexpr ((WHAT & Foam::FORCE) && (WHAT & Foam::AREA)) {
      hub.free_surface = space.template sums<Foam::FreeSurface>(
          n, SummedContacts<D, Pass<CHUNKS, Loop, Blocks>>{pass, hub.liquid_law,
                                                           hub.walls_that(FoamHub::COVER, space)});
      hub.free_surface_known = true;
    } else
      space.for_each(n, Contacts<Pass<CHUNKS, Loop, Blocks>>{pass});
  };
  if constexpr (FoamKokkos<DeviceType>::ON_HOST) {
    if (chunk > 1) return run.template operator()<true>();
  }
  run.template operator()<false>();
}

template <class DeviceType> double PairDurianFoamKokkos<DeviceType>::memory_usage()
{
  return PairDurianFoam::memory_usage() + bytes(rows) + found.bytes();
}

namespace LAMMPS_NS {
template class PairDurianFoamKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class PairDurianFoamKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
