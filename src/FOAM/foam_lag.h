/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAG_H
#define LMP_FOAM_LAG_H

#include "foam_columns.h"
#include "foam_drag.h"

#include "pointers.h"

namespace LAMMPS_NS {

// The velocities l that neighbor drag takes as given, beyond an evaluation: from step to step, run to run, and in
// restart files.  Within a step see Foam::VelocityLag.

class FoamLag : protected Pointers {
  FoamColumnList &all_columns;
  const unsigned TRAVELS, STAYS;    // kinds of columns

 public:
  FoamLag(LAMMPS *lmp, FoamColumnList &all, unsigned travels, unsigned stays)
      : Pointers(lmp), all_columns(all), TRAVELS(travels), STAYS(stays)
  {
  }

  bool active = false;    // does the pair style take l from v
  double known = 0.0;     // 1 if LAG and LAST are those of a previous run

  // l of the evaluation of the present velocities, and the velocities with which the last run ended

  enum { LAGX, LAGY, LAGZ, LASTX, LASTY, LASTZ, NCOLUMNS };
  FoamColumns columns{all_columns, "lagged velocities", NCOLUMNS, TRAVELS};
  FoamColumns v_start{all_columns, "velocities of the start", 3,
                      STAYS};    // v_n, while LAMMPS' v is l

  template <class Space> Foam::VelocityLag view(Space &space)
  {
    if (!active) return {};
    return {
        {space.column(v_start, 0), space.column(v_start, 1), space.column(v_start, 2)},
        {space.column(columns, LAGX), space.column(columns, LAGY), space.column(columns, LAGZ)}};
  }

  // on the host

  void give(Foam::Members is_bubble);    // to an evaluation before a run
  void keep_last();                      // the run ends
  void keep_last(int i);
  double last(int k, int i) { return columns[LASTX + k][i]; }
};

}    // namespace LAMMPS_NS

#endif
