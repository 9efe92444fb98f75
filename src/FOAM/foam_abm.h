/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_ABM_H
#define LMP_FOAM_ABM_H

#include "foam_driver.h"
#include "foam_scheme.h"
#include "foam_stepper.h"

// Adams-Bashforth-Moulton steps of any equations (foam_scheme.h); coefficients: foam_stepper.h

namespace Foam {

template <class Fields> struct Predict {
  static constexpr const char *NAME = "foam: predict";
  Fields y;
  Predictor p;
  bool first;    // the step starts at the present y
  FOAM_FUNCTION void operator()(int i) const
  {
    if (first)
      y.keep_start(i);
    else
      y.rewind(i);
    y.each([&](const auto &field) {
      field.put(i, predict(field.start(i), field.rate(i), field.before(i), p));
    });
  }
  bool is_plain() const { return first && y.is_plain(); }
};
template <class F> Predict(F, Predictor, bool) -> Predict<F>;

// The error of a field is the distance of corrector and predictor

template <class Fields, class Rates, class Judge> struct Correct {
  static constexpr const char *NAME = "foam: correct and judge";
  Fields y;
  Rates rates;
  Judge judge;
  Work<Fields> next;    // f_{n+1}, if the rates of the predicted state are taken for it
  bool keeps;
  double h;
  using Move = Moved<typename Judge::Look>;
  FOAM_FUNCTION Move move(int i) const
  {
    Move moved{{}, y.reach(i), {}};
    double f[Fields::MOST];
    rates(i, f);
    y.each([&](const auto &field) {
      const int n = field.number;
      const double corrected = correct(field.start(i), field.rate(i), f[n], h);
      if (keeps) next.field[n][i] = f[n];
      moved.error.add(field.move(i, corrected));
    });
    moved.look = judge.look(i);
    return moved;
  }
  FOAM_FUNCTION void operator()(int i, typename Judge::Totals &all) const
  {
    judge(i, move(i), all);
  }
  bool is_plain() const { return !keeps && y.is_plain() && rates.is_plain() && judge.is_plain(); }
};
template <class F, class R, class J> Correct(F, R, J, Work<F>, bool, double) -> Correct<F, R, J>;

template <class System> auto attempt_abm(System &system, const Driver &driver, double h, bool first)
{
  const Scheme scheme = driver.control.scheme;
  system.for_each(Predict{system.fields(), predictor(scheme, h, driver.h_before), first});
  system.evaluate(h);
  const Correct candidate{system.fields(), system.rates(),           system.judge(),
                          system.work(),   scheme == Scheme::SOURCE, h};
  return system.template totals<typename System::Totals>(candidate);
}

}    // namespace Foam

#endif
