/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_ABM_H
#define LMP_FOAM_ABM_H

#include "foam_state.h"

// Functors of fix foam/abm: predictor and corrector, see foam_stepper.h

namespace Foam {

template <int D, class B> struct Predict {
  static constexpr const char *NAME = "foam: predict";
  State<B> s;
  Predictor p;
  bool first;    // attempt of this step
  FOAM_FUNCTION void operator()(int i) const
  {
    if (first) keep_start<D>(s, i);
    for (int k = 0; k < D; k++)
      s.b.put(i, k, predict(s.x_start[k][i], s.v(i, k), s.v_before[k][i], p));
    if (s.grows) put_gas<D>(s, i, predict(s.q_start[i], s.qdot[i], s.qdot_before[i], p));
  }
};

// The error of a component is the distance of corrector and predictor

template <int D, class B> struct Correct {
  static constexpr const char *NAME = "foam: correct and judge";
  State<B> s;
  Rates<D, B> rates;
  Judge<D, B> judge;
  double step;
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    double largest = 0.0, squares = 0.0;
    double corrected[D];
    const double moved = from_listed<D>(s, i, s.b.radius(i));
    for (int k = 0; k < D; k++) {
      const double predicted = s.b.place(i, k);
      const double velocity = rates.velocity(i, k);
      corrected[k] = correct(s.x_start[k][i], s.v(i, k), velocity, step);
      if (s.qdot_next) s.v_next[k][i] = velocity;
      const double error = std::fabs(corrected[k] - predicted);
      if (error > largest) largest = error;
      squares += error * error;
    }
    if (s.grows) {
      const double predicted = s.b.radius(i);
      const double qdot = rates.qdot(i);
      s.q[i] = correct(s.q_start[i], s.qdot[i], qdot, step);
      if (s.qdot_next) s.qdot_next[i] = qdot;
      const double R = radius_of<D>(s.variable, s.q[i]);
      s.b.radius(i) = R;
      const double error = std::fabs(R - predicted);
      if (error > largest) largest = error;
      squares += error * error;
    }
    for (int k = 0; k < D; k++) s.b.put(i, k, corrected[k]);
    judge(i, largest, squares, moved, all);
  }
};

}    // namespace Foam

#endif
