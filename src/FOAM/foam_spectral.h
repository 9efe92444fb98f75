/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_SPECTRAL_H
#define LMP_FOAM_SPECTRAL_H

#include "foam_state.h"

// The spectral radius of the Jacobian by power iteration

namespace Foam {

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
