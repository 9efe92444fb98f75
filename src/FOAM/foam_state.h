/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_STATE_H
#define LMP_FOAM_STATE_H

#include "foam_drag.h"
#include "foam_gas.h"
#include "foam_scheme.h"
#include "foam_stepper.h"

// The equations of a foam as fields: y = (x, q), f = (v, qdot), and what a step of them has to be judged by

namespace Foam {

// f of the state evaluated last, from the forces and the sums over contacts

template <int D, class B> struct Rates {
  B b;
  Drag<D, B> drag;
  Exchange<D> gas{};
  Variable variable = Variable::VOLUME;
  bool grows = false;

  FOAM_FUNCTION double qdot(int i) const
  {
    const typename Exchange<D>::Split split = gas(b, i);
    return q_rate<D>(variable, split.film + split.liquid, b.radius(i));
  }
  FOAM_FUNCTION void operator()(int i, double *f) const
  {
    for (int k = 0; k < D; k++) f[k] = drag.velocity(i, k);
    f[3] = grows ? qdot(i) : 0.0;
  }
  bool is_plain() const    // see foam_vectors.h
  {
    return drag.is_plain() && gas.is_plain() && variable == Variable::VOLUME && grows;
  }
};

// Columns of FixFoamIntegrate, one of each kind for each field: x, y, z, q; values and rates of the first three
// are LAMMPS' own.  n is the state at the start of the step, n-1 the one before it, x and radius in LAMMPS are
// those of the candidate.

template <class B> struct State {
  static constexpr int MOST = 4, GAS = 3;
  B b;
  double *q{}, *qdot{};
  double *start[MOST]{}, *radius_start{};     // y_n
  double *before[MOST]{};                     // f_{n-1}
  double *next[MOST]{};                       // f_{n+1}, where the scheme has it; else null
  double *x_listed[3]{}, *radius_listed{};    // when the neighbor list was built
  VelocityLag lag{};
  bool counts = false;    // bubbles may be removed: count them, sum their gas
  bool grows = false;     // gas is exchanged, radii change
  Variable variable = Variable::VOLUME;
  double q_unit = 1.0;    // dq / dR at <R_in>
  double range = 0.0;     // of forces, in radii; 0 where radii do not change

  // a box that deforms under bubbles that go with it: where it has taken the places of the list to, and will have at
  // the end of the next step

  bool box_moves = false;
  AffineMap listed_now{}, listed_ahead{};

  FOAM_FUNCTION double place_listed(int i, int k, const AffineMap &map) const
  {
    if (!box_moves) return x_listed[k][i];
    const double x[3] = {x_listed[0][i], x_listed[1][i], x_listed[2][i]};
    return map(x, k);
  }
};

template <int D, class B> FOAM_FUNCTION void put_gas(const State<B> &s, int i, double q)
{
  s.q[i] = q;
  s.b.radius(i) = radius_of<D>(s.variable, q);
}

template <int D, class B> struct Fields : State<B> {
  using State<B>::MOST;

  struct Place {
    const Fields &s;
    const int number;
    FOAM_FUNCTION double value(int i) const { return s.b.place(i, number); }
    FOAM_FUNCTION void put(int i, double x) const { s.b.put(i, number, x); }
    FOAM_FUNCTION double &start(int i) const { return s.start[number][i]; }
    FOAM_FUNCTION double rate(int i) const { return s.lag.v(s.b, i, number); }
    FOAM_FUNCTION void put_rate(int i, double v) const { s.lag.put_v(s.b, i, number, v); }
    FOAM_FUNCTION double &before(int i) const { return s.before[number][i]; }
    FOAM_FUNCTION double move(int i, double x) const
    {
      const double before = value(i);
      put(i, x);
      return x - before;
    }
    FOAM_FUNCTION double measure(int, double change) const { return change; }
    FOAM_FUNCTION double unit() const { return 1.0; }
  };
  struct Gas {
    const Fields &s;
    static constexpr int number = State<B>::GAS;
    FOAM_FUNCTION double value(int i) const { return s.q[i]; }
    FOAM_FUNCTION void put(int i, double q) const { put_gas<D>(s, i, q); }
    FOAM_FUNCTION double &start(int i) const { return s.start[number][i]; }
    FOAM_FUNCTION double rate(int i) const { return s.qdot[i]; }
    FOAM_FUNCTION void put_rate(int i, double qdot) const { s.qdot[i] = qdot; }
    FOAM_FUNCTION double &before(int i) const { return s.before[number][i]; }
    FOAM_FUNCTION double move(int i, double q) const
    {
      const double before = s.b.radius(i);
      put(i, q);
      return s.b.radius(i) - before;
    }

    // An error of gas as one of the radius, of a bubble as large as now or at the start of the step.  One that is used
    // up, now, has no radius to be wrong by: its gas goes to others, so a bubble of the radius <R_in> is asked.
    // Where R itself is the variable there is no such bound to miss: what is left of R + change.

    FOAM_FUNCTION double measure(int i, double change) const
    {
      const double R = s.b.radius(i), R_start = s.radius_start[i];
      if (s.variable == Variable::RADIUS) return radius_of<D>(s.variable, s.q[i] + change) - R;
      const double slope = slope_of_power<D>(R < R_start ? R_start : R);
      return change / (s.used_up(i) & (slope < s.q_unit) ? s.q_unit : slope);
    }
    FOAM_FUNCTION double unit() const { return s.q_unit; }
  };

  template <class Visit> FOAM_FUNCTION void each(Visit &&visit) const
  {
    for (int k = 0; k < D; k++) visit(Place{*this, k});
    if (this->grows) visit(Gas{*this});
  }

  bool is_plain() const    // see foam_vectors.h
  {
    return !this->lag.exists() && !this->box_moves && this->variable == Variable::VOLUME &&
           this->grows;
  }

  FOAM_FUNCTION void keep_start(int i) const
  {
    for (int k = 0; k < D; k++) this->lag.begin(this->b, i, k);
    each([&](const auto &field) { field.start(i) = field.value(i); });
    if (this->grows) this->radius_start[i] = this->b.radius(i);
  }
  FOAM_FUNCTION void rewind(int i) const
  {
    for (int k = 0; k < D; k++) this->lag.rewind(this->b, i, k);
  }
  FOAM_FUNCTION void after_stage(int i, const double *f) const
  {
    for (int k = 0; k < D; k++) this->lag.follow(this->b, i, k, f[k]);
  }
  FOAM_FUNCTION void after_start(int i) const
  {
    for (int k = 0; k < D; k++) this->lag.keep(this->b, i, k);
  }
  FOAM_FUNCTION FoamLength reach(int i) const { return from_listed(i, this->b.radius(i)); }
  FOAM_FUNCTION bool alive(int i) const { return this->b.radius(i) > 0.0; }

  // A bubble used up at some stage does not come back at a later one. There its rate is 0, so that the end of
  // the step would find it with a little gas of either sign, and it might last for another step.

  FOAM_FUNCTION bool used_up(int i) const { return this->b.radius(i) == 0.0; }
  FOAM_FUNCTION void keep_used_up(int i) const { this->b.radius(i) = 0.0; }
  FOAM_FUNCTION double seed(int i) const { return this->b.tag(i); }

  // how far a bubble has moved and grown since the list was built

  FOAM_FUNCTION FoamLength from_listed(int i, double R) const
  {
    double square = 0.0;
    for (int k = 0; k < D; k++) {
      const double d = this->b.place(i, k) - this->place_listed(i, k, this->listed_now);
      square += d * d;
    }
    return {square, growth(R - this->radius_listed[i])};
  }

  // the same in the next step, if it goes as far as this one

  FOAM_FUNCTION FoamLength ahead(int i, double R, double R_start) const
  {
    double square = 0.0;
    for (int k = 0; k < D; k++) {
      const double d = 2.0 * this->b.place(i, k) - this->start[k][i] -
                       this->place_listed(i, k, this->listed_ahead);
      square += d * d;
    }
    return {square, growth(2.0 * R - R_start - this->radius_listed[i])};
  }

 private:
  FOAM_FUNCTION double growth(double dR) const
  {
    return 0.5 * this->range * (dR + std::fabs(dR));    // range max(dR, 0), without a branch
  }
};

// Everything that has to be known of a candidate, over all ranks at once: its error, whether
// the list still holds, and the bubbles that it would leave

struct Judgement {
  FoamMax error, moved, ahead, radius_max;    // moved, ahead: from the listed state
  FoamSum bubbles, radii, gas, removed, gas_removed;
  FoamSum squares, bad;    // of errors; bubbles of which something is no number

