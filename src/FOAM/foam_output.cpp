/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "foam_output.h"

#include "comm.h"
#include "fix.h"
#include "modify.h"
#include "output.h"
#include "timer.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

void FoamOutput::begin_step()
{
  if (output->next_time_dump_any == update->ntimestep) dump_foreseen = update->ntimestep;
}

// Dumps by time are written at the first step that has reached their time.  LAMMPS asks for
// per-bubble energies before a step is known; where it did not, the dump waits a step.  LAMMPS itself loses a dump for
// good once a step has passed some of its times.

void FoamOutput::schedule_time_dumps(double step, double next_step)
{
  if (!output->any_time_dumps) return;
  const bigint now = update->ntimestep;
  const bool foreseen = dump_foreseen == now;
  const double after_next = update->atime + next_step;
  const double slack = 1.0e-6 * step;    // as in LAMMPS

  output->next_dump_any = output->next_time_dump_any = MAXBIGINT;
  for (int d = 0; d < output->ndump; d++) {
    if (output->mode_dump[d] == 1) {
      // LAMMPS, after a dump, goes on to the next multiple, which this step may have passed
      const double every = output->every_time_dump[d], before = update->atime - step;
      if (every > 0.0 && output->last_dump[d] == now - 1)
        output->next_time_dump[d] = (std::floor((before + slack) / every) + 1.0) * every;

      const double target = output->next_time_dump[d] - slack;
      bigint &next = output->next_dump[d];
      if (update->atime >= target && foreseen) {
        next = now;
        modify->clearstep_compute();             // LAMMPS leaves that to those who set the time
        modify->addstep_compute_all(now + 1);    // the next step may well be due again
        dump_foreseen = now + 1;
      } else if (update->atime >= target || after_next >= target)
        next = now + 1;
      else
        next = MAXBIGINT;    // looked at again in the next step
      output->next_time_dump_any = MIN(output->next_time_dump_any, next);
    }
    output->next_dump_any = MIN(output->next_dump_any, output->next_dump[d]);
  }
  output->next = MIN(MIN(output->next_dump_any, output->next_restart), output->next_thermo);
}

// will anything look at the bubbles in this step? Then the dead must be out

bool FoamOutput::due(const Fix *asking) const
{
  const bigint now = update->ntimestep;
  if (run_is_over || output->next == now || now == update->laststep) return true;
  for (int m = 0; m < modify->nfix; m++) {
    const Fix *const ifix = modify->fix[m];
    if (ifix != asking && (modify->fmask[m] & END_OF_STEP) && ifix->nevery > 0 &&
        now % ifix->nevery == 0)
      return true;
  }
  return false;
}

void FoamOutput::stop_run(const char *style, const std::string &reason)
{
  run_is_over = true;
  timer->force_timeout();    // ends the run after this step, as fix halt does
  if (comm->me == 0)
    utils::logmesg(lmp, "Fix {}: coarsening ended at step {}, t = {:.8}: {}\n", style,
                   update->ntimestep, update->atime, reason);
}

// The last state is worth a line of thermo output.  Its energy and virial were not asked for
// when the step began.

bool FoamOutput::last_line_due() const
{
  return run_is_over && output->next_thermo != update->ntimestep;
}

void FoamOutput::add_last_line()
{
  const bigint now = update->ntimestep;
  update->eflag_global = update->eflag_atom = now;
  update->vflag_global = update->vflag_atom = now;
  output->next_thermo = output->next = now;
}

void FoamOutput::end_run()
{
  if (run_is_over) timer->reset_timeout();
}
