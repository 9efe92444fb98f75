/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_HOST_H
#define LMP_FOAM_HOST_H

#include "foam_columns.h"
#include "foam_bubbles.h"
#include "foam_reduce.h"
#include "foam_vectors.h"

#include "atom.h"
#include "pointers.h"

namespace LAMMPS_NS {

// The space in which the base styles run: bubbles and columns on the host, one thread.  Loops and sums are
// over the particles up to n that are bubbles; for_all() is over all of them.

class FoamHost : protected Pointers {
 public:
  using Bubbles = Foam::HostBubbles;
  explicit FoamHost(LAMMPS *lmp, int groupbit = Foam::GROUP_ALL) : Pointers(lmp), groupbit(groupbit)
  {
  }

  Bubbles bubbles() const
  {
    auto rows = [](double **array) {
      return Foam::Rows<double>{array ? array[0] : nullptr};
    };
    return {rows(atom->x), rows(atom->v), rows(atom->f), {atom->radius},
            {atom->type},  {atom->tag},   {atom->rmass}};
  }
  Foam::Members members(int group) const
  {
    return group == Foam::GROUP_ALL ? Foam::Members() : Foam::Members{atom->mask, group};
  }
  const imageint *images() const { return atom->image; }
  static double *column(FoamColumns &columns, int c)
  {
    return columns.in_use() ? columns[c] : nullptr;
  }

  template <class Functor> void for_all(int n, const Functor &functor) const
  {
    foam_loop(functor, 0, n);
  }
  template <class Functor> void for_each(int n, const Functor &functor) const
  {
    over_bubbles(n, functor);
  }
  template <class Totals, class Functor>
  FOAM_FLAT Totals totals(int n, const Functor &functor) const    // of this rank
  {
    Totals mine;
    if (groupbit == Foam::GROUP_ALL) {
      foam_totals_of(functor, 0, n, mine);
    } else {
      const Functor own = functor;
      const Foam::Members member = members(groupbit);
      for (int i = 0; i < n; i++)
        if (member(i)) own(i, mine);
    }
    return mine;
  }
  template <class Totals, class Functor>
  Foam::Sums<Totals> own_sums(int n, const Functor &functor) const    // of this rank
  {
    return {totals<Totals>(n, functor)};
  }
  template <class Totals, class Functor>
  Foam::Sums<Totals> sums(int n, const Functor &functor) const    // of all ranks
  {
    return {foam_sum(totals<Totals>(n, functor), world)};
  }

  template <class Totals> static bool reads(const Foam::Sums<Totals> &sums)    // from here
  {
    return !sums.on_device;
  }

  int groupbit;    // of the bubbles

 private:
  template <class Each> void over_bubbles(int n, const Each &each) const
  {
    if (groupbit == Foam::GROUP_ALL) return for_all(n, each);
    const Foam::Members member = members(groupbit);
    for (int i = 0; i < n; i++)
      if (member(i)) each(i);
  }
};

}    // namespace LAMMPS_NS

#endif
