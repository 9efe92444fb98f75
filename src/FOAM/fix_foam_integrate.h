/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_FOAM_INTEGRATE_H
#define LMP_FIX_FOAM_INTEGRATE_H

#include "fix.h"
#include "fix_foam_coarsen.h"
#include "foam_contact_drag.h"
#include "fix_foam_flow.h"
#include "fix_foam_travelling.h"
#include "foam_driver.h"
#include "foam_history.h"
#include "foam_host.h"
#include "foam_input.h"
#include "foam_lag.h"
#include "foam_list_guard.h"
#include "foam_output.h"
#include "foam_state.h"

#include "atom.h"
#include "domain.h"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// What every integrator of a foam shares; a scheme, such as FixFoamABM, adds its formula.
//
// The state is y = (x, q) with q = R^d (or R), its rates are f = (v, qdot).  One LAMMPS
// timestep is one accepted step: in initial_integrate() Foam::Driver tries steps, each with
// evaluations out of turn, until one is accepted; LAMMPS then computes the forces of the new
// state, and final_integrate() turns them into the rates that the next step starts from.  So
// thermo, dumps and restarts see one consistent state.
//
// A scheme finds the equations in a System, see foam_scheme.h.  Other loops over bubbles (their
// functors: foam_state.h) are virtual functions of a line: each calls a
// template, named with _in, for the space in which this style runs.  A style for a device
// overrides those and keeps the rest.

class FixFoamIntegrate : public FixFoamTravelling {
 public:
  FixFoamIntegrate(class LAMMPS *, int, char **);

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override;
  void setup_post_neighbor() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_exchange() override;
  void pre_neighbor() override;
  void post_neighbor() override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  double compute_vector(int) override;

