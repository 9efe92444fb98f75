/* ----------------------------------------------------------------------
   The numbers of the adaptive predictor-corrector, apart from any state.

   Adams-Bashforth predictor and Adams-Moulton corrector of order 2 with a
   variable step (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
   Differential Equations I, section III.5), w = h / h_before:

     y*      = y_n + h [(1 + w/2) f_n - (w/2) f_{n-1}]
     y_{n+1} = y_n + (h/2) (f(y*) + f_n)
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_STEPPER_H
#define LMP_FOAM_STEPPER_H

#include "foam_physics.h"

namespace Foam {

// STANDARD: coefficients for the true ratio of steps, rates evaluated again at the
// corrected state, step control by the order of the error.
// SOURCE: as the thesis [L20] does: constant coefficients (w = 1), the rates of the
// predicted state taken for those of the corrected one, 0.5 and growth (1.9) as step factors.

enum class Scheme { STANDARD, SOURCE };

// The variable that is advanced for the gas of a bubble: q = R^D, or q = R.  Of a candidate q
// may be negative: a q = R^D counts as such, so that the sum of gas stays what it is; a
// negative R is just none.

enum class Variable { VOLUME, RADIUS };

template <int D> FOAM_FUNCTION double radius_of(Variable variable, double q)
{
  if (variable == Variable::VOLUME) return radius_of_power<D>(q);
  return q < 0.0 ? 0.0 : q;
}

template <int D> FOAM_FUNCTION double q_of(Variable variable, double R)
{
  return variable == Variable::VOLUME ? power_of_radius<D>(R) : R;
}

template <int D> FOAM_FUNCTION double slope_of_q(Variable variable, double R)    // dq / dR
{
  return variable == Variable::VOLUME ? slope_of_power<D>(R) : 1.0;
}

template <int D> FOAM_FUNCTION double gas_content(Variable variable, double q)
{
  return CONTENT<D> *
         (variable == Variable::VOLUME ? q : power_of_radius<D>(radius_of<D>(variable, q)));
}

template <int D> FOAM_FUNCTION double q_rate(Variable variable, double Vdot, double R)
{
  if (variable == Variable::VOLUME) return power_rate<D>(Vdot);
  return R > 0.0 ? radius_rate<D>(Vdot, R) : 0.0;
}

struct Predictor {
  double now, before;    // y* = y_n + now f_n + before f_{n-1}
};

FOAM_FUNCTION Predictor predictor(Scheme scheme, double h, double h_before)
{
  if (!(h_before > 0.0)) return {h, 0.0};    // no history yet: Euler
  const double w = scheme == Scheme::SOURCE ? 1.0 : h / h_before;
  return {h * (1.0 + 0.5 * w), -0.5 * h * w};
}

FOAM_FUNCTION double predict(double y, double now, double before, const Predictor &p)
{
  return y + (p.now * now + p.before * before);
}

FOAM_FUNCTION double correct(double y, double now, double predicted, double h)
{
  return y + 0.5 * h * (predicted + now);
}

// Error of a step, in units of <R_in>: the largest error of any component (centre and radius) of any
// bubble, or the root mean square of all of them.  In the latter nobody would notice a bubble that goes
// astray among many, so none may be wrong by more than OUTLIER times the tolerance.

enum class Norm { MAX, RMS };
constexpr double OUTLIER = 100.0;

FOAM_FUNCTION double step_error(Norm norm, double largest, double squares, double components,
                                double Rin)
{
  if (norm == Norm::MAX) return largest / Rin;
  const double mean = components > 0.0 ? std::sqrt(squares / components) : 0.0;
  return (largest > OUTLIER * mean ? largest / OUTLIER : mean) / Rin;
}

// Step control.  The distance of corrector and predictor is of order h^3 (h^2 after an
// Euler start), so the step that just meets the tolerance is h (tol / error)^(1/3).

struct StepControl {
  Scheme scheme = Scheme::STANDARD;
  double tolerance = 1.0e-5;
  double safety = 0.9;    // share of the step that just meets the tolerance
  double growth = 1.9;    // most that a step may be longer than the last

  // the same for the first STARTS steps, whose length goes back to a guess, dt0; 0: as later

  double growth_at_start = 0.0;
  static constexpr int STARTS = 4;

  static constexpr double SHRINK = 0.2, HALF = 0.5;

  bool accepts(double error) const { return error <= tolerance; }    // NaN is refused

  // after_rejection: the same step has been refused before and must not grow again
  // before: steps accepted before this one

  double next(double h, double error, bool after_rejection, double before = STARTS) const
  {
    const bool accepted = accepts(error);
    if (scheme == Scheme::SOURCE) return accepted ? growth * h : HALF * h;
    const double most = growth_at_start > 0.0 && before < STARTS ? growth_at_start : growth;
    double factor = SHRINK;
    if (error == 0.0)
      factor = growth;
    else if (std::isfinite(error))
      factor = safety * std::cbrt(tolerance / error);
    if (!(factor < most)) factor = most;
    if (!(factor > SHRINK)) factor = SHRINK;
    if (accepted && after_rejection && factor > 1.0) factor = 1.0;
    if (!accepted && factor > safety) factor = safety > SHRINK ? safety : SHRINK;
    return factor * h;
  }

  // The next try where bubbles went beyond the neighbor list: allowed is the share of the way that the
  // farthest may go

  double within(double h, double allowed) const
  {
    const double factor = safety * allowed;
    return (factor > SHRINK ? factor : SHRINK) * h;
  }
};

}    // namespace Foam

#endif
