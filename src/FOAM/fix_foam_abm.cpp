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

FixFoamABM::FixFoamABM(LAMMPS *lmp, int narg, char **arg) : FixFoamIntegrate(lmp, narg, arg)
{
}

FixFoamIntegrate::Trial FixFoamABM::attempt(double step)
{
  return dim == 2 ? attempt_in<2>(step) : attempt_in<3>(step);
}

template <int D> FixFoamIntegrate::Trial FixFoamABM::attempt_in(double step)
{
  double *const *const x = atom->x;
  const double *const *const v = v_start;
  double *const radius = atom->radius;
  double *const q = columns[Q];
  const double *const qdot = columns[QDOT];
  const double *const v_before[3] = {columns[VX_BEFORE], columns[VY_BEFORE], columns[VZ_BEFORE]};
  const double *const qdot_before = columns[QDOT_BEFORE];
  const int nlocal = atom->nlocal;

  const Foam::Predictor p = Foam::predictor(control.scheme, step, h_before);
  Trial trial;
  for (int i = 0; i < nlocal; i++) {
    double square = 0.0, growth = 0.0;
    for (int k = 0; k < D; k++) {
      x[i][k] = Foam::predict(x_start[i][k], v[i][k], v_before[k][i], p);
      square += (x[i][k] - x_listed[i][k]) * (x[i][k] - x_listed[i][k]);
    }
    if (gas) {
      q[i] = Foam::predict(q_start[i], qdot[i], qdot_before[i], p);
      radius[i] = radius_of<D>(q[i]);
      growth = MAX(0.0, radius[i] - radius_listed[i]);
    }
    trial.moved = MAX(trial.moved, std::sqrt(square) + growth);
  }

  evaluate();

  const Velocities velocity = velocities();
  auto corrected_by = [&](double error) {
    trial.error_max = MAX(trial.error_max, error);
    trial.error_squares += error * error;
  };
  for (int i = 0; i < nlocal; i++) {
    for (int k = 0; k < D; k++) {
      const double corrected = Foam::correct(x_start[i][k], v[i][k], velocity(i, k), step);
      corrected_by(std::fabs(corrected - x[i][k]));
      x[i][k] = corrected;
    }
    if (gas) {
      const double predicted = radius[i];
      q[i] = Foam::correct(q_start[i], qdot[i], rate[i], step);
      radius[i] = radius_of<D>(q[i]);
      corrected_by(std::fabs(radius[i] - predicted));
    }
  }
  return trial;
}

void FixFoamABM::keep_history()
{
  double *const *const v = atom->v;
  double *const v_before[3] = {columns[VX_BEFORE], columns[VY_BEFORE], columns[VZ_BEFORE]};
  double *const qdot = columns[QDOT], *const qdot_before = columns[QDOT_BEFORE];
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; i++) {
    for (int k = 0; k < dim; k++) v_before[k][i] = v_start[i][k];
    qdot_before[i] = qdot[i];
  }
  if (evaluates_again()) return;

  const Velocities velocity = velocities();
  for (int i = 0; i < nlocal; i++) {
    for (int k = 0; k < dim; k++) v[i][k] = velocity(i, k);
    qdot[i] = rate[i];
  }
}

// the source takes the rates at the predicted state for those at the corrected one

bool FixFoamABM::evaluates_again() const
{
  return control.scheme == Foam::Scheme::STANDARD;
}
