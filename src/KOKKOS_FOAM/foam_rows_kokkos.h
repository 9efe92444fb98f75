/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_ROWS_KOKKOS_H
#define LMP_FOAM_ROWS_KOKKOS_H

#include "foam_kokkos.h"
#include "neigh_list_kokkos.h"

namespace LAMMPS_NS {

// Pairs of bubbles in rows, made of LAMMPS' half list, which knows sizes (its full list does not, and would be several
// times as long), or of pairs that were found by sizes, see foam_found_kokkos.h.  Bubbles are cut into chunks of consecutive ones, and a
// chunk is the work of one thread.  A pair within a chunk occurs once, and both partners get
// their share; any other occurs in the rows of both partners, and each takes its own.  So nothing
// is atomic, nothing is sent back from ghosts, and the sums of a bubble are always of the same order.
// A chunk of one bubble makes it a full list, a single chunk a half list.

template <class DeviceType> struct FoamRows {
  static constexpr bool CHUNKS = FoamKokkos<DeviceType>::ON_HOST;    // of one bubble elsewhere
  using Numbers = Kokkos::View<int *, DeviceType>;
  Numbers first;     // where a row begins, [nlocal+1]
  Numbers shared;    // how many of its pairs occur once; these come first
  Numbers partner;
  Numbers owner;    // of the row that a partner is in; only where pairs are wanted apart from rows

  struct Row {
    int i, size, shared;
    const int *partners;
    template <class Visit> FOAM_ALWAYS_INLINE void for_each(const Visit &visit) const
    {
      for (int m = 0; m < size; m++) visit(partners[m], CHUNKS && m < shared);
    }
  };
  KOKKOS_INLINE_FUNCTION Row row(int i) const
  {
    return {i, first(i + 1) - first(i), CHUNKS ? shared(i) : 0, partner.data() + first(i)};
  }
};

template <class DeviceType> double bytes(const FoamRows<DeviceType> &rows)
{
  return sizeof(int) * double(rows.first.extent(0) + rows.shared.extent(0) +
                              rows.partner.extent(0) + rows.owner.extent(0));
}

// ---------------------------------------------------------------------- how they are made

namespace FoamMakeRows {

// LAMMPS' half list: a pair of owned bubbles once, in the row of either; one of an owned bubble and a ghost in the
// owned one's.  Near: is a pair taken? See Foam::ComesNear

template <class DeviceType, class Near> struct HalfList {
  using AT = ArrayTypes<DeviceType>;
  typename AT::t_int_1d ilist, numneigh;
  typename AT::t_neighbors_2d neighbors;
  Near near;
  int inum;
  static constexpr bool IN_ORDER = false;

  HalfList(NeighList *list, const Near &near) : near(near)
  {
    auto *listed = static_cast<NeighListKokkos<DeviceType> *>(list);
    ilist = listed->d_ilist;
    numneigh = listed->d_numneigh;
    neighbors = listed->d_neighbors;
    inum = list->inum;
  }
  KOKKOS_INLINE_FUNCTION int index(int n) const { return ilist(n); }
  template <class Visit> FOAM_ALWAYS_INLINE void for_each(int i, const Visit &visit) const
  {
    const int size = numneigh(i);
    for (int m = 0; m < size; m++) {
      const int j = neighbors(i, m) & NEIGHMASK;
      if (near(i, j)) visit(j);
    }
  }
};

// List has a row for each n from 0 to list.inum: that of bubble list.index(n), which may be a ghost, with its partners,
// list.for_each(index, visit).  At least one bubble of a pair is owned.  IN_ORDER: partners do not depend on which thread
// came first.

template <class DeviceType, class List> struct ListedPairs {
  using AT = ArrayTypes<DeviceType>;
  List list;
  FoamRows<DeviceType> rows;
  typename FoamRows<DeviceType>::Numbers filled;    // single pairs of a row so far
  int nlocal, chunk;
  typename AT::t_tagint_1d tag;

  struct Chunk {
    int begin, end;
    KOKKOS_INLINE_FUNCTION bool has(int j) const { return j >= begin && j < end; }
  };
  KOKKOS_INLINE_FUNCTION Chunk chunk_of(int i) const
  {
    if (chunk == 1 || i >= nlocal) return {0, 0};    // all pairs are single
    const int begin = i / chunk * chunk, end = begin + chunk;
    return {begin, end < nlocal ? end : nlocal};
  }
};

template <class DeviceType, class List> struct CountPairs : ListedPairs<DeviceType, List> {
  static constexpr const char *NAME = "foam: count pairs";
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = this->list.index(n);
    const auto mine = this->chunk_of(i);
    int shared = 0, single = 0;
    this->list.for_each(i, [&](int j) FOAM_INLINE_LAMBDA {
      if (mine.has(j))
        shared++;
      else {
        single++;
        if (j < this->nlocal) Kokkos::atomic_inc(&this->filled(j));
      }
    });
    if (i >= this->nlocal) return;
    this->rows.shared(i) = shared;
    Kokkos::atomic_add(&this->filled(i), single);
  }
};

template <class DeviceType, class List> struct PlaceRows : ListedPairs<DeviceType, List> {
  using value_type = int;
  KOKKOS_INLINE_FUNCTION void operator()(int i, int &begin, bool final) const
  {
    const int size = i < this->nlocal ? this->rows.shared(i) + this->filled(i) : 0;
    if (final) {
      this->rows.first(i) = begin;
      if (i < this->nlocal) this->filled(i) = 0;
    }
    begin += size;
  }
};

template <class DeviceType, class List> struct FillRows : ListedPairs<DeviceType, List> {
  static constexpr const char *NAME = "foam: fill rows";
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = this->list.index(n);
    const auto mine = this->chunk_of(i);
    int shared = 0;
    this->list.for_each(i, [&](int j) FOAM_INLINE_LAMBDA {
      if (mine.has(j))
        this->rows.partner(this->rows.first(i) + shared++) = j;
      else {
        append(i, j);
        append(j, i);
      }
    });
  }
  KOKKOS_INLINE_FUNCTION void append(int i, int j) const
  {
    if (i >= this->nlocal) return;
    const int place = Kokkos::atomic_fetch_inc(&this->filled(i));
    this->rows.partner(this->rows.first(i) + this->rows.shared(i) + place) = j;
  }
};

