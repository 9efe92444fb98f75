/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_SCHEME_H
#define LMP_FOAM_SCHEME_H

#include "foam_physics.h"

#include <cmath>

// Differential equations dy/dt = f(y) as the schemes see them (foam_abm.h, foam_rkc.h, foam_spectral.h).
//
// y is made of fields, each of which has a number for every bubble: schemes make linear combinations of them
// and know nothing else, neither bubbles nor the dimension.  In a functor, for bubble i:
//
//   y.each(visit)           visit(field) for each field
//   MOST                    numbers of fields are below it
//   y.keep_start(i)         the step starts at the present y;  y.rewind(i): at the one that is kept, again
//   y.after_stage(i, f)     f are the rates of a stage, and the next one follows
//   y.after_start(i)        the rates of the start have been evaluated anew
//   y.reach(i)              how far bubble i is from where evaluations were prepared for: a number or a FoamLength
//   y.alive(i), y.seed(i)   takes part; a number of its own, the same on any number of ranks
//   y.used_up(i)            no longer takes part at this stage, nor, after y.keep_used_up(i), at the next
//
//   field.number            its place in arrays of MOST numbers
//   field.value(i), field.put(i, value)
//   field.start(i)          y_n
//   field.rate(i), field.put_rate(i, value)    f_n
//   field.before(i) = ...   f_{n-1}, for schemes with a history; a direction, for the spectral radius
//   field.measure(i, d)     length of a change d of the present value
//   field.move(i, value)    puts a value, and gives the length of the change
//   field.unit()            change per unit of length
//
// rates(i, f) gives f of the state evaluated last, judge.look(i) is what has to be seen of bubble i at the end of a
// step, and judge(i, moved, totals) adds it to the totals that decide on the step.  A System puts them together on the
// host:
//
//   System::Fields, System::Totals             types of the fields and of the totals, which are Judge::Totals, too
//   fields(), rates(), judge(), work()         Fields, Rates, Judge, Work
//   evaluate(later)                            what rates() needs of the present y, at the start + later
//   for_each(functor), totals<T>(functor)      over all bubbles of this rank
//   reduce(mine)                               totals over all ranks
//   length()                                   a typical one
//   moves_by_itself()       y changes between steps, too (a box that moves)
//   others_act()            f depends on more than y and time, which others know
//   lags()                  f depends on rates before it
//
// Functors are made of these by template argument deduction; clang before 17 needs the guides that follow them.

namespace Foam {

template <class Fields> struct Work {    // of a scheme, within a step
  double *field[Fields::MOST];
  double *bubble;
};

// the error of one bubble in a step, as lengths

struct StepError {
  double largest = 0.0, squares = 0.0;
  FOAM_FUNCTION void add(double error)
  {
    error = std::fabs(error);
    if (error > largest) largest = error;
    squares += error * error;
  }
};

// One bubble at the end of a step that is tried.  Functors have move(i), which makes it, and judge(i, moved, totals): they
// are called one after the other, or the first for a block of bubbles at a time (foam_totals_of()).

template <class Look> struct Moved {
  StepError error;
  double reach;
  Look look;
};

template <class Fields> struct KeepStart {
  static constexpr const char *NAME = "foam: keep start";
  Fields y;
  FOAM_FUNCTION void operator()(int i) const { y.keep_start(i); }
};
template <class F> KeepStart(F) -> KeepStart<F>;

}    // namespace Foam

#endif
