/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(liquid/flow,FixLiquidFlow);
// clang-format on
#else

#ifndef LMP_FIX_LIQUID_FLOW_H
#define LMP_FIX_LIQUID_FLOW_H

#include "fix_foam_travelling.h"
#include "foam_output.h"
#include "liquid_operators.h"
#include "liquid_solver.h"
#include "pair_liquid_sph.h"

#include "atom.h"

#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

// The flow of a resolved liquid: a projection in each step, of a length that is chosen (liquid_operators.h)

class FixLiquidFlow : public FixFoamTravelling {
 public:
  FixLiquidFlow(class LAMMPS *, int, char **);
  void post_constructor() override;
  static FixLiquidFlow *of(class LAMMPS *);    // the one there is, or none
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_exchange() override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;
  void reset_dt() override {}
  double compute_vector(int) override;
  double memory_usage() override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;

  void write_restart(FILE *) override;
  void restart(char *) override;

  enum { PRESSURE, OLDER, ACCELERATION, SMOOTHING = ACCELERATION + 3, STATE };
  FoamColumns state{all_columns, "state of the liquid", STATE, TRAVELS};
  Liquid::Walls walls;
  double froude() const;    // 0: no gravity
  void begin_run();         // in the first step, whichever fix comes first
  double last_step() const { return now.done_dt; }
  double entraining() const { return totals.entraining; }    // particles of this rank
  const Liquid::Setting &setting() const { return set; }
  FoamColumns work{all_columns, "columns of the liquid", Liquid::COLUMNS,
                   STAYS};    // of the last evaluation

 protected:
  PairLiquidSPH *pair = nullptr;
  class FixBubbleFlow *gas = nullptr;    // none: no bubbles
  Liquid::Setting set;

  virtual void look();    // at velocities
  virtual void keep_pressure();
  virtual void advance(double dt);
  virtual void order();              // of the atoms of this rank
  virtual void gather(double dt);    // 0: bubbles keep their velocities
  virtual void project(double dt);
  virtual void move(double dt);

  template <class Space> Liquid::Columns columns_in(Space &space)
  {
    Liquid::Columns all;
    for (int k = 0; k < Liquid::COLUMNS; k++) all.at[k] = space.column(work, k);
    return all;
  }
  template <class Space, class List> auto loop_in(Space &space, const List &list)
  {
    return Liquid::Loop<typename Space::Bubbles, List>{space.bubbles(), list, walls,
                                                       columns_in(space), set};
  }

  // Rows: whose lists they are, as PairLiquidSPH; Room: for neighbors and the matrix (fix_liquid_flow_loops.h)

  template <class Space> void look_in(Space &);
  template <class Space> void keep_pressure_in(Space &);
  template <class Space> void advance_in(Space &, double dt);
  template <class Space, class Rows, class Room> void find_close_in(Space &, const Rows &, Room &);
  template <class Space, class Rows, class Room> auto close_loop_in(Space &, const Rows &, Room &);
  template <class Space, class Rows, class Room>
  void gather_in(Space &, const Rows &, Room &, double dt);
  template <class Space, class Rows, class Room>
  void project_in(Space &, const Rows &, Room &, double dt);
  template <class Space> void move_in(Space &, double dt);
  template <bool BY_ROWS, class Space>
  Liquid::Solved solve_in(Space &, const Liquid::Matrix<BY_ROWS> &);

  virtual void send(FoamColumns &columns, int first, int count);    // to ghosts
  FoamColumns *sent = nullptr;                                      // these, now
  int sent_first = 0, sent_count = 0;

  FoamColumns vectors{all_columns, "vectors of the solver", 7, STAYS};

 private:
  struct HostRoom {
    static constexpr bool BY_ROWS = true;
    std::vector<double> entries;
    std::vector<int> partners, sizes, used;
    Liquid::CloseRows<true> close(size_t rows, size_t width);
    Liquid::Matrix<true> matrix(const Liquid::CloseRows<true> &);
    double bytes() const;
  } room;
  int row_width = 96;                                // of neighbors: as many as there were so far
  std::vector<std::pair<int, std::string>> given;    // variables with the state of the start

  double tolerance = 1.0e-6, courant = Liquid::COURANT, longest = 0.0, given_dt = 0.0;
  int most_iterations = 1000;
  struct Progress {          // kept in restart files
    double next_dt = 0.0;    // 0: not yet known
    double done_dt = 0.0;    // of the last step
    double limit = 0.0;      // of the next one, after a step was repeated; 0: none
    double repeated = 0.0;
  } now;
  FoamOutput out;
  Liquid::GatherTotals totals;
  Liquid::SpeedTotals speeds;    // of this rank
  Liquid::Solved solved;
  bool without_level = false;    // of the pressure: there is no surface.  Then it is its mean:
  double level = 0.0;
  bool told_of_gas = false, told_of_lists = false;

  double longest_step(double nu);
  void limit_step();
  double choose_step();
  void find_pressure();
  bool solve(double dt);
  double shorter(double dt, int tries) const;
  void stop(double dt) const;
  void begin_again(double dt);
  static const std::vector<std::string> FACES;    // of the box
  void check_particles() const;
  void check_others() const;
  void check_lists() const;
  void check_way_back(double dt);
};

}    // namespace LAMMPS_NS

#endif
#endif
