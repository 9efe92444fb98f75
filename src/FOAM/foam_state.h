/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_STATE_H
#define LMP_FOAM_STATE_H

#include "foam_gas.h"
#include "foam_stepper.h"

// The state of an integrator, its rates, and what is done with it whatever the scheme

namespace Foam {

// f = (v, qdot) of the state evaluated last, from the sums over contacts and the forces

template <int D, class B> struct Rates {
  B b;
  double mu0;
  const double *contacts = nullptr, *vsum[3] = {};    // with drag relative to neighbors
  Sums drift{};                                       // of all velocities; 0 unless taken off
  bool drift_removed = false;
  Exchange<D> gas{};
  Variable variable = Variable::VOLUME;

  FOAM_FUNCTION double velocity(int i, int k) const
  {
    if (!(b.radius(i) > 0.0)) return 0.0;
    const double u = contacts ? mean_of_neighbors(vsum[k][i], contacts[i]) : 0.0;
    double v = drag_velocity(b.f(i, k), mu0, u);
    if (drift_removed && drift[3] > 0.0) v -= drift[k] / drift[3];
    return v;
  }
  FOAM_FUNCTION double qdot(int i) const
  {
    const double R = b.radius(i);
    const typename Exchange<D>::Split split = gas(i, R);
    return q_rate<D>(variable, split.film + split.liquid, R);
  }
};

template <int D, class B> struct DriftSums {
  static constexpr const char *NAME = "foam: drift";
  static constexpr int SLOT = 1;
  Rates<D, B> rates;
  FOAM_FUNCTION void operator()(int i, SumsOfOne &all) const
  {
    for (int k = 0; k < D; k++) all.sum[k] += rates.velocity(i, k);
    if (rates.b.radius(i) > 0.0) all.sum[3] += 1.0;
  }
};

// ---------------------------------------------------------------------- the state of an integrator

// Columns of FixFoamIntegrate: y = (x, q), f = (v, qdot); n is the state at the start of the
// step, n-1 the one before it, x and radius in LAMMPS are those of the candidate

template <class B> struct State {
  B b;
  double *q, *qdot;
  double *v_before[3], *qdot_before;              // f_{n-1}
  double *x_start[3], *q_start, *radius_start;    // y_n
  double *v_start[3];                             // v_n where LAMMPS' v is l; else null
  double *lag[3];                                 // l of f_n; null with static drag
  double *x_listed[3], *radius_listed;            // when the neighbor list was built
  double *v_next[3], *qdot_next;                  // f_{n+1}, where the corrector has it; else null
  bool counts;    // bubbles may be removed: count them, sum their gas
  bool grows;     // gas is exchanged, radii change
  Variable variable;

  FOAM_FUNCTION double v(int i, int k) const { return v_start[0] ? v_start[k][i] : b.v(i, k); }
};

template <int D, class B> FOAM_FUNCTION void put_gas(const State<B> &s, int i, double q)
{
  s.q[i] = q;
  s.b.radius(i) = radius_of<D>(s.variable, q);
}

// At the first attempt of a step y_n is kept, and with neighbor drag v_n too: LAMMPS' v, also
// that of ghosts, then is l, where the pair style finds it.

template <int D, class B> FOAM_FUNCTION void keep_start(const State<B> &s, int i)
{
  for (int k = 0; k < D; k++) {
    s.x_start[k][i] = s.b.place(i, k);
    if (s.v_start[0]) {
      const double v = s.b.v(i, k);
      s.v_start[k][i] = v;
      s.b.v(i, k) = lagged_velocity(v, s.lag[k][i]);
    }
  }
  if (s.grows) {
    s.q_start[i] = s.q[i];
    s.radius_start[i] = s.b.radius(i);
  }
}

template <int D, class B> struct KeepStart {
  static constexpr const char *NAME = "foam: keep start";
  State<B> s;
  FOAM_FUNCTION void operator()(int i) const { keep_start<D>(s, i); }
};

template <int D, class B> struct ReturnToStart {
  static constexpr const char *NAME = "foam: return to start";
  State<B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < D; k++) {
      s.b.put(i, k, s.x_start[k][i]);
      if (s.v_start[0]) s.b.v(i, k) = s.v_start[k][i];
    }
    if (s.grows) {
      s.q[i] = s.q_start[i];
      s.b.radius(i) = s.radius_start[i];
    }
  }
};

template <class B> struct TakeListed {
  static constexpr const char *NAME = "foam: take listed";
  State<B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < 3; k++) s.x_listed[k][i] = s.b.place(i, k);
    s.radius_listed[i] = s.b.radius(i);
  }
};

// how far a bubble has moved and grown since then

template <int D, class B> FOAM_FUNCTION double from_listed(const State<B> &s, int i, double R)
{
  double square = 0.0;
  for (int k = 0; k < D; k++) {
    const double d = s.b.place(i, k) - s.x_listed[k][i];
    square += d * d;
  }
  const double growth = s.counts ? R - s.radius_listed[i] : 0.0;
  return std::sqrt(square) + (growth > 0.0 ? growth : 0.0);
}

