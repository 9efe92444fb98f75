/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_TIMESTEP_H
#define LMP_FOAM_TIMESTEP_H

#include "fix.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "update.h"

namespace LAMMPS_NS {

// Who keeps the timestep hears of a new one, as from fix dt/reset

inline void foam_tell_timestep(LAMMPS *lmp, double step)
{
  lmp->update->dt = step;
  lmp->update->dt_default = 0;
  if (lmp->force->pair) lmp->force->pair->reset_dt();
  for (auto &fix : lmp->modify->get_fix_list()) fix->reset_dt();
  lmp->output->reset_dt();
}

// The timestep from now on, after the end of a step.  The time is brought up to date if it is the same, too: a run from a
// restart file takes the time in it for that of its first step.

inline void foam_set_timestep(LAMMPS *lmp, double step)
{
  lmp->update->update_time();
  if (lmp->update->dt == step) return;
  foam_tell_timestep(lmp, step);
}

// The step that is under way ends sooner

inline void foam_shorten_timestep(LAMMPS *lmp, double step)
{
  Update &update = *lmp->update;
  const bigint begun = update.ntimestep - 1;
  update.atime += static_cast<double>(begun - update.atimestep) * update.dt;
  update.atimestep = begun;
  foam_tell_timestep(lmp, step);
}

}    // namespace LAMMPS_NS

#endif
