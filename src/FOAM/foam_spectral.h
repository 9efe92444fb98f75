/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_SPECTRAL_H
#define LMP_FOAM_SPECTRAL_H

#include "foam_driver.h"
#include "foam_scheme.h"
#include "foam_totals.h"

#include <algorithm>
#include <cmath>

// The spectral radius of the Jacobian of any equations (foam_scheme.h) by power iteration: a small step in a
// direction d, the change of rates is the next d.  Directions lie where other schemes have f_{n-1}.

namespace Foam {

using LAMMPS_NS::FoamMax;
using LAMMPS_NS::FoamSum;

struct DirectionTotals {    // in units of length
  FoamSum squares;
  FoamMax component;
  FOAM_FUNCTION void add(double d)
  {
    squares += d * d;
    component.raise(std::fabs(d));
  }
  FOAM_FUNCTION void join(const DirectionTotals &other)
  {
    squares.join(other.squares);
    component.join(other.component);
  }
};

// a first direction: any will do, the same on any number of ranks

template <class Fields> struct AnyDirection {
  static constexpr const char *NAME = "foam: any direction";
  Fields y;
  FOAM_FUNCTION void operator()(int i, DirectionTotals &all) const
  {
    int n = 0;
    y.each([&](const auto &field) {
      field.before(i) = y.alive(i) ? number(y.seed(i), n) * field.unit() : 0.0;
      all.add(field.before(i) / field.unit());
      n++;
    });
  }

 private:
  FOAM_FUNCTION static double number(double seed, int n)    // -1 ... 1
  {
    const double golden = 0.6180339887498949, root = 0.7548776662466927;
    const double turns = golden * seed + root * (n + 1);
    return 2.0 * (turns - std::floor(turns)) - 1.0;
  }
};
template <class F> AnyDirection(F) -> AnyDirection<F>;

// The rates of a state that has become unstable are those of the mode that made it so: they join the
// direction, as large as it is

template <class Fields> struct LargestRate {
  static constexpr const char *NAME = "foam: largest rate";
  Fields y;
  FOAM_FUNCTION void operator()(int i, FoamMax &all) const
  {
    y.each([&](const auto &field) { all.raise(std::fabs(field.rate(i) / field.unit())); });
  }
};
template <class F> LargestRate(F) -> LargestRate<F>;

template <class Fields> struct JoinRates {
  static constexpr const char *NAME = "foam: join rates";
  Fields y;
  double factor;
  FOAM_FUNCTION void operator()(int i, DirectionTotals &all) const
  {
    y.each([&](const auto &field) {
      field.before(i) += factor * field.rate(i);
      all.add(field.before(i) / field.unit());
    });
  }
};
template <class F> JoinRates(F, double) -> JoinRates<F>;

template <class Fields> struct Displace {
  static constexpr const char *NAME = "foam: displace";
  Fields y;
  double amount;
  FOAM_FUNCTION void operator()(int i) const
  {
    y.each([&](const auto &field) { field.put(i, field.start(i) + amount * field.before(i)); });
  }
};
template <class F> Displace(F, double) -> Displace<F>;

template <class Fields, class Rates> struct TakeDirection {
  static constexpr const char *NAME = "foam: take direction";
  Fields y;
  Rates rates;
  Work<Fields> reference;    // rates at the start to compare with
  bool referred;             // to these; else to f_n
  double amount;             // length of the displacement
  FOAM_FUNCTION void operator()(int i, DirectionTotals &all) const
  {
    double f[Fields::MOST];
    rates(i, f);
    y.each([&](const auto &field) {
      const int n = field.number;
      const double at_start = referred ? reference.field[n][i] : field.rate(i);
      field.before(i) = (f[n] - at_start) / amount;
      all.add(field.before(i) / field.unit());
    });
  }
};
template <class F, class R> TakeDirection(F, R, Work<F>, bool, double) -> TakeDirection<F, R>;

// the rates of this evaluation, of all fields, to compare others with that take the same as given; and how far they
// are from those that are known

template <class Fields, class Rates> struct KeepRates {
  static constexpr const char *NAME = "foam: keep rates";
  Fields y;
  Rates rates;
  Work<Fields> reference;
  FOAM_FUNCTION void operator()(int i, FoamMax &change) const
  {
    double f[Fields::MOST];
    rates(i, f);
    y.each([&](const auto &field) {
      const int n = field.number;
      reference.field[n][i] = f[n];
      change.raise(std::fabs((f[n] - field.rate(i)) / field.unit()));
    });
  }
};
template <class F, class R> KeepRates(F, R, Work<F>) -> KeepRates<F, R>;

// the rates of the start, evaluated anew; and how far they are from those that were known

template <class Fields, class Rates> struct RenewStart {
  static constexpr const char *NAME = "foam: renew rates of the start";
  Fields y;
  Rates rates;
  FOAM_FUNCTION void operator()(int i, FoamMax &change) const
  {
    double f[Fields::MOST];
    rates(i, f);
    y.each([&](const auto &field) {
      const int n = field.number;
      change.raise(std::fabs((f[n] - field.rate(i)) / field.unit()));
      field.put_rate(i, f[n]);
    });
    y.after_start(i);
  }
};
template <class F, class R> RenewStart(F, R) -> RenewStart<F, R>;

class SpectralRadius {
 public:
  double given = 0.0;    // 0: estimated
  double displaced =
      1.0e-6;    // of the bubble that moves most, in units of length: well above rounding

