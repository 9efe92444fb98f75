/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LOOPS_H
#define LMP_FOAM_LOOPS_H

#include "foam_chebyshev.h"
#include "foam_physics.h"
#include "foam_reduce.h"
#include "foam_stepper.h"
#include "lmptype.h"

// The bodies of all loops over bubbles, written once for base and KOKKOS styles: a body is
// called for one bubble at a time, on the host or on a device.  It holds plain pointers to
// columns, see foam_columns.h, and B, the way in which LAMMPS stores the bubbles themselves:
// HostBubbles here, Views in foam_kokkos.h.  Where its bodies run, a "space" tells (FoamHost,
// FoamKokkos): it hands out bubbles and columns, loops and sums.

namespace Foam {

using LAMMPS_NS::FoamTotals;

// ---------------------------------------------------------------------- bubbles in LAMMPS

template <class T> struct Rows {    // [n][3]
  T *first;
  FOAM_FUNCTION T &operator()(int i, int k) const { return first[3 * static_cast<size_t>(i) + k]; }
};

template <class T> struct Values {    // [n]
  T *first;
  FOAM_FUNCTION T &operator()(int i) const { return first[i]; }
};

struct HostBubbles {
  Rows<double> x, v, f;
  Values<double> radius;
  Values<int> type;
  Values<LAMMPS_NS::tagint> tag;

  FOAM_FUNCTION double place(int i, int k) const { return x(i, k); }
  FOAM_FUNCTION void put(int i, int k, double value) const { x(i, k) = value; }
};

// What one pass over the contacts gathers

enum Gather : unsigned {
  FORCE = 1,       // spring forces, energy and virial
  CONTACTS = 2,    // number of contacts
  VSUM = 4,        // sum of neighbors' velocities
  FILM = 8,        // sum of film exchange
  AREA = 16,       // sum of contact areas
  ENERGY = 32,     // each bubble's share of the energies
  DRAG = CONTACTS | VSUM,
  TO_LOOK_AT = CONTACTS | FILM | AREA | ENERGY
};

// Sums over the contacts of each bubble, as columns

struct ContactSums {
  double *contacts, *vsum[3];
  double *area;                 // sum of A_ij
  double *film;                 // sum of A_ij (1/R_j - 1/R_i)
  double *espring, *edurian;    // half of the springs' energies; energy of [L20]

