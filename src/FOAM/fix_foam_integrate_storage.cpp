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
#include "update.h"

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   per-bubble numbers travel with the bubbles
------------------------------------------------------------------------- */

void FixFoamIntegrate::grow_arrays(int nmax)
{
  for (FoamColumns *all : travelling()) all->grow(nmax);
  show_path();    // elsewhere now
}

void FixFoamIntegrate::copy_arrays(int i, int j, int)
{
  for (FoamColumns *all : travelling()) all->copy(i, j);
}

// a new bubble, of the radius that it has so far: see check_bubbles()

void FixFoamIntegrate::set_arrays(int i)
{
  for (FoamColumns *all : travelling()) all->clear(i);
  if (!atom->radius_flag) return;
  const double R = atom->radius[i];
  columns[Q][i] = q_of(R);
}

int FixFoamIntegrate::pack_exchange(int i, double *buf)
{
  int m = 0;
  for (FoamColumns *all : travelling()) m += all->pack(i, buf + m);
  return m;
}

int FixFoamIntegrate::unpack_exchange(int i, double *buf)
{
  int m = 0;
  for (FoamColumns *all : travelling()) m += all->unpack(i, buf + m);
  return m;
}

int FixFoamIntegrate::pack_restart(int i, double *buf)
{
  // in mid-run the last velocities are the present ones

  if (lag.columns.in_use() && update->whichflag == 1) lag.keep_last(i);
  const FoamColumnList all = travelling();
  unsigned in_use = 0;
  for (size_t n = 0; n < all.size(); n++)
    if (all[n]->in_use()) in_use |= 1u << n;
  buf[0] = size_restart(i);
  buf[1] = in_use;
  return 2 + pack_exchange(i, buf + 2);
}

// What was in use when the file was written may be so again; residuals only if LAMMPS keeps less here, too, and
// paths only if they are asked for

void FixFoamIntegrate::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  for (int m = 0; m < nth; m++) extra += static_cast<int>(*extra);
  const auto in_use = static_cast<unsigned>(extra[1]);
  extra += 2;
  const FoamColumnList all = travelling();
  for (size_t n = 0; n < all.size(); n++) {
    if (!(in_use & (1u << n))) continue;
    if (all[n] != &residuals && (all[n] != &path || paths)) all[n]->use(atom->nmax);
    all[n]->unpack(i, extra);
    extra += all[n]->capacity();
  }
}

int FixFoamIntegrate::size_restart(int)
{
  int n = 2;
  for (const FoamColumns *all : travelling()) n += all->active();
  return n;
}

int FixFoamIntegrate::maxsize_restart()
{
  return 2 + capacity(travelling());
}

std::vector<double *> FixFoamIntegrate::progress()
{
  return {
      &driver.time,       &driver.h,    &driver.h_before,   &driver.h_last, &driver.accepted,
      &driver.rejected,   &evaluations, &driver.error_last, &bubbles_last,  &lag.known,
      &dt_given,          &record.rin,  &record.ain,        &record.tau,    &record.removed_bubbles,
      &record.removed_gas};
}

void FixFoamIntegrate::write_restart(FILE *fp)
{
  bubbles_last = bubbles();
  if (comm->me != 0) return;
  if (pair) record = pair->hub.record;
  std::vector<double> values;
  for (const double *one : progress()) values.push_back(*one);
  const int size = static_cast<int>(values.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(values.data(), size, 1, fp);
}

void FixFoamIntegrate::restart(char *buf)
{
  const auto *values = (const double *) buf;
  for (double *one : progress()) *one = *values++;

  // a file that is written in a run has the step just taken for the timestep

  if (dt_given > 0.0 && update->dt == driver.h_last) set_timestep(dt_given);
}

double FixFoamIntegrate::memory_usage()
{
  return bytes(all_columns);
}