  FOAM_FUNCTION void join(const Judgement &other)
  {
    error.join(other.error);
    moved.join(other.moved);
    ahead.join(other.ahead);
    radius_max.join(other.radius_max);
    bubbles.join(other.bubbles);
    radii.join(other.radii);
    gas.join(other.gas);
    removed.join(other.removed);
    gas_removed.join(other.gas_removed);
    squares.join(other.squares);
    bad.join(other.bad);
  }
};

template <int D, class B> struct Judge {
  using Totals = Judgement;
  Fields<D, B> s;
  double smallest;    // radius below which a bubble is removed

  bool is_plain() const { return s.is_plain(); }

  struct Look {
    double ahead;    // how far from the listed state, now or in the next step
    double bad;      // 1 if something is no number
  };
  FOAM_FUNCTION Look look(int i) const
  {
    const double R = s.b.radius(i), R_start = s.grows ? s.radius_start[i] : R;
    const double ahead = s.ahead(i, R, R_start), now = s.from_listed(i, R);
    return {now > ahead ? now : ahead, std::isfinite(ahead) & std::isfinite(s.q[i]) ? 0.0 : 1.0};
  }

  FOAM_FUNCTION void operator()(int i, const Moved<Look> &moved, Judgement &all) const
  {
    all.error.raise(moved.error.largest);
    all.squares += moved.error.squares;
    all.moved.raise(moved.reach);
    const double R = s.b.radius(i), q = s.q[i];
    if (!((s.grows ? s.radius_start[i] : R) > 0.0)) return;    // dead already

    all.ahead.raise(moved.look.ahead);
    all.bad += moved.look.bad;

    if (!s.counts) {    // nobody asks for their sums
      all.bubbles += 1.0;
    } else if (vanished(R, q, smallest)) {
      all.removed += 1.0;
      all.gas_removed += gas_content<D>(s.variable, s.variable == Variable::RADIUS ? R : q);
    } else {
      all.bubbles += 1.0;
      all.radii += R;
      all.gas += gas_content<D>(s.variable, q);
      all.radius_max.raise(R);
    }
  }
};

// ---------------------------------------------------------------------- between attempts and steps

template <int D, class B> struct ReturnToStart {
  static constexpr const char *NAME = "foam: return to start";
  Fields<D, B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < D; k++) {
      s.b.put(i, k, s.start[k][i]);
      s.lag.give_up(s.b, i, k);
    }
    if (s.grows) {
      s.q[i] = s.start[s.GAS][i];
      s.b.radius(i) = s.radius_start[i];
    }
  }
};

