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
#include "foam_columns.h"
#include "foam_reduce.h"
#include "foam_stepper.h"

namespace LAMMPS_NS {

// What every integrator of a foam shares; a scheme, such as FixFoamABM, adds its formula.
//
// The state is y = (x, q) with q = R^d (or R), its rates are f = (v, qdot).  One LAMMPS
// timestep is one accepted step: initial_integrate() tries steps, each with evaluations out
// of turn, until one is accepted; LAMMPS then computes the forces of the new state, and
// final_integrate() turns them into the rates that the next step starts from.  So thermo,
// dumps and restarts see one consistent state.

class FixFoamIntegrate : public Fix {
 public:
  FixFoamIntegrate(class LAMMPS *, int, char **);
  ~FixFoamIntegrate() override;

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_post_neighbor() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_exchange() override;
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
  class PairDurianFoam *pair = nullptr;
  class FixFoamCoarsen *gas = nullptr;    // null: radii stay as they are
  FoamReduce reduce;
  int dim;

  // settings

  enum class Variable { VOLUME, RADIUS };    // q = R^d or q = R

  Foam::StepControl control;
  Variable variable = Variable::VOLUME;
  Foam::Norm norm = Foam::Norm::MAX;
  double dt_start = 0.0, dt_limit = 0.0;    // 0: the defaults
  bool drift_removed = false;

  // progress, kept in restarts

  double time = 0.0;
  double h = 0.0;           // step to try next; 0 before the first
  double h_before = 0.0;    // step between f_{n-1} and f_n; 0 without history
  double h_last = 0.0;      // last accepted step
  double accepted = 0.0, rejected = 0.0, evaluations = 0.0, error_last = 0.0;
  double bubbles_last = 0.0;                // their number at the end of the last run
  double rin_kept = 0.0, ain_kept = 0.0;    // for a pair style that is replaced in mid-simulation
  double have_lags = 0.0;                   // 1 if LAG and LAST are those of a previous run

  // per bubble, travelling with it

  enum { Q, QDOT, VX_BEFORE, VY_BEFORE, VZ_BEFORE, QDOT_BEFORE, NCOLUMNS };
  FoamColumns columns;

  // neighbor drag only: the velocities l that the evaluation of the present ones took as given,
  // see Foam::lagged_velocity(), and the velocities with which the last run ended

  enum { LAGX, LAGY, LAGZ, LASTX, LASTY, LASTZ, NLAGS };
  FoamColumns lags;

  // ---- what a scheme does

  struct Trial {                   // of this rank's bubbles
    double error_max = 0.0;        // lengths
    double error_squares = 0.0;    // lengths squared, all components of all bubbles
    double moved = 0.0;            // farthest that an evaluated state is from the listed one
  };
  virtual Trial attempt(double step) = 0;    // leaves its candidate in x, Q and radius
  virtual void keep_history() = 0;           // accepted; v_start and QDOT still are f_n
  virtual bool evaluates_again() const { return true; }    // or has the next rates already

  // ---- what a scheme uses

  double **x_start = nullptr;    // y_n, and the radii in it
  double *q_start = nullptr, *radius_start = nullptr;
  double **v_start = nullptr;         // v of f_n: atom->v, unless neighbor drag needs that for l
  double *rate = nullptr;             // qdot as evaluated last
  double **x_listed = nullptr;        // where bubbles were when the neighbor list was built,
  double *radius_listed = nullptr;    // and how large

  void evaluate();    // forces, drag (from l in atom->v), qdot of the state in x, radius

  struct Velocities {                        // of the state evaluated last
    const double *const *f, *const *vsum;    // vsum is null with static drag
    const double *contacts, *radius;
    double mu0;
    double drift[3];    // mean of all bubbles, to be taken off
    double operator()(int i, int k) const
    {
      if (!(radius[i] > 0.0)) return 0.0;
      const double u = vsum ? Foam::mean_of_neighbors(vsum[i][k], contacts[i]) : 0.0;
      return Foam::drag_velocity(f[i][k], mu0, u) - drift[k];
    }
  };
  Velocities velocities() const;    // call on all ranks: drift remove sums over them

  template <int D> double radius_of(double q) const
  {
    if (variable == Variable::VOLUME) return Foam::radius_of_power<D>(q);
    return q < 0.0 ? 0.0 : q;
  }
  template <int D> double q_of(double R) const
  {
    return variable == Variable::VOLUME ? Foam::power_of_radius<D>(R) : R;
  }
  double radius_of(double q) const { return dim == 2 ? radius_of<2>(q) : radius_of<3>(q); }
  double q_of(double R) const { return dim == 2 ? q_of<2>(R) : q_of<3>(R); }

  // ---- the loops over bubbles; a version for the device replaces these and keeps the rest

  FoamTotals totals;    // of a candidate, see judge()
  enum { N, RADII, GAS, REMOVED, GAS_REMOVED, SQUARES, BAD };
  enum { ERROR, MOVED, AHEAD, RADIUS };

  virtual void compute_forces(int eflag, int vflag);
  virtual void judge(const Trial &);
  virtual void redistribute();
  virtual void keep_start();
  virtual void return_to_start();
  virtual void rebuild_lists();
  virtual void exchange_rates();
  virtual void take_rates();
  virtual void take_population();
  virtual void check_bubbles();
  virtual void check_ghosts();
  virtual FoamTotals change_of_rates();

 private:
  int nscratch = 0, nlisted = 0;    // allocated lengths
  double **v_copy = nullptr;
  double corners_listed[8][3];
  bool list_is_new = false;       // built at the present state
  bool ghosts_checked = false;    // their radii are communicated
  bool stopping = false;          // the run has reached its end
  bigint dump_foreseen = -1;      // step for which energies of bubbles were asked for in time

  void accept(double step);
  void set_timestep(double);
  void schedule_time_dumps();
  void stop_run(const std::string &);
  bool output_due() const;
  double largest_step() const;
  double natural_time() const;
  double list_margin() const;
  void box_corners(double (*)[3]) const;
  template <int D> double content(double q) const;
  template <int D> void judge_in(const Trial &);
};

}    // namespace LAMMPS_NS

#endif
