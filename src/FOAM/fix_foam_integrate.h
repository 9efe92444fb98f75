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
#include "foam_history.h"
#include "foam_host.h"
#include "foam_input.h"
#include "foam_list_guard.h"
#include "foam_output.h"
#include "foam_state.h"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// What every integrator of a foam shares; a scheme, such as FixFoamABM, adds its formula.
//
// The state is y = (x, q) with q = R^d (or R), its rates are f = (v, qdot).  One LAMMPS
// timestep is one accepted step: initial_integrate() tries steps, each with evaluations out
// of turn, until one is accepted; LAMMPS then computes the forces of the new state, and
// final_integrate() turns them into the rates that the next step starts from.  So thermo,
// dumps and restarts see one consistent state.
//
// Loops over bubbles (their functors: foam_state.h) are virtual functions of a line: each calls a
// template, named with _in, for the space in which this style runs.  A style for a device
// overrides those and keeps the rest.

class FixFoamIntegrate : public Fix {
 public:
  FixFoamIntegrate(class LAMMPS *, int, char **);
  ~FixFoamIntegrate() override;

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
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

 protected:
  PairDurianFoam *pair = nullptr;
  FixFoamCoarsen *gas = nullptr;    // null: radii stay as they are
  std::vector<FoamFollower *> followers;
  FoamReduce reduce;
  FoamListGuard list;
  FoamOutput out;
  int dim;

  // settings, from the command: keywords of all schemes, and own ones with what to do with a value

  void settings(int, char **, const FoamInput::Keywords &own);
  void add_callbacks();
  bool called_back = false;

  Foam::StepControl control;
  Foam::Variable variable = Foam::Variable::VOLUME;
  Foam::Norm norm = Foam::Norm::RMS;
  bool norm_given = false;
  double dt_start = 0.0, dt_limit = 0.0;    // 0: the defaults
  bool drift_removed = false, drift_given = false;

  // progress, kept in restarts

  double time = 0.0;
  double h = 0.0;           // step to try next; 0 before the first
  double h_before = 0.0;    // step between f_{n-1} and f_n; 0 without history
  double h_last = 0.0;      // last accepted step
  double accepted = 0.0, rejected = 0.0, evaluations = 0.0, error_last = 0.0;
  double bubbles_last = 0.0;        // their number at the end of the last run
  double dt_given = 0.0;            // of the timestep command, put back after a run
  PairDurianFoam::Record record;    // for a pair style that is replaced in mid-simulation
  double have_lags = 0.0;           // 1 if LAG and LAST are those of a previous run
  virtual std::vector<double *> progress();

  // per bubble; those that travel with it stand in restart files, too

  FoamColumnList all_columns;
  enum : unsigned { STAYS = 1, TRAVELS = 2 };
  FoamColumnList travelling() const { return chosen(all_columns, TRAVELS); }

  // those of the step before are for the scheme to use

  enum { Q, QDOT, VX_BEFORE, VY_BEFORE, VZ_BEFORE, QDOT_BEFORE, NCOLUMNS };
  FoamColumns columns{all_columns, "gas and rates", NCOLUMNS, TRAVELS};

  // neighbor drag only: the velocities l that the evaluation of the present ones took as given,
  // see Foam::lagged_velocity(), and the velocities with which the last run ended

  enum { LAGX, LAGY, LAGZ, LASTX, LASTY, LASTZ, NLAGS };
  FoamColumns lags{all_columns, "lagged velocities", NLAGS, TRAVELS};

  // what LAMMPS' own coordinates lack of these in double precision, if it keeps less: see
  // FoamKokkosBubbles. A sum of many small steps would drown in them.

  FoamColumns low{all_columns, "low parts of places", 3, TRAVELS};

  // per bubble, of one step or one neighbor list

  enum { XSTART, YSTART, ZSTART, QSTART, RSTART, NSTART };
  FoamColumns start{all_columns, "starts", NSTART, STAYS};    // y_n, and the radii in it
  FoamColumns v_start{all_columns, "velocities of the start", 3,
                      STAYS};    // v_n, where neighbor drag needs LAMMPS' v for l
  enum { XLISTED, YLISTED, ZLISTED, RLISTED, NLISTED };
  FoamColumns listed{all_columns, "listed places", NLISTED, STAYS};
  FoamColumns work{all_columns, "work of the scheme", 5, STAYS};    // within a step

  // ---- what a scheme does

  virtual FoamTotals attempt(double step, bool first) = 0;     // candidate, judged: see Foam::Judge
  virtual bool evaluates_again() const { return true; }        // or has the next rates in work
  virtual bool has_history() const { return true; }            // needs f_{n-1}
  virtual bool works() const { return false; }                 // uses work
  virtual double stable_step() const { return INFINITY; }      // no step may be longer
  virtual bool suffers_from_drift() const { return false; }    // so it is removed unless kept

  // ---- what a scheme uses

  // forces of the state in x and radius, with l in v, so much later than the start of the step

  void evaluate(double later);

