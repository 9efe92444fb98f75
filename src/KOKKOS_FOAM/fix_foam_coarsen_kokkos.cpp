/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_coarsen_kokkos.h"

#include "atom_kokkos.h"
#include "atom_vec_kokkos.h"
#include "kokkos.h"
#include "kokkos_base.h"
#include "modify.h"

using namespace LAMMPS_NS;

template <class DeviceType>
FixFoamCoarsenKokkos<DeviceType>::FixFoamCoarsenKokkos(LAMMPS *lmp, int narg, char **arg)
    : FixFoamCoarsen(lmp, narg, arg), space(lmp, EMPTY_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = datamask_modify = EMPTY_MASK;
}

template <class DeviceType> double FixFoamCoarsenKokkos<DeviceType>::critical_radius()
{
  if (rho_on_device) {
    const double inverse = space.fetch(rho_on_device).inverse_rho();
    keep_critical_radius(inverse > 0.0 ? 1.0 / inverse : 0.0);
  }
  return FixFoamCoarsen::critical_radius();
}

/* ----------------------------------------------------------------------
   The dead leave as bubbles leave for another rank, only that nobody takes them: LAMMPS packs
   them into a buffer, and fills their places with living ones from the end
------------------------------------------------------------------------- */

template <class DeviceType> bool FixFoamCoarsenKokkos<DeviceType>::all_on_device() const
{
  for (int m = 0; m < atom->nextra_grow; m++)
    if (!modify->fix[atom->extra_grow[m]]->exchange_comm_device) return false;
  return true;
}

template <class DeviceType> void FixFoamCoarsenKokkos<DeviceType>::take_out_dead()
{
  if (!has_dead()) return;
  if (all_on_device()) {
    compact();
    if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
    count_particles();
  } else {
    atomKK->sync(Host, ALL_MASK);
    const int auto_sync = lmp->kokkos->auto_sync;
    lmp->kokkos->auto_sync = 1;
    FixFoamCoarsen::take_out_dead();
    lmp->kokkos->auto_sync = auto_sync;
    atomKK->modified(Host, ALL_MASK);
  }
}

namespace {

template <class DeviceType> struct Listing {
  using Numbers = typename ArrayTypes<DeviceType>::t_int_1d;
  using value_type = int;
  decltype(FoamKokkos<DeviceType>::Bubbles::radius) radius;
  Foam::Members member;
  KOKKOS_INLINE_FUNCTION bool is_dead(int i) const { return !(radius(i) > 0.0) && member(i); }
};

// the dead, in order

template <class DeviceType> struct ListDead : Listing<DeviceType> {
  typename Listing<DeviceType>::Numbers dead;
  KOKKOS_INLINE_FUNCTION void operator()(int i, int &count, bool final) const
  {
    if (!this->is_dead(i)) return;
    if (final) dead(count) = i;
    count++;
  }
};

// the others behind the new end, the last one first: as many as there are dead before it

template <class DeviceType> struct ListFillers : Listing<DeviceType> {
  typename Listing<DeviceType>::Numbers fill;
  int last;
  KOKKOS_INLINE_FUNCTION void operator()(int n, int &count, bool final) const
  {
    const int i = last - n;
    if (this->is_dead(i)) return;
    if (final) fill(count) = i;
    count++;
  }
};

}    // namespace

template <class DeviceType> void FixFoamCoarsenKokkos<DeviceType>::compact()
{
  const int nlocal = atom->nlocal;
  if (nlocal == 0) return;
  if (static_cast<int>(k_dead.extent(0)) < nlocal) {
    k_dead = DAT::tdual_int_1d("foam/coarsen:dead", atom->nmax);
    k_fill = DAT::tdual_int_1d("foam/coarsen:fill", atom->nmax);
  }
  const Listing<DeviceType> all{space.bubbles().radius, space.members(groupbit)};
  const auto dead = k_dead.view<DeviceType>();
  const auto fill = k_fill.view<DeviceType>();
  using Range = Kokkos::RangePolicy<DeviceType>;

  int ndead = 0, nfill = 0;
  Kokkos::parallel_scan("foam: list dead", Range(0, nlocal), ListDead<DeviceType>{all, dead},
                        ndead);
  if (ndead == 0) return;
  Kokkos::deep_copy(DeviceType(), fill, -1);
  Kokkos::parallel_scan("foam: list fillers", Range(0, ndead),
                        ListFillers<DeviceType>{all, fill, nlocal - 1}, nfill);
  k_dead.modify<DeviceType>();
  k_fill.modify<DeviceType>();

  int most = 64;    // numbers of a bubble, more than any atom style of spheres has
  for (int m = 0; m < atom->nextra_grow; m++)
    most = MAX(most, modify->fix[atom->extra_grow[m]]->maxexchange + 1);
  if (static_cast<int>(k_buf.extent(0)) < ndead || static_cast<int>(k_buf.extent(1)) < most)
    k_buf = DAT::tdual_double_2d_lr("foam/coarsen:buf", ndead, most);

  atomKK->avecKK->pack_exchange_kokkos(ndead, k_buf, k_dead, k_fill, DAT::tdual_int_1d(),
                                       execution_space);
  for (int m = 0; m < atom->nextra_grow; m++)
    dynamic_cast<KokkosBase *>(modify->fix[atom->extra_grow[m]])
        ->pack_exchange_kokkos(ndead, k_buf, k_dead, k_fill, execution_space);
  atom->nlocal -= ndead;
}

namespace LAMMPS_NS {
template class FixFoamCoarsenKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixFoamCoarsenKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