// Everything that has to be known of a candidate, over all ranks at once: its error, whether
// the list still holds, and the bubbles that it would leave

enum JudgedSum { BUBBLES, RADII, GAS, REMOVED, GAS_REMOVED, SQUARES, BAD };
enum JudgedMax { ERROR, MOVED, AHEAD, LARGEST };

template <int D, class B> struct Judge {
  State<B> s;
  double smallest;    // radius below which a bubble is removed

  // moved: how far its evaluated states were from the listed one

  FOAM_FUNCTION void operator()(int i, double error, double squares, double moved,
                                FoamTotals &all) const
  {
    raise(all.max[ERROR], error);
    all.sum[SQUARES] += squares;
    raise(all.max[MOVED], moved);
    const double R = s.b.radius(i), q = s.q[i], R_start = s.grows ? s.radius_start[i] : R;
    if (!(R_start > 0.0)) return;    // dead already

    // as far from the listed state as the next step goes if it repeats this one

    double square = 0.0;
    for (int k = 0; k < D; k++) {
      const double ahead = 2.0 * s.b.place(i, k) - s.x_start[k][i] - s.x_listed[k][i];
      square += ahead * ahead;
    }
    const double growth = s.counts ? 2.0 * R - R_start - s.radius_listed[i] : 0.0;
    raise(all.max[AHEAD], std::sqrt(square) + (growth > 0.0 ? growth : 0.0));
    raise(all.max[AHEAD], from_listed<D>(s, i, R));
    if (!std::isfinite(square) || !std::isfinite(q)) all.sum[BAD] += 1.0;

    if (!s.counts) {    // nobody asks for their sums
      all.sum[BUBBLES] += 1.0;
    } else if (vanished(R, q, smallest)) {
      all.sum[REMOVED] += 1.0;
      all.sum[GAS_REMOVED] += gas_content<D>(s.variable, q);
    } else {
      all.sum[BUBBLES] += 1.0;
      all.sum[RADII] += R;
      all.sum[GAS] += gas_content<D>(s.variable, q);
      raise(all.max[LARGEST], R);
    }
  }

 private:
  FOAM_FUNCTION static void raise(double &most, double value)
  {
    if (value > most) most = value;
  }
};

// The smallest bubbles are removed, and their gas is shared out: a removed bubble stays as a
// dead one of radius 0 until the next list build

template <int D, class B> struct Redistribute {
  static constexpr const char *NAME = "foam: redistribute";
  State<B> s;
  double smallest, factor;    // of q
  FOAM_FUNCTION void operator()(int i) const
  {
    if (vanished(s.b.radius(i), s.q[i], smallest)) {
      s.q[i] = s.qdot[i] = s.qdot_before[i] = 0.0;
      for (int k = 0; k < 3; k++) s.v_before[k][i] = 0.0;
      for (int k = 0; k < 3; k++) s.b.v(i, k) = 0.0;
      s.b.radius(i) = 0.0;
    } else {
      put_gas<D>(s, i, factor * s.q[i]);
    }
  }
};

template <class B> struct LargestRadius {
  static constexpr const char *NAME = "foam: largest radius";
  B b;
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    if (b.radius(i) > all.max[LARGEST]) all.max[LARGEST] = b.radius(i);
  }
};

struct CountBubbles {
  static constexpr const char *NAME = "foam: count bubbles";
  FOAM_FUNCTION void operator()(int, FoamTotals &all) const { all.sum[BUBBLES] += 1.0; }
};

// f_n becomes f_{n-1}, and f_{n+1}, if known, f_n

template <int D, class B> FOAM_FUNCTION void keep_history(const State<B> &s, int i)
{
  for (int k = 0; k < D; k++) s.v_before[k][i] = s.v(i, k);
  s.qdot_before[i] = s.qdot[i];
  if (!s.qdot_next) return;
  for (int k = 0; k < D; k++) s.b.v(i, k) = s.v_next[k][i];
  s.qdot[i] = s.grows ? s.qdot_next[i] : 0.0;
}

template <int D, class B> struct KeepHistory {
  static constexpr const char *NAME = "foam: keep history";
  State<B> s;
  FOAM_FUNCTION void operator()(int i) const { keep_history<D>(s, i); }
};

// the rates of the new state

template <int D, class B> struct TakeRates {
  static constexpr const char *NAME = "foam: take rates";
  State<B> s;
  Rates<D, B> rates;
  bool history, lagged;    // is f_n to be kept; does LAMMPS' v hold l
  FOAM_FUNCTION void operator()(int i) const
  {
    if (history) keep_history<D>(s, i);
    for (int k = 0; k < 3; k++) {
      const double l = s.b.v(i, k);
      s.b.v(i, k) = k < D ? rates.velocity(i, k) : 0.0;
      if (lagged) s.lag[k][i] = l;
    }
    s.qdot[i] = s.grows ? rates.qdot(i) : 0.0;
  }
};

}    // namespace Foam

#endif