  bool lagged() const;    // does the pair style take l from v
  double q_of(double R) const
  {
    return Foam::with_dimension(dim, [&]<int D>() { return Foam::q_of<D>(variable, R); });
  }
  bool grows() const { return gas && gas->K > 0.0; }
  double natural_time() const;
  template <class Space> Foam::State<typename Space::Bubbles> state(Space &here)
  {
    auto at = [&](FoamColumns &c, int k) {
      return here.column(c, k);
    };
    auto v_at = [&](int k) {
      return lagged() ? here.column(v_start, k) : nullptr;
    };
    auto next_at = [&](int k) {
      return evaluates_again() ? nullptr : here.column(work, k);
    };
    return {here.bubbles(),
            at(columns, Q),
            at(columns, QDOT),
            {at(columns, VX_BEFORE), at(columns, VY_BEFORE), at(columns, VZ_BEFORE)},
            at(columns, QDOT_BEFORE),
            {at(start, XSTART), at(start, YSTART), at(start, ZSTART)},
            at(start, QSTART),
            at(start, RSTART),
            {v_at(0), v_at(1), v_at(2)},
            {at(lags, LAGX), at(lags, LAGY), at(lags, LAGZ)},
            {at(listed, XLISTED), at(listed, YLISTED), at(listed, ZLISTED)},
            at(listed, RLISTED),
            {next_at(0), next_at(1), next_at(2)},
            next_at(3),
            gas != nullptr,
            grows(),
            variable};
  }
  template <int D, class Space> Foam::Rates<D, typename Space::Bubbles> rates(Space &here);

  template <int D, class B> Foam::Judge<D, B> judge_of(const Foam::State<B> &s) const
  {
    return {s, gas ? gas->smallest_radius() : 0.0};
  }

  // ---- the loops over bubbles

  virtual void keep_history();
  virtual void take_rates(bool history);
  virtual void redistribute(double factor);
  virtual void return_to_start();
  virtual void take_listed();
  virtual double largest_radius();    // on this rank
  virtual double count_bubbles();     // of this rank
  virtual void compute_forces(int eflag, int vflag);

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
  template <class Space> double largest_radius_in(Space &);
  template <class Space> double count_bubbles_in(Space &);

 private:
  bool ghosts_checked = false;    // their radii are communicated
  bool lags_given = false;        // to LAMMPS' own evaluation before a run
  double atime_start = 0.0;       // LAMMPS' time at the start of the step
  double accepted_then = 0.0;     // steps before this run
  double time_then = 0.0;         // t when LAMMPS' fixes were initialised last
  bool deform_told = false;       // what its styles make of changing steps
  bool idle_told = false;         // that no gas is exchanged
  bool others_told = false;       // that some particles with a radius are no bubbles
  FoamTotals totals;              // of a candidate, over all ranks

  std::map<tagint, std::array<double, 3>> places;    // of a triclinic box, before set-up

  void check_bubbles();
  void check_ghosts();
  void give_lags();
  double bubbles();
  void check_companions();
  void check_deform(Fix *);
  std::string worst_bubble();
  template <int D> FoamTotals change_of_rates();
  void take_population();
  void judge(const FoamTotals &mine);
  void remove_small();
  bool history_at_accept() const;
  void accept(double step);
  void set_timestep(double);
  double largest_step() const;
};

// ---------------------------------------------------------------------- loops, for any space

// Averaging over neighbors leaves a common velocity as it is, so with neighbor drag the foam
// as a whole may drift; the remedy goes on in the frame in which it is at rest.

template <int D, class Space>
Foam::Rates<D, typename Space::Bubbles> FixFoamIntegrate::rates(Space &here)
{
  const Foam::ContactSums sums = pair->contact_sums(here);
  Foam::Rates<D, typename Space::Bubbles> f{here.bubbles(), pair->mu0};
  if (pair->neighbor_drag) {
    f.contacts = sums.contacts;
    for (int k = 0; k < 3; k++) f.vsum[k] = sums.vsum[k];
  }
  f.variable = variable;
  if (gas) {
    f.gas = gas->exchange<D>(here, atom->nlocal);
    gas->took(f.gas);
  }
  if (drift_removed) {
    f.drift = here.sums(atom->nlocal, Foam::DriftSums<D, typename Space::Bubbles>{f});
    f.drift_removed = true;
  }
  return f;
}

template <class Space> void FixFoamIntegrate::keep_history_in(Space &here)
{
  using B = typename Space::Bubbles;
  const auto s = state(here);
  Foam::with_dimension(dim,
                       [&]<int D>() { here.for_each(atom->nlocal, Foam::KeepHistory<D, B>{s}); });
}

template <class Space> void FixFoamIntegrate::take_rates_in(Space &here, bool history)
{
  using B = typename Space::Bubbles;
  const auto s = state(here);
  Foam::with_dimension(dim, [&]<int D>() {
    here.for_each(atom->nlocal, Foam::TakeRates<D, B>{s, rates<D>(here), history, lagged()});
  });
}

template <class Space> void FixFoamIntegrate::redistribute_in(Space &here, double factor)
{
  using B = typename Space::Bubbles;
  const auto s = state(here);
  const double smallest = gas->smallest_radius();
  Foam::with_dimension(dim, [&]<int D>() {
    here.for_each(atom->nlocal, Foam::Redistribute<D, B>{s, smallest, factor});
  });
}

template <class Space> void FixFoamIntegrate::return_to_start_in(Space &here)
{
  using B = typename Space::Bubbles;
  const auto s = state(here);
  Foam::with_dimension(dim,
                       [&]<int D>() { here.for_each(atom->nlocal, Foam::ReturnToStart<D, B>{s}); });
}

template <class Space> void FixFoamIntegrate::take_listed_in(Space &here)
{
  here.for_each(atom->nlocal, Foam::TakeListed<typename Space::Bubbles>{state(here)});
}

template <class Space> double FixFoamIntegrate::largest_radius_in(Space &here)
{
  const Foam::LargestRadius<typename Space::Bubbles> body{here.bubbles()};
  return here.totals(atom->nlocal, body).max[Foam::LARGEST];
}

template <class Space> double FixFoamIntegrate::count_bubbles_in(Space &here)
{
  return here.totals(atom->nlocal, Foam::CountBubbles()).sum[Foam::BUBBLES];
}

}    // namespace LAMMPS_NS

#endif
