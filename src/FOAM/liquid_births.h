/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_BIRTHS_H
#define LMP_LIQUID_BIRTHS_H

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

// Bubbles that are born, and those that are taken out, before an exchange of atoms between ranks.  Who is born
// where does not depend on ranks: all are put into the order of what they come from, and numbered by it.

struct Newborn {
  double from, number;    // ID of what it comes from, and which of its children it is
  double type;
  double x[3], v[3], radius;
};

class LiquidBirths : protected Pointers {
 public:
  LiquidBirths(class LAMMPS *lmp, int groupbit, double density)
      : Pointers(lmp), groupbit(groupbit), density(density)
  {
  }
  void create(const std::vector<Newborn> &of_this_rank);    // by all ranks at once
  void remove(const std::vector<bool> &gone);               // of this rank; by all ranks at once

 private:
  int groupbit;
  double density;
  bigint present() const;    // atoms of all ranks
};

}    // namespace LAMMPS_NS

#endif
