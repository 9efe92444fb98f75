/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "foam_lag.h"

#include "atom.h"

using namespace LAMMPS_NS;

// The forces that LAMMPS computes before a run are those with which the last run ended, if neighbor drag takes
// the same velocities as given.  Velocities that a command has set since stay.

void FoamLag::give(Foam::Members is_bubble)
{
  if (known == 0.0) return;
  double *const *const v = atom->v;
  for (int i = 0; i < atom->nlocal; i++) {
    bool same = is_bubble(i);
    for (int k = 0; k < 3; k++) same = same && v[i][k] == last(k, i);
    if (same)
      for (int k = 0; k < 3; k++) v[i][k] = columns[LAGX + k][i];
  }
}

void FoamLag::keep_last()
{
  if (!columns.in_use()) return;
  for (int i = 0; i < atom->nlocal; i++) keep_last(i);
}

void FoamLag::keep_last(int i)
{
  for (int k = 0; k < 3; k++) columns[LASTX + k][i] = atom->v[i][k];
}
