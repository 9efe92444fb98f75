/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_FOUND_KOKKOS_H
#define LMP_FOAM_FOUND_KOKKOS_H

#include "foam_cells.h"
#include "foam_kokkos.h"

#include <vector>

namespace LAMMPS_NS {

// Pairs found by sizes (foam_cells.h), by the threads of a host: all those of owned bubbles, each once. Where the larger
// is a ghost, it is the ghost that finds them.

class FoamFound {
 public:
  struct Row {
    const int *partners;
    int size;
  };
  struct List {    // see ListedPairs in foam_rows_kokkos.h
    const Row *rows;
    int inum;    // owned bubbles and ghosts
    static constexpr bool IN_ORDER = true;
    int index(int n) const { return n; }
    template <class Visit> FOAM_ALWAYS_INLINE void for_each(int i, const Visit &visit) const
    {
      const Row row = rows[i];
      for (int m = 0; m < row.size; m++) visit(row.partners[m]);
    }
  };

  template <int D, class DeviceType>
  List find(const FoamKokkos<DeviceType> &space, int nlocal, int nall,
            const Foam::Cells::Near &near);
  double bytes() const;

 private:
  struct alignas(64) Slice {    // of bubbles, the work of a thread: no two in a line of the cache
    std::vector<int> partners, found;
  };
  Foam::Cells cells;
  std::vector<Row> rows;
  std::vector<Slice> slices;

  template <int D, class B> struct Search {
    static constexpr const char *NAME = "foam: find pairs";
    B b;
    const Foam::Cells *cells;
    Foam::Cells::Near near;
    Slice *slices;
    Row *rows;
    int nlocal, nall, threads;
    void operator()(int s) const
    {
      Slice &slice = slices[s];
      slice.partners.clear();
      each(s, [&](int i) { rows[i].size = search(i, slice); });
      const int *next = slice.partners.data();    // it moves no more
      each(s, [&](int i) {
        rows[i].partners = next;
        next += rows[i].size;
      });
    }
    int search(int i, Slice &slice) const
    {
      const size_t before = slice.partners.size();
      const int many = cells->find<D>(b, i, near, slice.found);
      for (int m = 0; m < many; m++)
        if (Foam::is_in_own_row(b, i, slice.found[m], nlocal))
          slice.partners.push_back(slice.found[m]);
      return static_cast<int>(slice.partners.size() - before);
    }

    // owned bubbles have more to do than ghosts

    template <class Visit> void each(int s, const Visit &visit) const
    {
      range(s, 0, nlocal, visit);
      range(s, nlocal, nall, visit);
    }
    template <class Visit> void range(int s, int begin, int end, const Visit &visit) const
    {
      const int length = (end - begin + threads - 1) / threads, first = begin + s * length;
      for (int i = first; i < first + length && i < end; i++) visit(i);
    }
  };
};

template <int D, class DeviceType>
FoamFound::List FoamFound::find(const FoamKokkos<DeviceType> &space, int nlocal, int nall,
                                const Foam::Cells::Near &near)
{
  const auto b = space.bubbles();
  cells.sort<D>(b, nlocal, nall, near);
  rows.resize(nall);
  const int threads = DeviceType().concurrency();
  slices.resize(threads);
  space.for_all(threads, Search<D, decltype(b)>{b, &cells, near, slices.data(), rows.data(), nlocal,
                                                nall, threads});
  return {rows.data(), nall};
}

inline double FoamFound::bytes() const
{
  double all = cells.bytes() + sizeof(Row) * double(rows.capacity());
  for (const Slice &slice : slices)
    all += sizeof(int) * double(slice.partners.capacity() + slice.found.capacity());
  return all;
}

}    // namespace LAMMPS_NS

#endif
