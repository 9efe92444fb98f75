/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_DRIVER_H
#define LMP_FOAM_DRIVER_H

#include "foam_stepper.h"

#include <algorithm>

namespace Foam {

// One step after another of dy/dt = f(y), each tried until it is accepted, whatever the equations and the scheme.
// A Problem has
//   largest_step()            no step may be longer, as things are now
//   attempt(step, first)      a candidate and what to know of it; first: the step starts at the present y
//   extend_reach()            evaluations were not prepared for as far as the candidate went: prepare them at the
//                             start anew, so that another attempt goes further; false if that is of no use
//   accept(step)              the candidate is y
//   too_short(step, refused)  does not return
//   shortest()                shorter steps make no sense

struct Trial {
  double error = 0.0;    // to compare with the tolerance
  double reach = 0.0,
         margin = 0.0;    // how far evaluations went, and for how far they were prepared
};

struct Driver {
  StepControl control;
  double time = 0.0;
  double h = 0.0;           // step to try next; 0 before the first
  double h_before = 0.0;    // step between f_{n-1} and f_n; 0 without history
  double h_last = 0.0;      // last accepted step
  double accepted = 0.0, rejected = 0.0, error_last = 0.0;

  template <class Problem> void step(Problem &problem)
  {
    bool refused = false, first = true;
    while (true) {
      const double step = std::min(h, problem.largest_step());
      if (step < problem.shortest() || time + step == time) problem.too_short(step, refused);

      const Trial trial = problem.attempt(step, first);
      error_last = trial.error;
      first = false;

      if (trial.reach > trial.margin) {
        first = problem.extend_reach();
        if (!first) {
          rejected++;
          refused = true;
          h = control.within(step, trial.margin / trial.reach);
        }
        continue;
      }

      h = control.next(step, error_last, refused, accepted);
      if (control.accepts(error_last)) {
        problem.accept(step);
        time += step;
        h_before = h_last = step;
        accepted++;
        return;
      }
      rejected++;
      refused = true;
    }
  }
};

}    // namespace Foam

#endif