  // state of the estimate, kept in restarts

  double estimated = 0.0;
  double estimate_step = -1.0;    // number of accepted steps when it was
  double changed_step = 0.0;      // the same when the equations were others
  double direction_size = 0.0;    // of the direction; 0: none yet
  double direction_most = 0.0;    // its largest component
  double rejected_then = 0.0;     // rejected steps at the last estimate
  double others_change = 0.0;     // 1 if what others do to f has changed otherwise than with time

  double value() const { return given > 0.0 ? given : estimated; }
  double bound() const { return given > 0.0 ? given : MARGIN * estimated; }

  // A foam that is new, or that a command has changed, changes fast: bubbles that nearly coincide
  // alone make the spectral radius that of the inverse of their distance.  There estimates follow after 1, 2,
  // 4, ... steps.

  bool estimate_due(const Driver &driver) const
  {
    if (given > 0.0 || estimate_step == driver.accepted) return false;
    if (driver.h_before == 0.0) return true;
    const double most = driver.rejected == rejected_then ? STEPS : FEW;
    return driver.accepted - estimate_step >=
           std::min(most, std::max(1.0, estimate_step - changed_step));
  }

  template <class System> bool start_is_outdated(System &system) const
  {
    return system.moves_by_itself() ||
           (system.others_act() && (given > 0.0 || others_change != 0.0));
  }
  template <class System> void renew_start(System &system, const Driver &driver)
  {
    system.evaluate(0.0);
    const auto change =
        system.template totals<FoamMax>(RenewStart{system.fields(), system.rates()});
    if (system.others_act()) notice(system, driver, change);
  }

  // compare: F_0 is that of the last step, so that it shows what others have changed

  template <class System> void estimate(System &system, const Driver &driver, bool compare);

 private:
  static constexpr double MARGIN = 1.1;         // an underestimate by less does no harm
  static constexpr int STEPS = 25, FEW = 10;    // between estimates; if a step was rejected
  static constexpr int ITERATIONS = 50;         // of an estimate
  static constexpr int FEWEST = 6;    // of one that starts anywhere: it may change little at first
  static constexpr double CONVERGED = 0.02;     // relative change of the last iteration
  static constexpr double FALL = 0.9;           // of the estimate since the last one, at most
  static constexpr double GONE = 0.5;           // or more: what made it as large is gone
  static constexpr double NOTICEABLE = 0.01;    // of the tolerance: change of a step by others

  template <class System>
  void notice(System &system, const Driver &driver, const FoamMax &change_here)
  {
    const double change = system.reduce(change_here);
    others_change =
        change * driver.h > NOTICEABLE * driver.control.tolerance * system.length() ? 1.0 : 0.0;
  }
};

template <class System>
void SpectralRadius::estimate(System &system, const Driver &driver, bool compare)
{
  using Fields = typename System::Fields;
  auto take = [&](const auto &functor) {
    const auto all = system.reduce(system.template totals<DirectionTotals>(functor));
    direction_size = std::sqrt(all.squares);
    direction_most = all.component;
  };
  bool known = direction_size > 0.0 && std::isfinite(direction_size);    // by the last estimate
  if (!known) take(AnyDirection{system.fields()});
  if (known && driver.rejected != rejected_then) {    // perhaps by an instability
    const double most =
        system.reduce(system.template totals<FoamMax>(LargestRate{system.fields()}));
    if (most > 0.0) take(JoinRates{system.fields(), direction_most / most});
  }

  // f may depend on more than y, which then is not what it was when F_0 was evaluated

  Work<Fields> reference{};
  const bool referred = system.lags() || system.others_act();
  if (referred) {
    reference = system.work();
    system.for_each(Displace{system.fields(), 0.0});
    system.evaluate(0.0);
    const auto change =
        system.template totals<FoamMax>(KeepRates{system.fields(), system.rates(), reference});
    if (compare && system.others_act()) notice(system, driver, change);
  }

  const double estimated_then = estimated;
  const int fewest = known ? 1 : FEWEST;

  // In a large foam the mode that relaxes fastest is that of a few bubbles, and the rest, which makes up
  // the size of the direction, hides it for long; by the largest component it shows sooner.

  for (int n = 0; n < ITERATIONS && direction_most > 0.0; n++) {
    const double before = estimated, amount = displaced * system.length() / direction_most;
    const double most = direction_most / direction_size;
    system.for_each(Displace{system.fields(), amount});
    system.evaluate(0.0);
    take(TakeDirection{system.fields(), system.rates(), reference, referred,
                       amount * direction_size});
    estimated = std::max(direction_size, direction_most / most);
    if (known && !(estimated > 0.0))
      take(AnyDirection{system.fields()});    // the bubbles that the last one moved are gone
    known = false;
    if (n + 1 >= fewest && std::fabs(estimated - before) <= CONVERGED * estimated) break;
  }

  // The iteration may miss the mode that the last one had found: in a foam that goes on as it was, the
  // estimate falls little by little

  if (driver.h_before == 0.0) changed_step = driver.accepted;
  if (estimate_step - changed_step >= STEPS && estimated > GONE * estimated_then)
    estimated = std::max(estimated, FALL * estimated_then);
  estimate_step = driver.accepted;
  rejected_then = driver.rejected;
}

}    // namespace Foam

#endif
