/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_HALF_LIST_H
#define LMP_FOAM_HALF_LIST_H

#include "foam_physics.h"

#include "neigh_list.h"

#include <type_traits>

#include <vector>

namespace LAMMPS_NS {

// LAMMPS' half list as rows of pairs, see Foam::ContactLoop: each pair once, or, without NEWTON, a pair with
// a ghost on both of its sides

template <bool NEWTON> struct FoamHalfList {
  const int *ilist, *numneigh;
  const int *const *firstneigh;
  int nlocal;

  struct Row {
    int i, size;
    const int *partners;
    int nlocal;
    template <class Visit> FOAM_ALWAYS_INLINE void for_each(const Visit &visit) const
    {
      for (int m = 0; m < size; m++) {
        const int j = partners[m] & NEIGHMASK;
        if constexpr (NEWTON)
          visit(j, std::true_type());
        else
          visit(j, j < nlocal);
      }
    }
  };
  Row row(int n) const
  {
    const int i = ilist[n];
    return {i, numneigh[i], firstneigh[i], nlocal};
  }
};

// The pairs of rows, one after the other

struct FoamPairs {
  std::vector<int> first, second;

  template <class List> void take(int inum, const List &list)
  {
    first.clear();
    second.clear();
    for (int n = 0; n < inum; n++) {
      const auto row = list.row(n);
      row.for_each([&](int j, auto) {
        first.push_back(row.i);
        second.push_back(j);
      });
    }
  }
  double bytes() const { return sizeof(int) * double(first.capacity() + second.capacity()); }
};

// A copy of LAMMPS' list without the pairs that do not come near before the next one: a list by the cutoff of types has
// several times as many.

struct FoamShortList {
  std::vector<int> numneigh, partners;
  std::vector<int *> firstneigh;

  template <class Near>
  void take(int inum, const int *ilist, const int *size, int *const *rows, int nlocal,
            const Near &near)
  {
    numneigh.assign(nlocal, 0);
    firstneigh.assign(nlocal, nullptr);
    partners.clear();
    for (int n = 0; n < inum; n++) {
      const int i = ilist[n];
      for (int m = 0; m < size[i]; m++)
        if (near(i, rows[i][m] & NEIGHMASK)) {
          partners.push_back(rows[i][m]);
          numneigh[i]++;
        }
    }
    int *next = partners.data();    // it moves no more
    for (int n = 0; n < inum; n++) {
      firstneigh[ilist[n]] = next;
      next += numneigh[ilist[n]];
    }
  }
  double bytes() const
  {
    return sizeof(int) * double(numneigh.capacity() + partners.capacity()) +
           sizeof(int *) * double(firstneigh.capacity());
  }
};

}    // namespace LAMMPS_NS

#endif