  template <unsigned WHAT> FOAM_FUNCTION void clear(int i) const
  {
    if constexpr (WHAT & CONTACTS) contacts[i] = 0.0;
    if constexpr (WHAT & VSUM) vsum[0][i] = vsum[1][i] = vsum[2][i] = 0.0;
    if constexpr (WHAT & AREA) area[i] = 0.0;
    if constexpr (WHAT & FILM) film[i] = 0.0;
    if constexpr (WHAT & ENERGY) espring[i] = edurian[i] = 0.0;
  }
};

// Four sums over all bubbles of all ranks. On a device they may stay there, so that the host
// need not wait for them: then known is not.

struct Sums {
  double known[4] = {};
  const double *elsewhere = nullptr;
  FOAM_FUNCTION double operator[](int m) const { return elsewhere ? elsewhere[m] : known[m]; }
};

struct SumsOfOne {    // what one bubble adds to them
  double sum[4] = {};
  FOAM_FUNCTION void join(const SumsOfOne &other)
  {
    for (int m = 0; m < 4; m++) sum[m] += other.sum[m];
  }
};

// ---------------------------------------------------------------------- gas exchange

// Rate of gas content: Vdot_i = K sum_j A_ij (1/R_j - 1/R_i) + c w_i (1/rho - 1/R_i),
// see foam_physics.h

// What a bubble adds to the sums over all bubbles that the second part takes: their number,
// surface, weight and weight / R

template <int D>
FOAM_FUNCTION void add_free_surface(LiquidLaw law, double R, double contact_area, SumsOfOne &all)
{
  if (!(R > 0.0)) return;
  const double A = surface<D>(R), w = liquid_weight(law, free_area(A, contact_area), R);
  all.sum[0] += 1.0;
  all.sum[1] += A;
  all.sum[2] += w;
  all.sum[3] += w / R;
}

template <int D> struct Exchange {
  double K = 0.0, kappa = 0.0;
  LiquidLaw law = LiquidLaw::AREA;
  double Rin = 0.0, Ain = 0.0;
  const double *film = nullptr, *area = nullptr;    // sums over contacts, of each bubble; or none

  bool through_liquid() const { return K > 0.0 && kappa > 0.0; }

  struct Split {    // the two parts of Vdot
    double film, liquid;
  };
  struct Liquid {    // the state of the whole foam that enters the second
    double coefficient = 0.0, inverse_rho = 0.0;
  };

  FOAM_FUNCTION Liquid of(const Sums &all) const
  {
    return {liquid_coefficient(law, kappa, K, Rin, Ain, all[1] / all[0]),
            inverse_critical_radius(all[2], all[3])};
  }
  void take(const Sums &all)
  {
    sums = all;
    if (!all.elsewhere) liquid = of(all);
  }

  FOAM_FUNCTION Split operator()(int i, double R) const
  {
    if (!(R > 0.0) || !(K > 0.0)) return {0.0, 0.0};
    Split split{film ? K * film[i] : 0.0, 0.0};
    const Liquid l = sums.elsewhere ? of(sums) : liquid;
    if (l.coefficient > 0.0)
      split.liquid = liquid_exchange(l.coefficient, weight(i, R), l.inverse_rho, R);
    return split;
  }

  Liquid liquid;    // if the sums are known
  Sums sums;

 private:
  FOAM_FUNCTION double weight(int i, double R) const
  {
    return liquid_weight(law, free_area(surface<D>(R), area[i]), R);
  }
};

template <int D, class B> struct LiquidSums {
  static constexpr const char *NAME = "foam: sums of free surface";
  static constexpr int SLOT = 0;    // of the sums that stay on a device
  B b;
  LiquidLaw law;
  const double *area;
  FOAM_FUNCTION void operator()(int i, SumsOfOne &all) const
  {
    add_free_surface<D>(law, b.radius(i), area[i], all);
  }
};

// ---------------------------------------------------------------------- what compute foam/bubble shows

enum class Quantity { CONTACTS, AREA, FREE, VFILM, VLIQUID, RDOT, ESPRING, EDURIAN };

struct Quantities {
  static constexpr int MOST = 8;
  int count = 0;
  Quantity name[MOST];
};

template <int D, class B, class Masks> struct LookAt {
  static constexpr const char *NAME = "foam: look at bubbles";
  B b;
  Masks mask;
  int groupbit;
  double *out;    // [n][wanted.count]
  Quantities wanted;
  Exchange<D> gas;
  ContactSums sums;

  FOAM_FUNCTION void operator()(int i) const
  {
    const double R = b.radius(i);
    const bool counts = mask(i) & groupbit;
    const typename Exchange<D>::Split V = gas(i, R);
    for (int c = 0; c < wanted.count; c++)
      out[static_cast<size_t>(i) * wanted.count + c] =
          counts && R > 0.0 ? value(i, R, V, wanted.name[c]) : 0.0;
  }

 private:
  FOAM_FUNCTION double value(int i, double R, const typename Exchange<D>::Split &V,
                             Quantity name) const
  {
    switch (name) {
      case Quantity::CONTACTS:
        return sums.contacts[i];
      case Quantity::AREA:
        return sums.area[i];
      case Quantity::FREE:
        return free_area(surface<D>(R), sums.area[i]);
      case Quantity::VFILM:
        return V.film;
      case Quantity::VLIQUID:
        return V.liquid;
      case Quantity::RDOT:
        return radius_rate<D>(V.film + V.liquid, R);
      case Quantity::ESPRING:
        return sums.espring[i];
      case Quantity::EDURIAN:
        return sums.edurian[i];
    }
    return 0.0;
  }
};

// ---------------------------------------------------------------------- rates of the state

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

// ---------------------------------------------------------------------- predictor and corrector

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

// ---------------------------------------------------------------------- Runge-Kutta-Chebyshev

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

// The spectral radius of the Jacobian by power iteration: a small step in a direction d, the
// change of rates is the next d

enum DirectionSum { DIRECTION };    // sum of squares, q in units of length
enum DirectionMax { COMPONENT };

template <class B> struct Direction {
  State<B> s;       // in the place of f_{n-1}
  double q_unit;    // dq / dR at the mean radius

  template <int D> FOAM_FUNCTION void measure(int i, FoamTotals &all) const
  {
    for (int k = 0; k < D; k++) add(s.v_before[k][i], all);
    if (s.grows) add(s.qdot_before[i] / q_unit, all);
  }

  FOAM_FUNCTION static void add(double d, FoamTotals &all)
  {
    all.sum[DIRECTION] += d * d;
    if (std::fabs(d) > all.max[COMPONENT]) all.max[COMPONENT] = std::fabs(d);
  }
};

// a first direction: any will do, the same on any number of ranks

template <int D, class B> struct AnyDirection {
  static constexpr const char *NAME = "foam: any direction";
  Direction<B> d;
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    const bool alive = d.s.b.radius(i) > 0.0;
    for (int k = 0; k < D; k++) d.s.v_before[k][i] = alive ? number(i, k) : 0.0;
    d.s.qdot_before[i] = alive && d.s.grows ? number(i, D) * d.q_unit : 0.0;
    d.template measure<D>(i, all);
  }

