/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/flow,FixBubbleFlow);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_FLOW_H
#define LMP_FIX_BUBBLE_FLOW_H

#include "fix_foam_travelling.h"
#include "liquid_bubbles.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

namespace LAMMPS_NS {

// Bubbles smaller than the spacing of a resolved liquid, which carries them and is pushed by them (liquid_bubbles.h).
// Fix liquid/flow, which makes the steps, calls.

class FixBubbleFlow : public FixFoamTravelling {
 public:
  FixBubbleFlow(class LAMMPS *, int, char **);
  static FixBubbleFlow *of(class LAMMPS *);    // the one there is, or none
  int setmask() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double compute_vector(int) override;
  void *extract(const char *, int &) override;    // the type of bubbles that are born

  FoamColumns state{all_columns, "state of bubbles in a liquid", Liquid::BUBBLE_STATES, TRAVELS};
  FoamColumns work{all_columns, "columns of bubbles in a liquid", Liquid::AT_BUBBLES, STAYS};
  FoamColumns before{all_columns, "bubbles before the step", Liquid::BEFORE_STEP, STAYS};
  FoamColumns dissipates{all_columns, "dissipation at the surface", 1, TRAVELS};
  Liquid::BubbleSetting set;
  double density() const { return 1.0 / set.beta; }    // of the gas
  double fastest() const { return events.speed; }      // of this rank, squared
  virtual void advance(double dt);
  virtual void go_back();    // to what they were before a step

  // from particles to bubbles: what is there, forces; with dt > 0 new velocities

  template <class Space, class Loop, class List>
  void exchange_in(Space &space, const Loop &liquid, const List &around, int nrows,
                   double *const *acceleration, double dt);
  template <class Space> Liquid::BubbleColumns columns_in(Space &space)
  {
    Liquid::BubbleColumns all;
    for (int k = 0; k < Liquid::AT_BUBBLES; k++) all.at[k] = space.column(work, k);
    for (int k = 0; k < Liquid::BUBBLE_STATES; k++) all.kept[k] = space.column(state, k);
    return all;
  }

 protected:
  template <class Space> void go_back_in(Space &space) { keep_in(space, space.bubbles(), true); }

 private:
  bigint turbulence_seed = 0, breakup_seed = 0, entrain_seed = 0;
  bool entrains = false;
  int born_type = 2;                                                   // of what is entrained
  Liquid::BubbleTotals events;                                         // of this rank, in this step
  double born = 0.0, broken = 0.0, burst = 0.0, burst_volume = 0.0;    // so far, of this rank

  std::uint64_t of_this_step(bigint seed) const
  {
    return static_cast<std::uint64_t>(seed) + (static_cast<std::uint64_t>(update->ntimestep) << 24);
  }
  template <class Space, class B> void keep_in(Space &space, const B &b, bool back)
  {
    Liquid::KeepBubbles<B> keep{b, columns_in(space), {}, back};
    for (int k = 0; k < Liquid::BEFORE_STEP; k++) keep.kept[k] = space.column(before, k);
    space.for_each(atom->nlocal, keep);
  }
  void check_sizes(double dr) const;
  void entrain();
  void remove_burst();
  void break_up();
};

template <class Space, class Loop, class List>
void FixBubbleFlow::exchange_in(Space &space, const Loop &liquid, const List &around, int nrows,
                                double *const *acceleration, double dt)
{
  using namespace Liquid;
  using B = typename Space::Bubbles;
  work.use(atom->nmax);
  before.use(atom->nmax);
  const BubbleColumns at = columns_in(space);
  space.for_all(nrows, Interpolate<B, List>{liquid.b,
                                            around,
                                            liquid.c,
                                            at,
                                            liquid.set,
                                            {acceleration[0], acceleration[1], acceleration[2]},
                                            set.surface});
  Space ours(space);
  ours.groupbit = groupbit;
  if (dt > 0.0) keep_in(ours, liquid.b, false);
  if (set.turbulence) {
    ours.for_each(atom->nlocal,
                  AddTurbulence<B>{liquid.b, at, liquid.set, of_this_step(turbulence_seed), dt});
  }
  ours.for_each(atom->nlocal, BubbleForces<B>{liquid.b, at, liquid.set, set});
  if (!(dt > 0.0)) {
    events = ours.template totals<BubbleTotals>(atom->nlocal, SpeedOfBubbles<B>{liquid.b});
  } else {
    ours.for_each(atom->nlocal, MoveBubbles<B>{liquid.b, at, liquid.set, set, dt});
    events = ours.template totals<BubbleTotals>(atom->nlocal,
                                                AgeBubbles<B>{liquid.b, at, liquid.set, set, dt});
    if (entrains)
      space.for_each(atom->nlocal, KeepEntraining{liquid.c, space.column(dissipates, 0)});
  }
}

}    // namespace LAMMPS_NS

#endif
#endif
