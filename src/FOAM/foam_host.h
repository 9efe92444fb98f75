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

#include "atom.h"
#include "pointers.h"

namespace LAMMPS_NS {

// The space in which the base styles run: bubbles and columns on the host, one thread

class FoamHost : protected Pointers {
 public:
  using Bubbles = Foam::HostBubbles;
  explicit FoamHost(LAMMPS *lmp) : Pointers(lmp) {}

  Bubbles bubbles() const
  {
    auto rows = [](double **array) {
      return Foam::Rows<double>{array ? array[0] : nullptr};
    };
    return {rows(atom->x), rows(atom->v), rows(atom->f), {atom->radius}, {atom->type}, {atom->tag}};
  }
  static double *column(FoamColumns &columns, int c)
  {
    return columns.in_use() ? columns[c] : nullptr;
  }

  template <class Body> void for_each(int n, const Body &body) const
  {
    for (int i = 0; i < n; i++) body(i);
  }
  template <class Body> FoamTotals totals(int n, const Body &body) const    // of this rank
  {
    FoamTotals mine;
    for (int i = 0; i < n; i++) body(i, mine);
    return mine;
  }
  template <class Body> Foam::Sums sums(int n, const Body &body) const    // of all ranks
  {
    Foam::SumsOfOne mine;
    for (int i = 0; i < n; i++) body(i, mine);
    Foam::Sums all;
    MPI_Allreduce(mine.sum, all.known, 4, MPI_DOUBLE, MPI_SUM, world);
    return all;
  }
};

}    // namespace LAMMPS_NS

#endif
