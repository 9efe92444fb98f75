/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_OUTPUT_H
#define LMP_FOAM_OUTPUT_H

#include "pointers.h"

#include <string>

namespace LAMMPS_NS {

class Fix;

// LAMMPS' output in a run whose steps differ in length, and which may end by itself

class FoamOutput : protected Pointers {
 public:
  explicit FoamOutput(LAMMPS *lmp) : Pointers(lmp) {}

  void begin_run() { run_is_over = false; }
  void begin_step();
  void schedule_time_dumps(double step, double next_step);    // after a step; lengths of both
  bool due(const Fix *asking) const;    // will anything else look at the bubbles in this step

  void stop_run(const char *style, const std::string &reason);    // after this step
  bool last_line_due() const;                                     // of thermo output
  void add_last_line();                                           // energies and virials are known
  void end_run();

 private:
  bool run_is_over = false;
  bigint dump_foreseen = -1;    // step for which energies of bubbles were asked for in time
};

}    // namespace LAMMPS_NS

#endif