  void grow_arrays(int) override;
  void set_arrays(int) override;
  int pack_restart(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 protected:
  PairFoam *pair = nullptr;
  FixFoamCoarsen *gas = nullptr;    // null: radii stay as they are
  std::vector<FoamFollower *> followers;
  std::vector<FixFoamFlow *> flows;
  FixFoamFlow *shear =
      nullptr;    // the flow with a box that deforms: then evaluations see where it is
  FoamReduce<Foam::Judgement> reduce;
  FoamListGuard list;
  FoamOutput out;
  int dim;

  // settings, from the command: keywords of all schemes, and own ones with what to do with a value

  void settings(int, char **, double tolerance,
                const FoamInput::Keywords &own);    // auto: that one

  Foam::Variable variable = Foam::Variable::VOLUME;
  Foam::Norm norm = Foam::Norm::RMS;
  bool norm_given = false;
  double dt_start = 0.0, dt_limit = 0.0;    // 0: the defaults
  bool drift_removed = false, drift_given = false;

  // progress, kept in restarts

  Foam::Driver driver;    // steps, and how their length is controlled
  double evaluations = 0.0;
  double bubbles_last = 0.0;    // their number at the end of the last run
  double dt_given = 0.0;        // of the timestep command, put back after a run
  FoamHub::Record record;       // for a pair style that is replaced in mid-simulation
  virtual std::vector<double *> progress();

  double bubbles_sorted = 0.0;    // how many there were when they were sorted in memory last
  bool sorts = false;             // the build that is due sorts them

  // per bubble; those that travel with it stand in restart files, too

  bool wanted(const FoamColumns &) const override;

  // those of the step before are for the scheme to use

  enum { Q, QDOT, VX_BEFORE, VY_BEFORE, VZ_BEFORE, QDOT_BEFORE, NCOLUMNS };
  FoamColumns columns{all_columns, "gas and rates", NCOLUMNS, TRAVELS};

  double solved_with = 0.0;    // mu_c, and whether for the mean of neighbors, at set-up
  bool solved_mean = false;
  FoamColumns solved{all_columns, "velocities with drag between bubbles", 3,
                     TRAVELS};    // if it is on

  FoamLag lag{lmp, all_columns, TRAVELS, STAYS};    // neighbor drag only

  // what LAMMPS' own coordinates lack of these in double precision, if it keeps less: see
  // FoamKokkosBubbles. A sum of many small steps would drown in them.

  FoamColumns residuals{all_columns, "residuals of places", 3, TRAVELS};

  // lengths of paths, if asked for; shown to the outside as the vector of the fix

  bool paths = false;
  FoamColumns path{all_columns, "lengths of paths", 1, TRAVELS};
  void show_path() { vector_atom = paths ? path[0] : nullptr; }    // on the host, up to date

  // per bubble, of one step or one neighbor list

  enum { XSTART, YSTART, ZSTART, QSTART, RSTART, NSTART };
  FoamColumns start{all_columns, "starts", NSTART, STAYS};    // y_n, and the radii in it
  enum { XLISTED, YLISTED, ZLISTED, RLISTED, NLISTED };
  FoamColumns listed{all_columns, "listed places", NLISTED, STAYS};
  FoamColumns residual{all_columns, "residuals of the drag", 3, STAYS};
  FoamColumns work{all_columns, "work of the scheme", 5, STAYS};    // within a step
  FoamColumns flow{all_columns, "velocities of the liquid", 3, STAYS};

  // ---- what a scheme does

  virtual Foam::Judgement candidate(double step, bool first) = 0;    // of this rank
  virtual bool evaluates_again() const { return true; }      // or has the next rates in work
  virtual bool has_history() const { return true; }          // needs f_{n-1}
  virtual bool uses_work() const { return false; }           // uses work
  virtual double stable_step() const { return INFINITY; }    // no step may be longer
  virtual double displacement() const
  {
    return INFINITY;
  }    // by which it asks for changes of rates, in <R_in>
  virtual bool suffers_from_drift() const { return false; }    // so it is removed unless kept

  // ---- what a scheme uses

  // forces of the state in x and radius, with l in v, so much later than the start of the step

  void evaluate(double later);

  template <int D, class Space> class System;    // the equations, for a scheme

  double q_of(double R) const
  {
    return Foam::with_dimension(dim, [&]<int D>() { return Foam::q_of<D>(variable, R); });
  }
  bool others_act() const;    // other fixes, on the forces
  bool lags() const           // the scheme source takes v itself for l
  {
    return pair->neighbor_drag && evaluates_again();
  }
  bool grows() const { return gas && gas->K > 0.0; }
  double error_of_drag() const;
  double least_eigenvalue() const;
  double natural_time() const;

  // ---- the equations and where their numbers are

  template <class Space> Foam::State<typename Space::Bubbles> state(Space &space);
  template <int D, class Space> Foam::Fields<D, typename Space::Bubbles> fields(Space &space)
  {
    return {state(space)};
  }
  template <int D, class Space> Foam::Rates<D, typename Space::Bubbles> rates(Space &space);
  template <class Space> void take_flow(Space &space);

  // ---- the loops over bubbles

  virtual void keep_history();
  virtual void take_rates(bool history);
  virtual void redistribute(double factor);
  virtual void return_to_start();
  virtual void take_listed();
  virtual void add_to_path();
  virtual double largest_radius();    // on this rank
  virtual double count_bubbles();     // of this rank
  virtual void shift_by_images(double sign);
  virtual void compute_forces(int eflag, int vflag);
  virtual void solve_drag();    // where bubbles in contact drag each other; after each evaluation

  // set-up works on the host: bubbles there are up to date after the first, and on the device
  // again after the second

  virtual void host_reads() {}
  virtual void host_wrote() {}
  bool is_bubble(int i) const { return atom->mask[i] & groupbit; }    // there

  template <class Space> void keep_history_in(Space &);
  template <class Space> void take_rates_in(Space &, bool history);
  template <class Space> void redistribute_in(Space &, double factor);
  template <class Space> void return_to_start_in(Space &);
  template <class Space> void take_listed_in(Space &);
  template <class Space> void add_to_path_in(Space &);
  template <class Space> double largest_radius_in(Space &);
  template <class Space> double count_bubbles_in(Space &);
  template <class Space> void solve_drag_in(Space &);
  template <int D, class Space>
  Foam::Drag<D, typename Space::Bubbles> drag_without_contacts(Space &);
  template <class Space> void shift_by_images_in(Space &, double sign);

 private:
  bool ghosts_checked = false;     // their radii are communicated
  bool lag_given = false;          // to LAMMPS' own evaluation before a run
  double atime_start = 0.0;        // LAMMPS' time at the start of the step
  double evaluated_later = 0.0;    // than the present box, the last evaluation
  double step_tried = 0.0;
  bool images_shifted = false;    // velocities, see shift_by_images()
  double accepted_then = 0.0;     // steps before this run
  double time_then = 0.0;         // t when LAMMPS' fixes were initialised last
  bool deform_told = false;       // what its styles make of changing steps
  bool idle_told = false;         // that no gas is exchanged
  bool others_told = false;       // that some particles with a radius are no bubbles
  Foam::Judgement totals;         // of a candidate, over all ranks

  std::map<tagint, std::array<double, 3>> places;    // of a triclinic box, before set-up

  void check_bubbles();
  void check_ghosts();
  double bubbles();
  void check_companions();
  void check_deform(Fix *);
  std::string worst_bubble();
  struct ChangeOfRates;
  template <int D> ChangeOfRates change_of_rates();
  void give_lag();
  void take_image(int i, const double *x_before);
  void take_population();
  void remove_small();
  double mean_radius() const;
  bool history_at_accept() const;
  void set_timestep(double);
  [[noreturn]] void no_solution();    // of the drag

  // for the driver

  friend struct Foam::Driver;
  double largest_step() const;
  double shortest() const { return 1.0e-12 * natural_time(); }
  Foam::Trial attempt(double step, bool first);
  bool extend_reach();
  void accept(double step);
  [[noreturn]] void too_short(double step, bool refused);
};

// ---------------------------------------------------------------------- loops, for any space

template <class Space> Foam::State<typename Space::Bubbles> FixFoamIntegrate::state(Space &space)
{
  Foam::State<typename Space::Bubbles> s{space.bubbles()};
  s.q = space.column(columns, Q);
  s.qdot = space.column(columns, QDOT);
  for (int n = 0; n < s.MOST; n++) {
    s.start[n] = space.column(start, XSTART + n);
    s.before[n] = space.column(columns, VX_BEFORE + n);
    s.next[n] = evaluates_again() ? nullptr : space.column(work, n);
  }
  s.radius_start = space.column(start, RSTART);
  for (int k = 0; k < 3; k++) s.x_listed[k] = space.column(listed, XLISTED + k);
  s.radius_listed = space.column(listed, RLISTED);
  s.lag = lag.view(space);
  s.counts = gas != nullptr;
  s.grows = grows();
  s.variable = variable;
  s.range = gas ? pair->range() : 0.0;
  s.box_moves = shear != nullptr;
  if (shear) s.listed_now = list.moved_by_box(evaluated_later);
  s.q_unit = Foam::with_dimension(
      dim, [&]<int D>() { return Foam::slope_of_q<D>(variable, pair->hub.record.rin); });
  return s;
}

// The equations as a scheme sees them: foam_scheme.h

template <int D, class Space> class FixFoamIntegrate::System {
  FixFoamIntegrate &fix;
  Space &space;
  const int n;

 public:
  using B = typename Space::Bubbles;
  using Fields = Foam::Fields<D, B>;
  using Totals = Foam::Judgement;

  System(FixFoamIntegrate &fix, Space &space) : fix(fix), space(space), n(fix.atom->nlocal) {}

  Fields fields() { return fix.fields<D>(space); }
  Foam::Rates<D, B> rates() { return fix.rates<D>(space); }
  Foam::Judge<D, B> judge()
  {
    Fields candidate = fields();
    if (fix.shear) {
      candidate.listed_now = fix.list.moved_by_box(fix.step_tried);
      candidate.listed_ahead = fix.list.moved_by_box(2.0 * fix.step_tried);
    }
    return {candidate, fix.gas ? fix.gas->smallest_radius() : 0.0};
  }
  Foam::Work<Fields> work()
  {
    Foam::Work<Fields> w;
    for (int m = 0; m < Fields::MOST; m++) w.field[m] = space.column(fix.work, m);
    w.bubble = space.column(fix.work, Fields::MOST);
    return w;
  }
  void evaluate(double later) { fix.evaluate(later); }
  template <class Functor> void for_each(const Functor &functor) { space.for_each(n, functor); }
  template <class T, class Functor> T totals(const Functor &functor)
  {
    return space.template totals<T>(n, functor);
  }
  template <class T> T reduce(const T &mine) { return foam_reduce(mine, fix.world); }
  double length() const { return fix.pair->hub.record.rin; }
  bool moves_by_itself() const { return fix.domain->box_change && !fix.shear; }
  bool others_act() const { return fix.others_act(); }
  bool lags() const { return fix.lag.active; }
};

template <class Space> void FixFoamIntegrate::keep_history_in(Space &space)
{
  using B = typename Space::Bubbles;
  Foam::with_dimension(dim, [&]<int D>() {
    space.for_each(atom->nlocal, Foam::KeepHistory<D, B>{fields<D>(space)});
  });
}

template <class Space> void FixFoamIntegrate::take_rates_in(Space &space, bool history)
{
  using B = typename Space::Bubbles;
  Foam::with_dimension(dim, [&]<int D>() {
    space.for_each(atom->nlocal, Foam::TakeRates<D, B>{fields<D>(space), rates<D>(space), history});
  });
}

template <class Space> void FixFoamIntegrate::redistribute_in(Space &space, double factor)
{
  using B = typename Space::Bubbles;
  const double smallest = gas->smallest_radius();
  Foam::with_dimension(dim, [&]<int D>() {
    space.for_each(atom->nlocal, Foam::Redistribute<D, B>{state(space), smallest, factor});
  });
}

template <class Space> void FixFoamIntegrate::return_to_start_in(Space &space)
{
  using B = typename Space::Bubbles;
  Foam::with_dimension(dim, [&]<int D>() {
    space.for_each(atom->nlocal, Foam::ReturnToStart<D, B>{fields<D>(space)});
  });
}

template <class Space> void FixFoamIntegrate::take_listed_in(Space &space)
{
  space.for_each(atom->nlocal, Foam::TakeListed<typename Space::Bubbles>{state(space)});
}

template <class Space> void FixFoamIntegrate::add_to_path_in(Space &space)
{
  using B = typename Space::Bubbles;
  Foam::with_dimension(dim, [&]<int D>() {
    const Foam::AddToPath<D, B> functor{state(space), space.column(path, 0)};
    space.for_each(atom->nlocal, functor);
  });
}

template <class Space> double FixFoamIntegrate::largest_radius_in(Space &space)
{
  const Foam::LargestRadius<typename Space::Bubbles> functor{space.bubbles()};
  return space.template totals<FoamMax>(atom->nlocal, functor);
}

template <class Space> double FixFoamIntegrate::count_bubbles_in(Space &space)
{
  return space.template totals<FoamSum>(atom->nlocal, Foam::CountBubbles());
}

}    // namespace LAMMPS_NS

#include "fix_foam_integrate_velocities.h"

#endif
