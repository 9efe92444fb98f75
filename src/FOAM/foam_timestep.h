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

// The timestep from now on, after the end of a step: as fix dt/reset does

inline void foam_set_timestep(LAMMPS *lmp, double step)
{
  if (lmp->update->dt == step) return;
  lmp->update->update_time();
  lmp->update->dt = step;
  lmp->update->dt_default = 0;
  if (lmp->force->pair) lmp->force->pair->reset_dt();
  for (auto &fix : lmp->modify->get_fix_list()) fix->reset_dt();
  lmp->output->reset_dt();
}

}    // namespace LAMMPS_NS

#endif
