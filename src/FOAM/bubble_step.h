/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_STEP_H
#define LMP_BUBBLE_STEP_H

#include "bubble_liquid.h"

#include <cmath>

// One step of bubbles with inertia: velocity Verlet with one evaluation of forces, which depend on velocities.
//
//   v_1/2 = v + (h/2) a,   x' = x + h v_1/2,   v_pred = v_1/2 + (h/2) a
//   a' = a(x', v_pred),    v' = v_pred + d,    d = (h/2) (a' - a) / (1 + h Gamma / 2)
//
// The predictor of v is of first order, so that forces at x' are wrong by O(h^2), and the step is of second order.
// Gamma = 0: explicit, stable for friction up to Gamma h = 2.  With the friction's own Gamma the step is Crank and
// Nicolson's: (2 - h Gamma) / (2 + h Gamma) in place of exp(- h Gamma).  h |d| is an estimate of the error of x.

namespace Bubble {

struct StepTotals {
  Foam::FoamMax error;        // h |d| / R
  Foam::FoamMax rate;         // |v| / R
  Foam::FoamMax lightness;    // volume / effective mass
  FOAM_FUNCTION void join(const StepTotals &other)
  {
    error.join(other.error);
    rate.join(other.rate);
    lightness.join(other.lightness);
  }
};

// how fast a bubble is, of the square of its speed, and how light

FOAM_FUNCTION void limits(const Liquid &liquid, double mass, double R, double square,
                          StepTotals &all)
{
  all.rate.raise(std::sqrt(square) / R);
  all.lightness.raise(volume(R) / effective_mass(liquid, mass, R));
}

struct StepColumns {
  double *kick[3];         // (h/2) a
  double *predicted[3];    // v_pred, and
  double *end[3];          // v', at the end of the step before
};

template <class B> struct Advance {
  static constexpr const char *NAME = "bubble: advance";
  B b;
  Liquid liquid;
  StepColumns s;
  double h;
  FOAM_FUNCTION void operator()(int i) const
  {
    const double half = 0.5 * h / effective_mass(liquid, b.mass(i), b.radius(i));
    for (int k = 0; k < 3; k++) {
      const double kick = half * b.f(i, k), v = b.v(i, k) + kick;
      s.kick[k][i] = kick;
      b.put(i, k, b.place(i, k) + h * v);
      b.v(i, k) = v + kick;
    }
  }
};

template <class B> struct Finish {
  static constexpr const char *NAME = "bubble: finish";
  B b;
  Liquid liquid;
  StepColumns s;
  const double *stiffness;    // of the drag, or none
  double h;
  FOAM_FUNCTION void operator()(int i, StepTotals &all) const
  {
    const double R = b.radius(i), m = effective_mass(liquid, b.mass(i), R), half = 0.5 * h / m;
    const double part = stiffness ? 1.0 / (1.0 + half * stiffness[i]) : 1.0;
    double square = 0.0, speed = 0.0;
    for (int k = 0; k < 3; k++) {
      const double d = part * (half * b.f(i, k) - s.kick[k][i]);
      const double predicted = b.v(i, k), end = predicted + d;
      s.predicted[k][i] = predicted;
      s.end[k][i] = b.v(i, k) = end;
      if (stiffness) b.f(i, k) -= stiffness[i] * (end - predicted);    // the drag at v'
      square += d * d;
      speed += b.v(i, k) * b.v(i, k);
    }
    all.error.raise(h * std::sqrt(square) / R);
    limits(liquid, b.mass(i), R, speed, all);
  }
};

// The set-up of a run: forces are those that the last step ended with, at v_pred, unless somebody has changed
// velocities.  Then bubbles get their own back; the first step is no longer than later ones may be.

template <class B> struct TakePredicted {
  static constexpr const char *NAME = "bubble: take predicted velocities";
  B b;
  StepColumns s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < 3; k++) {
      const double v = b.v(i, k);
      const bool changed = v != s.end[k][i];
      if (changed) s.predicted[k][i] = s.end[k][i] = v;
      b.v(i, k) = s.predicted[k][i];
    }
  }
};

template <class B> struct GiveBack {
  static constexpr const char *NAME = "bubble: give velocities back";
  B b;
  Liquid liquid;
  StepColumns s;
  const double *stiffness;    // of the drag, or none
  FOAM_FUNCTION void operator()(int i, StepTotals &all) const
  {
    double speed = 0.0;
    for (int k = 0; k < 3; k++) {
      const double end = s.end[k][i];
      if (stiffness) b.f(i, k) -= stiffness[i] * (end - b.v(i, k));
      b.v(i, k) = end;
      speed += end * end;
    }
    limits(liquid, b.mass(i), b.radius(i), speed, all);
  }
};

}    // namespace Bubble

#endif