// Threads fill a row in any order, and LAMMPS may number ghosts in any order on a device: in order
// of partners' IDs, the sums of a row come out the same every time. Pairs within the range of forces come first:
// most of them still are when forces are wanted, so that a processor guesses well which are.

template <class DeviceType, class List> struct SortRows : ListedPairs<DeviceType, List> {
  static constexpr const char *NAME = "foam: sort rows";
  using B = typename FoamKokkos<DeviceType>::Bubbles;
  Foam::ComesNear<B, Foam::ReachOfContact> touch;
  bool in_blocks;    // rows are: nobody guesses
  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    const int begin = this->rows.first(i), end = this->rows.first(i + 1);
    if (!(List::IN_ORDER && in_blocks)) arrange(i, begin, begin + this->rows.shared(i));
    arrange(i, begin + this->rows.shared(i), end);
  }
  KOKKOS_INLINE_FUNCTION void arrange(int i, int begin, int end) const
  {
    int middle = begin;
    for (int m = begin; m < end; m++) {
      const int j = this->rows.partner(m);
      if (!touch(i, j)) continue;
      this->rows.partner(m) = this->rows.partner(middle);
      this->rows.partner(middle++) = j;
    }
    sort(begin, middle);
    sort(middle, end);
  }
  KOKKOS_INLINE_FUNCTION bool behind(int j, int k) const
  {
    return this->tag(j) != this->tag(k) ? this->tag(j) > this->tag(k) : j > k;
  }
  KOKKOS_INLINE_FUNCTION void sort(int begin, int end) const
  {
    for (int m = begin + 1; m < end; m++) {
      const int j = this->rows.partner(m);
      int k = m;
      for (; k > begin && behind(this->rows.partner(k - 1), j); k--)
        this->rows.partner(k) = this->rows.partner(k - 1);
      this->rows.partner(k) = j;
    }
  }
};

