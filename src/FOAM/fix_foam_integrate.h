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
  class PairDurianFoam *pair;
  class FixFoamCoarsen *gas;    // null: radii stay as they are
  FoamReduce reduce;
  int dim;

  // settings

  enum class Variable { VOLUME, RADIUS };    // q = R^d or q = R
  enum class Norm { MAX, RMS };

  Foam::StepControl control;
  Variable variable;
  Norm norm;
  double dt_start, dt_limit;    // 0: the defaults
  bool drift_removed;

  // progress, kept in restarts

  double time, h, h_before;    // h: next step to try; h_before: last accepted, 0 without history
  double accepted, rejected, evaluations, error_last;
  double bubbles_last;    // their number at the end of the last run

  // per bubble, travelling with it

  enum { Q, QDOT, VX_BEFORE, VY_BEFORE, VZ_BEFORE, QDOT_BEFORE, NCOLUMNS };
  FoamColumns columns;

  // neighbor drag only: the velocities l that the evaluation of the present ones took as given,
  // see Foam::lagged_velocity(), and the velocities with which the last run ended

  enum { LAGX, LAGY, LAGZ, LASTX, LASTY, LASTZ, NLAGS };
  FoamColumns lags;

  // ---- what a scheme does

  struct Trial {                     // of this rank's bubbles
    double error_max = 0.0;          // lengths
    double error_squares = 0.0;      // lengths squared, all components of all bubbles
    double moved = 0.0;              // farthest that an evaluated state is from the listed one
  };
  virtual Trial attempt(double step) = 0;    // leaves its candidate in x, Q and radius
  virtual void keep_history() = 0;           // accepted; v_start and QDOT still are f_n
  virtual bool evaluates_again() const { return true; }    // or has the next rates already

  // ---- what a scheme uses

  double **x_start;    // y_n, and the radii in it
  double *q_start, *radius_start;
  double **v_start;    // v of f_n: atom->v itself, unless neighbor drag needs that for l
  double *rate;    // qdot as evaluated last

  double **x_listed;         // where bubbles were when the neighbor list was built,
  double *radius_listed;     // and how large

  void evaluate();    // forces, drag (from l in atom->v) and qdot of the state in x, radius

  struct Velocities {    // of the state evaluated last
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
  Velocities velocities() const;    // on all ranks together

  template <int D> double radius_of(double q) const
  {
    if (variable == Variable::VOLUME) return Foam::radius_of_power<D>(q);
    return q < 0.0 ? 0.0 : q;
  }
  template <int D> double q_of(double R) const
  {
    return variable == Variable::VOLUME ? Foam::power_of_radius<D>(R) : R;
  }

 private:
  int nscratch, nlisted;    // allocated lengths
  double **v_copy;
  bigint dump_foreseen;    // step for which energies of bubbles were asked for in time
  bool ghosts_checked;
  double corners_listed[8][3];
  bool list_is_new;    // built at the present state
  bool stopping;       // the run has reached its end
  bool have_lags;

  FoamTotals totals;    // of a candidate, see judge()
  enum { N, RADII, GAS, REMOVED, GAS_REMOVED, SQUARES, BAD };
  enum { ERROR, MOVED, AHEAD, RADIUS };

  template <int D> void judge(const Trial &);
  void accept(double step);
  void redistribute();
  void keep_start();
  void return_to_start();
  void rebuild_lists();
  void exchange_rates();
  void take_rates();
  void take_population();
  void schedule_time_dumps();
  void check_bubbles();
  void check_ghosts();
  void stop_run(const std::string &);
  bool output_due() const;
  double largest_step() const;
  double natural_time() const;
  double list_margin() const;
  void box_corners(double (*)[3]) const;
  template <int D> double content(double q) const;
};

}    // namespace LAMMPS_NS

#endif
