/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_FOAM_RECORDS_H
#define LMP_FIX_FOAM_RECORDS_H

#include "fix_foam_travelling.h"
#include "foam_history.h"

namespace LAMMPS_NS {

// A fix that keeps records of contacts (FoamHistory): they travel with the bubbles and stand in restart files.  What is
// in them, and when they change, is the matter of the style.

class FixFoamRecords : public FixFoamTravelling {
 public:
  FixFoamRecords(class LAMMPS *, int, char **, int values_of_a_contact);
  ~FixFoamRecords() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void min_pre_exchange() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

 protected:
  FoamHistory history;

  void keep_records();                // at the end of the constructor: size_peratom_cols is known
  void make_room(int most);           // in the records of a bubble
  virtual void look_at(int i) = 0;    // into array_atom, between two runs

 private:
  int exchange_foreseen = 0;
};

}    // namespace LAMMPS_NS

#endif