// the way that an accepted step has gone, straight

template <int D, class B> struct AddToPath {
  static constexpr const char *NAME = "foam: add to path";
  State<B> s;
  double *path;
  FOAM_FUNCTION void operator()(int i) const
  {
    double squared = 0.0;
    for (int k = 0; k < D; k++) {
      const double way = s.b.place(i, k) - s.start[k][i];
      squared += way * way;
    }
    path[i] += sqrt(squared);
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

// The smallest bubbles are removed, and their gas is shared out: a removed bubble stays as a
// dead one of radius 0 until the next list build

template <int D, class B> struct Redistribute {
  static constexpr const char *NAME = "foam: redistribute";
  State<B> s;
  double smallest, factor;    // of q
  FOAM_FUNCTION void operator()(int i) const
  {
    if (vanished(s.b.radius(i), s.q[i], smallest)) {
      s.q[i] = s.qdot[i] = 0.0;
      for (int n = 0; n < s.MOST; n++) s.before[n][i] = 0.0;
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
  FOAM_FUNCTION void operator()(int i, FoamMax &all) const { all.raise(b.radius(i)); }
};

struct CountBubbles {
  static constexpr const char *NAME = "foam: count bubbles";
  FOAM_FUNCTION void operator()(int, FoamSum &all) const { all += 1.0; }
};

// f_n becomes f_{n-1}, and f_{n+1}, if known, f_n

template <int D, class B> FOAM_FUNCTION void keep_history(const Fields<D, B> &s, int i)
{
  for (int k = 0; k < D; k++) s.before[k][i] = s.lag.v(s.b, i, k);
  s.before[s.GAS][i] = s.qdot[i];
  if (!s.next[0]) return;
  for (int k = 0; k < D; k++) s.b.v(i, k) = s.next[k][i];
  s.qdot[i] = s.grows ? s.next[s.GAS][i] : 0.0;
}

template <int D, class B> struct KeepHistory {
  static constexpr const char *NAME = "foam: keep history";
  Fields<D, B> s;
  FOAM_FUNCTION void operator()(int i) const { keep_history<D>(s, i); }
};

// the rates of the new state: the step is over, and LAMMPS' v is that of the bubbles

template <int D, class B> struct TakeRates {
  static constexpr const char *NAME = "foam: take rates";
  Fields<D, B> s;
  Rates<D, B> rates;
  bool history;    // is f_n to be kept
  FOAM_FUNCTION void operator()(int i) const
  {
    if (history) keep_history<D>(s, i);
    double f[State<B>::MOST];
    rates(i, f);
    for (int k = 0; k < 3; k++) {
      s.lag.keep(s.b, i, k);
      s.b.v(i, k) = k < D ? f[k] : 0.0;
    }
    s.qdot[i] = f[s.GAS];
  }
  bool is_plain() const { return s.is_plain() && !s.next[0] && rates.is_plain(); }
};

}    // namespace Foam

#endif
