/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_RKC_H
#define LMP_FOAM_RKC_H

#include "foam_chebyshev.h"
#include "foam_state.h"

// Functors of fix foam/rkc: the stages of a Runge-Kutta-Chebyshev step, see foam_chebyshev.h

namespace Foam {

// Between two stages x, q and radius in LAMMPS and State are Y_{j-1}, these Y_{j-2}; and how far
// the evaluated stages were from the listed state. With neighbor drag l, in LAMMPS' v, follows the
// velocities from stage to stage.

struct Stages {
  double *x_before[3], *q_before, *moved;
};

template <int D, class B> struct FirstStage {
  static constexpr const char *NAME = "foam: first stage";
  State<B> s;
  Stages y;
  double step;    // m_1 h
  bool first;     // attempt of this step
  FOAM_FUNCTION void operator()(int i) const
  {
    if (first) keep_start<D>(s, i);
    for (int k = 0; k < D; k++) {
      y.x_before[k][i] = s.x_start[k][i];
      s.b.put(i, k, s.x_start[k][i] + step * s.v(i, k));
      if (s.v_start[0]) s.b.v(i, k) = lagged_velocity(s.v_start[k][i], s.lag[k][i]);
    }
    if (s.grows) {
      y.q_before[i] = s.q_start[i];
      put_gas<D>(s, i, s.q_start[i] + step * s.qdot[i]);
    }
    y.moved[i] = 0.0;
  }
};

template <int D, class B> struct NextStage {
  static constexpr const char *NAME = "foam: next stage";
  State<B> s;
  Stages y;
  Rates<D, B> rates;    // F_{j-1}
  Chebyshev::Stage c;
  double h;
  FOAM_FUNCTION void operator()(int i) const
  {
    const double moved = from_listed<D>(s, i, s.b.radius(i));
    if (moved > y.moved[i]) y.moved[i] = moved;
    const double qdot = s.grows ? rates.qdot(i) : 0.0;
    for (int k = 0; k < D; k++) {
      const double last = s.b.place(i, k), v = rates.velocity(i, k);
      s.b.put(i, k, advance(s.x_start[k][i], last, y.x_before[k][i], v, s.v(i, k), h, c));
      y.x_before[k][i] = last;
      if (s.v_start[0]) s.b.v(i, k) = lagged_velocity(v, s.b.v(i, k));
    }
    if (s.grows) {
      const double last = s.q[i];
      put_gas<D>(s, i, advance(s.q_start[i], last, y.q_before[i], qdot, s.qdot[i], h, c));
      y.q_before[i] = last;
    }
  }
};

template <int D, class B> struct LastStage {
  static constexpr const char *NAME = "foam: last stage and judge";
  NextStage<D, B> next;
  Judge<D, B> judge;
  double place;    // c_{s-1}
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    const State<B> &s = next.s;
    double largest = 0.0, squares = 0.0;
    auto add = [&](double error) {
      error = std::fabs(error);
      if (error > largest) largest = error;
      squares += error * error;
    };
    for (int k = 0; k < D; k++)
      add(stage_error(s.x_start[k][i], s.b.place(i, k), next.rates.velocity(i, k), s.v(i, k),
                      next.h, place));
    if (s.grows) {
      const double error =
          stage_error(s.q_start[i], s.q[i], next.rates.qdot(i), s.qdot[i], next.h, place);
      add(radius_of<D>(s.variable, s.q[i] + error) - s.b.radius(i));
    }
    next(i);
    judge(i, largest, squares, next.y.moved[i], all);
  }
};

}    // namespace Foam

#endif
