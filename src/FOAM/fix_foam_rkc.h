/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/rkc,FixFoamRKC);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_RKC_H
#define LMP_FIX_FOAM_RKC_H

#include "fix_foam_integrate.h"
#include "foam_rkc.h"
#include "foam_spectral.h"

#include "atom.h"
#include "domain.h"
#include "modify.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {

// Stabilised Runge-Kutta-Chebyshev steps of order 2, see foam_chebyshev.h: springs relax much
// faster than the foam changes, and stages make a step stable for less than steps would.

class FixFoamRKC : public FixFoamIntegrate {
 public:
  FixFoamRKC(class LAMMPS *, int, char **);
  double compute_vector(int) override;

 protected:
  FoamTotals attempt(double, bool) override;
  bool has_history() const override { return false; }
  bool works() const override { return true; }
  double stable_step() const override;
  bool suffers_from_drift() const override { return true; }    // which grows from stage to stage
  std::vector<double *> progress() override;

  // settings

  int stages_given = 0;           // 0: as many as a step needs
  double spectral_given = 0.0;    // 0: estimated

  // Estimate of the spectral radius, by power iteration; its direction lies where other schemes
  // have f_{n-1}

  double spectral = 0.0;          // of the Jacobian, as estimated
  double spectral_step = -1.0;    // number of accepted steps when it was
  double changed_step = 0.0;      // the same when the foam was another
  double direction_size = 0.0;    // of the direction; 0: none yet
  double direction_most = 0.0;    // its largest component
  double stages_last = 0.0;
  double rejected_then = 0.0;    // rejected steps at the last estimate

  // An underestimate by less than this does no harm

  static constexpr double MARGIN = 1.1;
  static constexpr int STEPS = 25, FEW = 10;    // between estimates; if one was rejected
  static constexpr int ITERATIONS = 50;         // of an estimate
  static constexpr double ENOUGH = 0.02;        // relative change of the last iteration
  static constexpr double FALL = 0.9;           // of the estimate since the last one, at most
  static constexpr double GONE = 0.5;           // or more: what made it as large is there no longer
  static constexpr double NOTICED = 0.01;    // of the tolerance: change of a step by other forces
  double aside =
      1.0e-6;    // step aside of the bubble that moves most, in <R_in>: see FixFoamRKCKokkos

  // Forces of other fixes may change with steps or velocities; whether they do is seen in estimates

  bool others_act() const;
  double others_change = 0.0;    // 1 if they did
  void notice(const FoamTotals &change)
  {
    others_change = change.max[Foam::COMPONENT] * h > NOTICED * control.tolerance * pair->rin;
  }
  bool start_is_outdated() const
  {
    return domain->box_change || (others_act() && (spectral_given > 0.0 || others_change != 0.0));
  }

  double spectral_radius() const
  {
    return spectral_given > 0.0 ? spectral_given : MARGIN * spectral;
  }

  // A foam that is new, or that a command has changed, changes fast: bubbles that nearly coincide
  // alone make the spectral radius that of the inverse of their distance.  There estimates follow after 1, 2,
  // 4, ... steps.

  bool estimate_due() const
  {
    if (spectral_given > 0.0 || spectral_step == accepted) return false;
    if (h_before == 0.0) return true;
    const double most = rejected == rejected_then ? STEPS : FEW;
    return accepted - spectral_step >= std::min(most, std::max(1.0, spectral_step - changed_step));
  }

  template <class Space> Foam::Stages stages(Space &here)
  {
    auto at = [&](int k) {
      return here.column(work, k);
    };
    return {{at(0), at(1), at(2)}, at(3), at(4)};
  }
  template <int D, class Space> FoamTotals attempt_in(Space &here, double step, bool first);
  template <int D, class Space> void estimate_in(Space &here, bool compare);
};

