/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/nve,FixBubbleNVE);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_NVE_H
#define LMP_FIX_BUBBLE_NVE_H

#include "bubble_step.h"
#include "fix_bubble_rise.h"
#include "fix_foam_travelling.h"
#include "foam_output.h"

#include "atom.h"
#include "update.h"

namespace LAMMPS_NS {

// Motion of bubbles with inertia (bubble_step.h), with the timestep as given, or chosen by the error of a step.
//
// Forces are those of the predicted velocities.  So that a run goes on bit by bit where another has ended, the set-up
// of a run finds bubbles with these velocities; at its end they have their own again.

class FixBubbleNVE : public FixFoamTravelling {
 public:
  FixBubbleNVE(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  void reset_dt() override {}
  double compute_vector(int) override;

  void set_arrays(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 protected:
  virtual void take_predicted();    // loops over bubbles
  virtual void give_back();
  virtual void advance();
  virtual void finish();
  template <class Space> void take_predicted_in(Space &space)
  {
    using B = typename Space::Bubbles;
    space.for_each(atom->nlocal, Bubble::TakePredicted<B>{space.bubbles(), step_columns(space)});
  }
  template <class Space> void give_back_in(Space &space)
  {
    using B = typename Space::Bubbles;
    const Foam::FoamMax error = totals.error;    // of the last step
    totals = space.template totals<Bubble::StepTotals>(
        atom->nlocal,
        Bubble::GiveBack<B>{space.bubbles(), liquid(), step_columns(space), stiffness(space)});
    totals.error = error;
  }
  template <class Space> void advance_in(Space &space)
  {
    using B = typename Space::Bubbles;
    space.for_each(atom->nlocal,
                   Bubble::Advance<B>{space.bubbles(), liquid(), step_columns(space), update->dt});
  }
  template <class Space> void finish_in(Space &space)
  {
    using B = typename Space::Bubbles;
    totals = space.template totals<Bubble::StepTotals>(
        atom->nlocal, Bubble::Finish<B>{space.bubbles(), liquid(), step_columns(space),
                                        stiffness(space), update->dt});
  }

  enum { KICK, PREDICTED = 3, END = 6, NCOLUMNS = 9 };
  FoamColumns columns{all_columns, "steps of bubbles", NCOLUMNS, TRAVELS};

 private:
  FoamOutput out;
  class PairBubbleCollision *pair = nullptr;
  FixBubbleRise *rise = nullptr;    // none: no liquid
  double tolerance = 0.0;           // 0: the timestep is fixed
  double longest = 0.0;             // 0: no limit
  double h = 0.0;                   // next step; 0 before the first
  double dt_given = 0.0;            // of the timestep command, put back after a run
  Bubble::StepTotals totals;        // of this rank
  double error_last = 0.0, error_worst = 0.0, shortest = 0.0;

  Bubble::Liquid liquid() const;
  template <class Space> const double *stiffness(Space &space) const
  {
    return rise ? rise->stiffness(space) : nullptr;
  }
  template <class Space> Bubble::StepColumns step_columns(Space &space)
  {
    Bubble::StepColumns s;
    for (int k = 0; k < 3; k++) {
      s.kick[k] = space.column(columns, KICK + k);
      s.predicted[k] = space.column(columns, PREDICTED + k);
      s.end[k] = space.column(columns, END + k);
    }
    return s;
  }
  double next_step();
  void set_timestep(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
