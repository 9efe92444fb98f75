/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_ORDER_H
#define LMP_FOAM_ORDER_H

#include "lammps_compat.h"

#include "atom.h"
#include "lammps.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace LAMMPS_NS {

// The atoms of this rank in the order of their IDs, with all that fixes keep of them.  Ghosts must be made anew.

inline void foam_order_by_tag(LAMMPS *lmp)
{
  Atom &atom = *lmp->atom;
  const int n = atom.nlocal;
  const tagint *const tag = atom.tag;
  std::vector<int> from(n);
  std::iota(from.begin(), from.end(), 0);
  std::sort(from.begin(), from.end(), [=](int i, int j) { return tag[i] < tag[j]; });
  if (n == atom.nmax) atom.avec->grow(0);    // for the one place more

  // each cycle of the permutation by way of a place beyond the last atom

  for (int first = 0; first < n; first++) {
    if (from[first] == first) continue;
    atom.avec->copy(first, n, 0);
    int empty = first;
    while (from[empty] != first) {
      const int next = from[empty];
      atom.avec->copy(next, empty, 0);
      from[empty] = empty;
      empty = next;
    }
    atom.avec->copy(n, empty, 0);
    from[empty] = empty;
  }
}

}    // namespace LAMMPS_NS

#endif
