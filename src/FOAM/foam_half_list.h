/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_HALF_LIST_H
#define LMP_FOAM_HALF_LIST_H

#include "neigh_list.h"

#include <type_traits>

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

}    // namespace LAMMPS_NS

#endif
