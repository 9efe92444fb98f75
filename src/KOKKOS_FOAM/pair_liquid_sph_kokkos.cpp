/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_liquid_sph_kokkos.h"

#include "error.h"
#include "neigh_list_kokkos.h"
#include "neigh_request.h"
#include "neighbor.h"

using namespace LAMMPS_NS;

template <class DeviceType>
PairLiquidSPHKokkos<DeviceType>::PairLiquidSPHKokkos(LAMMPS *lmp)
    : PairLiquidSPH(lmp), space(lmp, EMPTY_MASK)
{
  kokkosable = 1;
  execution_space = FoamKokkos<DeviceType>::SPACE;
  datamask_read = TAG_MASK | MASK_MASK;
  datamask_modify = EMPTY_MASK;    // there is no force
}

template <class DeviceType> void PairLiquidSPHKokkos<DeviceType>::init_style()
{
  atomKK->sync(Host, TYPE_MASK | MASK_MASK);
  PairLiquidSPH::init_style();
}

template <class DeviceType> void PairLiquidSPHKokkos<DeviceType>::request_list()
{
  auto *const request = neighbor->add_request(this, NeighConst::REQ_FULL);
  request->set_kokkos_host(std::is_same_v<DeviceType, LMPHostType> &&
                           !std::is_same_v<DeviceType, LMPDeviceType>);
  request->set_kokkos_device(std::is_same_v<DeviceType, LMPDeviceType>);
}

/* ----------------------------------------------------------------------
   rows
------------------------------------------------------------------------- */

namespace {

template <class DeviceType> struct Listed {
  LiquidRows<DeviceType> rows;
  typename ArrayTypes<DeviceType>::t_int_1d numneigh;
  typename ArrayTypes<DeviceType>::t_neighbors_2d neighbors;
  typename ArrayTypes<DeviceType>::t_tagint_1d tag;
  const int *mask;
  int mine, its;    // groups
  template <class Visit> FOAM_ALWAYS_INLINE void for_each(int i, const Visit &visit) const
  {
    const int size = numneigh(i);
    for (int m = 0; m < size; m++) {
      const int j = neighbors(i, m) & NEIGHMASK;
      if (mask[j] & its) visit(j);
    }
  }
};

template <class DeviceType> struct ListMembers : Listed<DeviceType> {
  using value_type = int;
  KOKKOS_INLINE_FUNCTION void operator()(int i, int &count, bool final) const
  {
    if (!(this->mask[i] & this->mine)) return;
    if (final) this->rows.of(count) = i;
    count++;
  }
};

template <class DeviceType> struct CountPartners : Listed<DeviceType> {
  static constexpr const char *NAME = "liquid: count neighbors";
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    int size = 0;
    this->for_each(this->rows.of(n), [&](int) { size++; });
    this->rows.first(n) = size;
  }
};

template <class DeviceType> struct PlaceRows : Listed<DeviceType> {    // in place of their sizes
  using value_type = bigint;
  KOKKOS_INLINE_FUNCTION void operator()(int n, bigint &begin, bool final) const
  {
    const int size = n < this->rows.count ? this->rows.first(n) : 0;
    if (final) this->rows.first(n) = static_cast<int>(begin);
    begin += size;
  }
};

// Threads fill LAMMPS' bins in any order: in order of IDs sums come out the same every time.  (Gaps after Ciura, FUN
// Algorithms 2001: LNCS 2138, 106.)

template <class DeviceType, bool SORTED> struct FillRows : Listed<DeviceType> {
  static constexpr const char *NAME = "liquid: fill rows";
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    int *const row = this->rows.partner.data() + this->rows.first(n);
    int size = 0;
    this->for_each(this->rows.of(n), [&](int j) { row[size++] = j; });
    if constexpr (SORTED) {
      for (const int gap : {57, 23, 10, 4, 1})
        for (int m = gap; m < size; m++) {
          const int j = row[m];
          int k = m;
          for (; k >= gap && behind(row[k - gap], j); k -= gap) row[k] = row[k - gap];
          row[k] = j;
        }
    }
  }
  KOKKOS_INLINE_FUNCTION bool behind(int j, int k) const
  {
    return this->tag(j) != this->tag(k) ? this->tag(j) > this->tag(k) : j > k;
  }
};

}    // namespace

template <class DeviceType>
void PairLiquidSPHKokkos<DeviceType>::make(LiquidRows<DeviceType> &rows, int of, int with)
{
  using Numbers = typename LiquidRows<DeviceType>::Numbers;
  using Range = Kokkos::RangePolicy<DeviceType>;
  if (static_cast<int>(rows.of.extent(0)) < atom->nlocal || rows.of.extent(0) == 0) {
    rows.of = Numbers("liquid/sph:of", atom->nmax);
    rows.first = Numbers("liquid/sph:first", atom->nmax + 1);
  }
  const auto *const listed = static_cast<NeighListKokkos<DeviceType> *>(list);
  auto all = [&]() {
    return Listed<DeviceType>{rows,
                              listed->d_numneigh,
                              listed->d_neighbors,
                              atomKK->k_tag.view<DeviceType>(),
                              atomKK->k_mask.view<DeviceType>().data(),
                              of,
                              with};
  };
  rows.count = 0;
  Kokkos::parallel_scan("liquid: members", Range(0, atom->nlocal), ListMembers<DeviceType>{all()},
                        rows.count);
  space.for_all(rows.count, CountPartners<DeviceType>{all()});
  bigint total = 0;
  Kokkos::parallel_scan("liquid: place rows", Range(0, rows.count + 1),
                        PlaceRows<DeviceType>{all()}, total);
  if (total > MAXSMALLINT)
    error->one(FLERR,
               "Pair style liquid/sph/kk: a rank has {} pairs of neighbors: more than {} are too "
               "many, use more ranks",
               total, MAXSMALLINT);
  if (static_cast<bigint>(rows.partner.extent(0)) < total)
    rows.partner = Numbers(Kokkos::view_alloc("liquid/sph:partner", Kokkos::WithoutInitializing),
                           static_cast<size_t>(1.1 * total));
  if (DeviceType().concurrency() > 1)
    space.for_all(rows.count, FillRows<DeviceType, true>{all()});
  else
    space.for_all(rows.count, FillRows<DeviceType, false>{all()});
}

template <class DeviceType> void PairLiquidSPHKokkos<DeviceType>::take_lists()
{
  atomKK->sync(execution_space, TAG_MASK | MASK_MASK);
  make(lists[LIQUID], liquidbit, liquidbit);
  if (gasbit) {
    make(lists[BUBBLES_OF_LIQUID], liquidbit, gasbit);
    make(lists[LIQUID_OF_BUBBLES], gasbit, liquidbit);
  }
}

template <class DeviceType> double PairLiquidSPHKokkos<DeviceType>::memory_usage()
{
  double ints = 0.0;
  for (const auto &rows : lists)
    ints += double(rows.of.extent(0) + rows.first.extent(0) + rows.partner.extent(0));
  return PairLiquidSPH::memory_usage() + sizeof(int) * ints;
}

namespace LAMMPS_NS {
template class PairLiquidSPHKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class PairLiquidSPHKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