 private:
  FOAM_FUNCTION double number(int i, int k) const    // -1 ... 1
  {
    const double golden = 0.6180339887498949, root = 0.7548776662466927;
    const double turns = golden * d.s.b.tag(i) + root * (k + 1);
    return 2.0 * (turns - std::floor(turns)) - 1.0;
  }
};

// The rates of a state that has become unstable are those of the mode that made it so: they join the
// direction, as large as it is

template <int D, class B> struct LargestRate {
  static constexpr const char *NAME = "foam: largest rate";
  Direction<B> d;
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    const State<B> &s = d.s;
    for (int k = 0; k < D; k++) d.add(s.v(i, k), all);
    if (s.grows) d.add(s.qdot[i] / d.q_unit, all);
  }
};

template <int D, class B> struct JoinRates {
  static constexpr const char *NAME = "foam: join rates";
  Direction<B> d;
  double factor;
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    const State<B> &s = d.s;
    for (int k = 0; k < D; k++) s.v_before[k][i] += factor * s.v(i, k);
    if (s.grows) s.qdot_before[i] += factor * s.qdot[i];
    d.template measure<D>(i, all);
  }
};

template <int D, class B> struct StepAside {
  static constexpr const char *NAME = "foam: step aside";
  State<B> s;
  double amount;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < D; k++) s.b.put(i, k, s.x_start[k][i] + amount * s.v_before[k][i]);
    if (s.grows) put_gas<D>(s, i, s.q_start[i] + amount * s.qdot_before[i]);
  }
};

template <int D, class B> struct TakeDirection {
  static constexpr const char *NAME = "foam: take direction";
  Direction<B> d;
  Rates<D, B> rates;
  double *v_there[3];    // velocities at the start, if they are not those of State
  double amount;         // length of the step aside
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    const State<B> &s = d.s;
    for (int k = 0; k < D; k++) {
      const double v = v_there[0] ? v_there[k][i] : s.v(i, k);
      s.v_before[k][i] = (rates.velocity(i, k) - v) / amount;
    }
    if (s.grows) s.qdot_before[i] = (rates.qdot(i) - s.qdot[i]) / amount;
    d.template measure<D>(i, all);
  }
};

template <int D, class B> struct KeepStart {
  static constexpr const char *NAME = "foam: keep start";
  State<B> s;
  FOAM_FUNCTION void operator()(int i) const { keep_start<D>(s, i); }
};

FOAM_FUNCTION void take_change(double change, FoamTotals &all)
{
  if (std::fabs(change) > all.max[COMPONENT]) all.max[COMPONENT] = std::fabs(change);
}

// the velocities of this evaluation, to compare others with that take the same l; and how far they are
// from those that are known

template <int D, class B> struct KeepVelocities {
  static constexpr const char *NAME = "foam: keep velocities";
  State<B> s;
  Rates<D, B> rates;
  double *v[3];
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    for (int k = 0; k < D; k++) {
      v[k][i] = rates.velocity(i, k);
      take_change(v[k][i] - s.v(i, k), all);
    }
  }
};

// the rates of the start, evaluated anew; and how far they are from those that were known

template <int D, class B> struct TakeStartRates {
  static constexpr const char *NAME = "foam: take rates of the start";
  State<B> s;
  Rates<D, B> rates;
  FOAM_FUNCTION void operator()(int i, FoamTotals &all) const
  {
    for (int k = 0; k < D; k++) {
      const double v = rates.velocity(i, k);
      take_change(v - s.v(i, k), all);
      if (s.v_start[0]) {
        s.v_start[k][i] = v;
        s.lag[k][i] = s.b.v(i, k);
      } else
        s.b.v(i, k) = v;
    }
    if (s.grows) s.qdot[i] = rates.qdot(i);
  }
};

}    // namespace Foam

#endif
