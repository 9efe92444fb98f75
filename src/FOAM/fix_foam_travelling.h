/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_FOAM_TRAVELLING_H
#define LMP_FIX_FOAM_TRAVELLING_H

#include "fix.h"
#include "foam_columns.h"

namespace LAMMPS_NS {

// A fix with columns, some of which travel with the bubbles and stand in restart files

class FixFoamTravelling : public Fix {
 public:
  FixFoamTravelling(class LAMMPS *, int, char **);
  ~FixFoamTravelling() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;    // of a new bubble: 0
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

 protected:
  FoamColumnList all_columns;
  enum : unsigned { STAYS = 1, TRAVELS = 2 };    // kinds of columns
  FoamColumnList travelling() const { return chosen(all_columns, TRAVELS); }

  // Columns that were in use when a restart file was written are so again, if they are wanted

  virtual bool wanted(const FoamColumns &) const { return true; }

  // The last that a constructor does: a constructor that ends in an error has no callbacks to take back,
  // and LAMMPS, asked to, would end the program.

  void add_callbacks();
  static const double *of_restart(const class Atom *, int i, int nth);    // its numbers

 private:
  bool called_back = false;
};

}    // namespace LAMMPS_NS

#endif
