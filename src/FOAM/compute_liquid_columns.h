/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_COMPUTE_LIQUID_COLUMNS_H
#define LMP_COMPUTE_LIQUID_COLUMNS_H

#include "compute.h"
#include "foam_columns.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

// A compute whose words name columns of a fix: what it has found in its last evaluation

class ComputeLiquidColumns : public Compute {
 public:
  struct Quantity {
    std::string name;
    int column, place = 0;    // in which of the fix's columns, if it has several
  };

  ComputeLiquidColumns(class LAMMPS *, int, char **, const char *name,
                       const std::vector<Quantity> &known);
  ~ComputeLiquidColumns() override;
  void compute_peratom() override;
  double memory_usage() override;

  static void add_vector(std::vector<Quantity> &, const std::string &name, int column,
                         int place = 0);

 protected:
  virtual FoamColumns &columns(int place) = 0;
  virtual int members() const = 0;    // group of the fix

 private:
  std::vector<Quantity> wanted;
  int nmax = 0;
  double *vector = nullptr, **array = nullptr;
};

}    // namespace LAMMPS_NS

#endif
