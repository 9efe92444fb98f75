/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_REDUCE_H
#define LMP_FOAM_REDUCE_H

#include "foam_physics.h"

#include <mpi.h>

namespace LAMMPS_NS {

// Sums and maxima over bubbles: join() makes one of two, on the host and on a device, and
// FoamReduce over all ranks, in one MPI_Allreduce instead of two.

struct FoamTotals {
  static constexpr int SUMS = 7, MAXIMA = 4;
  double sum[SUMS] = {};
  double max[MAXIMA] = {};

  FOAM_FUNCTION void join(const FoamTotals &other)
  {
    for (int m = 0; m < SUMS; m++) sum[m] += other.sum[m];
    for (int m = 0; m < MAXIMA; m++)
      if (other.max[m] > max[m]) max[m] = other.max[m];
  }
};

class FoamReduce {
 public:
  explicit FoamReduce(MPI_Comm comm) : world(comm)
  {
    MPI_Comm_size(world, &ranks);
    MPI_Type_contiguous(sizeof(FoamTotals) / sizeof(double), MPI_DOUBLE, &type);
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

  FoamTotals operator()(FoamTotals mine) const
  {
    if (ranks == 1) return mine;
    FoamTotals all;
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
    const auto *a = static_cast<const FoamTotals *>(in);
    auto *b = static_cast<FoamTotals *>(inout);
    for (int k = 0; k < *n; k++) b[k].join(a[k]);
  }
};

}    // namespace LAMMPS_NS

#endif
