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
#include "foam_driver.h"
#include "foam_scheme.h"
#include "foam_spectral.h"

// Runge-Kutta-Chebyshev steps of any equations (foam_scheme.h); coefficients: foam_chebyshev.h

namespace Foam {

// Between two stages y is Y_{j-1}, work has Y_{j-2}, and how far the evaluated stages were from where evaluations
// were prepared for

template <class Fields> struct FirstStage {
  static constexpr const char *NAME = "foam: first stage";
  Fields y;
  Work<Fields> work;
  double step;    // m_1 h
  bool first;     // the step starts at the present y
  FOAM_FUNCTION void operator()(int i) const
  {
    if (first)
      y.keep_start(i);
    else
      y.rewind(i);
    y.each([&](const auto &field) {
      work.field[field.number][i] = field.start(i);
      field.put(i, field.start(i) + step * field.rate(i));
    });
    work.bubble[i] = 0.0;
  }
  bool is_plain() const { return first && y.is_plain(); }
};
template <class F> FirstStage(F, Work<F>, double, bool) -> FirstStage<F>;

template <class Fields, class Rates> struct NextStage {
  static constexpr const char *NAME = "foam: next stage";
  Fields y;
  Work<Fields> work;
  Rates rates;    // F_{j-1}
  Chebyshev::Stage c;
  double h;
  FOAM_FUNCTION void operator()(int i) const
  {
    go_on(i, [](const auto &, double) {});
  }
  bool is_plain() const { return y.is_plain() && rates.is_plain(); }

  // look(field, f): at Y_{j-1} and F_{j-1}, before they are gone

  template <class Look> FOAM_FUNCTION void go_on(int i, Look &&look) const
  {
    FoamMax furthest{work.bubble[i]};
    furthest.raise(y.reach(i));
    work.bubble[i] = furthest;
    const bool used_up = y.used_up(i);
    double f[Fields::MOST];
    rates(i, f);
    y.each([&](const auto &field) {
      const int n = field.number;
      look(field, f[n]);
      const double last = field.value(i);
      field.put(i, advance(field.start(i), last, work.field[n][i], f[n], field.rate(i), h, c));
      work.field[n][i] = last;
    });
    if (used_up) y.keep_used_up(i);
    y.after_stage(i, f);
  }
};
template <class F, class R> NextStage(F, Work<F>, R, Chebyshev::Stage, double) -> NextStage<F, R>;

template <class Fields, class Rates, class Judge> struct LastStage {
  static constexpr const char *NAME = "foam: last stage and judge";
  NextStage<Fields, Rates> stage;
  Judge judge;
  double place;    // c_{s-1}
  using Move = Moved<typename Judge::Look>;
  FOAM_FUNCTION Move move(int i) const
  {
    StepError error;
    stage.go_on(i, [&](const auto &field, double f) {
      const double of_field =
          stage_error(field.start(i), field.value(i), f, field.rate(i), stage.h, place);
      error.add(field.measure(i, of_field));
    });
    return {error, stage.work.bubble[i], judge.look(i)};
  }
  FOAM_FUNCTION void operator()(int i, typename Judge::Totals &all) const
  {
    judge(i, move(i), all);
  }
  bool is_plain() const { return stage.is_plain() && judge.is_plain(); }
};
template <class F, class R, class J> LastStage(NextStage<F, R>, J, double) -> LastStage<F, R, J>;

struct RungeKuttaChebyshev {
  int stages_given = 0;    // 0: as many as a step needs
  double stages_last = 0.0;
  SpectralRadius spectral;

  // Longer steps are not stable.  One that turns out too long is shortened by the error that it has.

  double stable_step() const
  {
    const double largest = spectral.bound();
    const int most = stages_given ? stages_given : Chebyshev::MOST;
    return largest > 0.0 ? Chebyshev::stable(most) / largest : INFINITY;
  }

  template <class System>
  typename System::Totals attempt(System &system, const Driver &driver, double h, bool first)
  {
    // F_0 is known from the last step, unless since then y has moved by itself, or what others do to f has
    // changed otherwise than with time: what they change between F_0 and the stages would pass for an error
    // that no step is short enough for

    bool kept = !first, compare = first;
    auto keep_start = [&] {
      if (!kept) system.for_each(KeepStart{system.fields()});
      kept = true;
    };
    if (first && spectral.start_is_outdated(system)) {
      keep_start();
      spectral.renew_start(system, driver);
      compare = false;
    }
    if (spectral.estimate_due(driver)) {
      keep_start();
      spectral.estimate(system, driver, compare);
    }

    const Chebyshev c(stages_given ? stages_given : Chebyshev::count_for(h * spectral.bound()));
    const int count = c.count();
    stages_last = count;
    system.for_each(FirstStage{system.fields(), system.work(), h * c[1].rate_start, !kept});
    for (int j = 2; j < count; j++) {
      system.evaluate(c[j - 1].place * h);
      system.for_each(NextStage{system.fields(), system.work(), system.rates(), c[j], h});
    }
    const double place = c[count - 1].place;
    system.evaluate(place * h);
    const NextStage last{system.fields(), system.work(), system.rates(), c[count], h};
    return system.template totals<typename System::Totals>(LastStage{last, system.judge(), place});
  }
};

}    // namespace Foam

#endif
