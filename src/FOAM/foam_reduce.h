/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_REDUCE_H
#define LMP_FOAM_REDUCE_H

#include "foam_totals.h"

#include <mpi.h>
#include <type_traits>

namespace LAMMPS_NS {

// Totals (foam_totals.h) over all ranks, in one MPI_Allreduce

template <class Totals> class FoamReduce {
 public:
  explicit FoamReduce(MPI_Comm comm) : world(comm)
  {
    static_assert(std::is_standard_layout_v<Totals> && sizeof(Totals) % sizeof(double) == 0);
    MPI_Comm_size(world, &ranks);
    MPI_Type_contiguous(sizeof(Totals) / sizeof(double), MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
    MPI_Op_create(&combine, 1, &op);
  }
  FoamReduce(const FoamReduce &) = delete;
  FoamReduce &operator=(const FoamReduce &) = delete;
  ~FoamReduce()
  {
    MPI_Op_free(&op);
    MPI_Type_free(&type);
  }

  Totals operator()(Totals mine) const
  {
    if (ranks == 1) return mine;
    Totals all;
    MPI_Allreduce(&mine, &all, 1, type, op, world);
    return all;
  }

 private:
  MPI_Comm world;
  int ranks;
  MPI_Datatype type;
  MPI_Op op;

  static void combine(void *in, void *inout, int *n, MPI_Datatype *)
  {
    const auto *a = static_cast<const Totals *>(in);
    auto *b = static_cast<Totals *>(inout);
    for (int k = 0; k < *n; k++) b[k].join(a[k]);
  }
};

// the same where nobody keeps a FoamReduce: several ranks make its type and operation each time

template <class Totals> Totals foam_reduce(const Totals &mine, MPI_Comm comm)
{
  int ranks;
  MPI_Comm_size(comm, &ranks);
  return ranks == 1 ? mine : FoamReduce<Totals>(comm)(mine);
}

// totals that have sums alone: MPI's own sum does, in each evaluation

template <class Totals> Totals foam_sum(Totals mine, MPI_Comm comm)
{
  Totals all;
  MPI_Allreduce(&mine, &all, sizeof(Totals) / sizeof(double), MPI_DOUBLE, MPI_SUM, comm);
  return all;
}

}    // namespace LAMMPS_NS

#endif
