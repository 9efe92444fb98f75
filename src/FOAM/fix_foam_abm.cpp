/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_abm.h"

#include "atom.h"

#include <cmath>

using namespace LAMMPS_NS;

FixFoamABM::FixFoamABM(LAMMPS *lmp, int narg, char **arg) : FixFoamIntegrate(lmp, narg, arg) {}

FixFoamIntegrate::Trial FixFoamABM::attempt(double step)
{
  double *const *const x = atom->x;
  const double *const *const v = atom->v;    // f_n
  double *const radius = atom->radius;
  double *const q = columns[Q];
  const double *const qdot = columns[QDOT];
  const int nlocal = atom->nlocal;

  const Foam::Predictor p = Foam::predictor(control.scheme, step, h_before);
  for (int i = 0; i < nlocal; i++) {
    for (int k = 0; k < dim; k++)
      x[i][k] = Foam::predict(x_start[i][k], v[i][k], columns[VX_BEFORE + k][i], p);
    if (!gas) continue;
    q[i] = Foam::predict(q_start[i], qdot[i], columns[QDOT_BEFORE][i], p);
    radius[i] = radius_of(q[i]);
  }

  evaluate();

  Trial trial;
  for (int i = 0; i < nlocal; i++) {
    trial.moved = std::fmax(trial.moved, moved_since_listed(i));
    for (int k = 0; k < dim; k++) {
      const double corrected = Foam::correct(x_start[i][k], v[i][k], velocity(i, k), step);
      const double error = std::fabs(corrected - x[i][k]);
      trial.error_max = std::fmax(trial.error_max, error);
      trial.error_squares += error * error;
      x[i][k] = corrected;
    }
    if (!gas) continue;
    q[i] = Foam::correct(q_start[i], qdot[i], rate[i], step);
    const double predicted = radius[i];
    radius[i] = radius_of(q[i]);
    const double error = std::fabs(radius[i] - predicted);
    trial.error_max = std::fmax(trial.error_max, error);
    trial.error_squares += error * error;
  }
  return trial;
}

void FixFoamABM::keep_history()
{
  double *const *const v = atom->v;
  for (int i = 0; i < atom->nlocal; i++) {
    for (int k = 0; k < dim; k++) columns[VX_BEFORE + k][i] = v[i][k];
    columns[QDOT_BEFORE][i] = columns[QDOT][i];
    if (!evaluates_again()) {
      for (int k = 0; k < dim; k++) v[i][k] = velocity(i, k);
      columns[QDOT][i] = rate[i];
    }
  }
}

// the source takes the rates at the predicted state for those at the corrected one

bool FixFoamABM::evaluates_again() const
{
  return control.scheme == Foam::Scheme::STANDARD;
}