template <class DeviceType> struct OwnPairs {
  static constexpr const char *NAME = "foam: owners of pairs";
  FoamRows<DeviceType> rows;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    for (int p = rows.first(i); p < rows.first(i + 1); p++) rows.owner(p) = i;
  }
};

// Sizes of rows as in a half list: pairs of owned bubbles count once

template <class DeviceType> struct TellSizes {
  static constexpr const char *NAME = "foam: sizes of rows";
  FoamRows<DeviceType> rows;
  typename ArrayTypes<DeviceType>::t_int_1d ilist, numneigh;
  int nlocal;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int size = rows.shared(i);
    for (int m = rows.first(i) + size; m < rows.first(i + 1); m++)
      if (rows.partner(m) > i || rows.partner(m) >= nlocal) size++;
    ilist(i) = i;
    numneigh(i) = size;
  }
};

struct All {
  KOKKOS_INLINE_FUNCTION bool operator()(int, int) const { return true; }
};

}    // namespace FoamMakeRows

// list: as ListedPairs wants it. tag: IDs, where they run. range: of forces, in radii; 0: all pairs of a row in the order
// of IDs. in_blocks: see Foam::ContactBlocks

template <class DeviceType, class List>
void foam_make_rows(const FoamKokkos<DeviceType> &space, const List &list,
                    typename ArrayTypes<DeviceType>::t_tagint_1d tag, int nlocal, int nmax,
                    int chunk, double range, bool in_blocks, FoamRows<DeviceType> &rows)
{
  using namespace FoamMakeRows;
  using Numbers = typename FoamRows<DeviceType>::Numbers;
  if (static_cast<int>(rows.shared.extent(0)) < nlocal || rows.first.extent(0) == 0) {
    rows.first = Numbers("foam: first of rows", nmax + 1);
    rows.shared = Numbers("foam: shared of rows", nmax);
  } else
    Kokkos::deep_copy(DeviceType(), rows.shared, 0);

  ListedPairs<DeviceType, List> pairs{list,   rows,  Numbers("foam: filled of rows", nlocal),
                                      nlocal, chunk, tag};
  space.for_each(list.inum, CountPairs<DeviceType, List>{pairs});
  int total = 0;
  Kokkos::parallel_scan("foam: place rows", Kokkos::RangePolicy<DeviceType>(0, nlocal + 1),
                        PlaceRows<DeviceType, List>{pairs}, total);
  if (static_cast<int>(rows.partner.extent(0)) < total)
    rows.partner = Numbers(Kokkos::view_alloc("foam: partners", Kokkos::WithoutInitializing),
                           static_cast<size_t>(1.1 * total));
  pairs.rows = rows;
  space.for_each(list.inum, FillRows<DeviceType, List>{pairs});
  space.for_each(nlocal,
                 SortRows<DeviceType, List>{pairs, {space.bubbles(), {range}, 0.0}, in_blocks});
}

// the same pairs apart from rows, see Foam::ContactBlocks

template <class DeviceType>
void foam_own_pairs(const FoamKokkos<DeviceType> &space, int nlocal, FoamRows<DeviceType> &rows)
{
  if (rows.owner.extent(0) < rows.partner.extent(0))
    rows.owner = typename FoamRows<DeviceType>::Numbers(
        Kokkos::view_alloc("foam: owners", Kokkos::WithoutInitializing), rows.partner.extent(0));
  space.for_all(nlocal, FoamMakeRows::OwnPairs<DeviceType>{rows});
}

}    // namespace LAMMPS_NS

#endif
