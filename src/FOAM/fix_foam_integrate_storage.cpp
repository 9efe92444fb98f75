/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

// FixFoamIntegrate: its numbers of each bubble, and its progress, on their way between bubbles, ranks and
// restart files

#include "fix_foam_integrate.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "update.h"

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   per-bubble numbers travel with the bubbles
------------------------------------------------------------------------- */

void FixFoamIntegrate::grow_arrays(int nmax)
{
  FixFoamTravelling::grow_arrays(nmax);
  show_path();    // elsewhere now
}

// a new bubble, of the radius that it has so far: see check_bubbles()

void FixFoamIntegrate::set_arrays(int i)
{
  FixFoamTravelling::set_arrays(i);
  if (!atom->radius_flag) return;
  const double R = atom->radius[i];
  columns[Q][i] = q_of(R);
}

int FixFoamIntegrate::pack_restart(int i, double *buf)
{
  // in mid-run the last velocities are the present ones

  if (lag.columns.in_use() && update->whichflag == 1) lag.keep_last(i);
  return FixFoamTravelling::pack_restart(i, buf);
}

// residuals only if LAMMPS keeps less here, too, and paths only if they are asked for

bool FixFoamIntegrate::wanted(const FoamColumns &its) const
{
  return &its != &residuals && (&its != &path || paths);
}

std::vector<double *> FixFoamIntegrate::progress()
{
  return {&driver.time,        &driver.h,          &driver.h_before,
          &driver.h_last,      &driver.accepted,   &driver.rejected,
          &evaluations,        &driver.error_last, &bubbles_last,
          &lag.known,          &dt_given,          &record.rin,
          &record.ain,         &record.tau,        &record.removed_bubbles,
          &record.removed_gas, &list.skin_now};
}

void FixFoamIntegrate::write_restart(FILE *fp)
{
  bubbles_last = bubbles();
  if (comm->me != 0) return;
  if (pair) record = pair->hub.record;
  std::vector<double> values{double(progress().size())};
  for (const double *one : progress()) values.push_back(*one);
  const int size = static_cast<int>(values.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(values.data(), size, 1, fp);
}

void FixFoamIntegrate::restart(char *buf)
{
  const auto *values = (const double *) buf;
  const auto all = progress();
  if (*values++ != double(all.size()))
    error->all(FLERR,
               "Fix {}: the restart file is of another version of this fix, which kept other "
               "numbers: give the fix another ID, so that it begins anew",
               style);
  for (double *one : all) *one = *values++;

  // a file that is written in a run has the step just taken for the timestep

  if (dt_given > 0.0 && update->dt == driver.h_last) set_timestep(dt_given);
}