template <int D, class Space>
FoamTotals FixFoamRKC::attempt_in(Space &here, double step, bool first)
{
  using namespace Foam;
  using B = typename Space::Bubbles;
  const int nlocal = atom->nlocal;

  // F_0 is known from the last step, unless since then the box has taken the bubbles along, or other
  // fixes' forces have changed otherwise than with time: what they change between F_0 and the stages would
  // pass for an error that no step is short enough for

  bool kept = !first, compare = first;
  auto keep_start = [&] {
    if (!kept) here.for_each(nlocal, KeepStart<D, B>{state(here)});
    kept = true;
  };
  if (first && start_is_outdated()) {
    keep_start();
    evaluate(0.0);
    const FoamTotals mine = here.totals(nlocal, TakeStartRates<D, B>{state(here), rates<D>(here)});
    if (others_act()) notice(reduce(mine));
    compare = false;
  }
  if (estimate_due()) {
    keep_start();
    estimate_in<D>(here, compare);
  }

  // a step that turns out too long to be stable is shortened by the error that it has

  const Chebyshev c(stages_given ? stages_given : Chebyshev::count_for(step * spectral_radius()));
  stages_last = c.count();
  here.for_each(nlocal, FirstStage<D, B>{state(here), stages(here), step * c[1].rate_start, !kept});
  for (int j = 2; j < c.count(); j++) {
    evaluate(c[j - 1].place * step);
    here.for_each(nlocal, NextStage<D, B>{state(here), stages(here), rates<D>(here), c[j], step});
  }
  evaluate(c[c.count() - 1].place * step);
  const auto s = state(here);
  const NextStage<D, B> last{s, stages(here), rates<D>(here), c[c.count()], step};
  return here.totals(nlocal, LastStage<D, B>{last, judge_of<D>(s), c[c.count() - 1].place});
}

template <int D, class Space> void FixFoamRKC::estimate_in(Space &here, bool compare)
{
  using namespace Foam;
  using B = typename Space::Bubbles;
  const int nlocal = atom->nlocal;
  const double Rin = pair->rin;
  const double q_unit = variable == Variable::VOLUME ? D * (D == 2 ? Rin : Rin * Rin) : 1.0;
  auto take = [&](const FoamTotals &mine) {
    const FoamTotals all = reduce(mine);
    direction_size = std::sqrt(all.sum[DIRECTION]);
    direction_most = all.max[COMPONENT];
  };
  auto any_direction = [&] {
    take(here.totals(nlocal, AnyDirection<D, B>{{state(here), q_unit}}));
  };
  bool known = direction_size > 0.0 && std::isfinite(direction_size);    // by the last estimate
  if (!known) any_direction();
  if (known && rejected != rejected_then) {    // perhaps by an instability
    const Direction<B> d{state(here), q_unit};
    const double most = reduce(here.totals(nlocal, LargestRate<D, B>{d})).max[COMPONENT];
    if (most > 0.0) take(here.totals(nlocal, JoinRates<D, B>{d, direction_most / most}));
  }

  // Forces may depend on more than places: l, and the velocities that other fixes look at, are not what
  // they were when F_0 was evaluated

  Stages y{};    // of no stage here: its first columns take velocities
  if (lagged() || others_act()) {
    y = stages(here);
    here.for_each(nlocal, StepAside<D, B>{state(here), 0.0});
    evaluate(0.0);
    const KeepVelocities<D, B> keep{
        state(here), rates<D>(here), {y.x_before[0], y.x_before[1], y.x_before[2]}};
    const FoamTotals mine = here.totals(nlocal, keep);
    if (compare && others_act()) notice(reduce(mine));
  }

  const double spectral_then = spectral;

  // In a large foam the mode that relaxes fastest is that of a few bubbles, and the rest, which makes up
  // the size of the direction, hides it for long; by the largest component it shows sooner.

  for (int n = 0; n < ITERATIONS && direction_most > 0.0; n++) {
    const double before = spectral, amount = aside * Rin / direction_most;
    const double most = direction_most / direction_size;
    here.for_each(nlocal, StepAside<D, B>{state(here), amount});
    evaluate(0.0);
    take(here.totals(nlocal, TakeDirection<D, B>{{state(here), q_unit},
                                                 rates<D>(here),
                                                 {y.x_before[0], y.x_before[1], y.x_before[2]},
                                                 amount * direction_size}));
    spectral = std::max(direction_size, direction_most / most);
    if (known && !(spectral > 0.0))
      any_direction();    // the bubbles that the last one moved are gone
    known = false;
    if (std::fabs(spectral - before) <= ENOUGH * spectral) break;
  }

  // The iteration may miss the mode that the last one had found: in a foam that goes on as it was, the
  // estimate falls little by little

  if (h_before == 0.0) changed_step = accepted;
  if (spectral_step - changed_step >= STEPS && spectral > GONE * spectral_then)
    spectral = std::max(spectral, FALL * spectral_then);
  spectral_step = accepted;
  rejected_then = rejected;
}

}    // namespace LAMMPS_NS

#endif
#endif
