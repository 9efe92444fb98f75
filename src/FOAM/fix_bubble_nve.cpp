/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_nve.h"

#include "fix_wall_bubble.h"
#include "foam_host.h"
#include "foam_input.h"
#include "foam_timestep.h"
#include "pair_bubble_collision.h"

#include "comm.h"
#include "error.h"
#include "modify.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID bubble/nve keyword value ...
------------------------------------------------------------------------- */

FixBubbleNVE::FixBubbleNVE(LAMMPS *lmp, int narg, char **arg)
    : FixFoamTravelling(lmp, narg, arg), out(lmp)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix bubble/nve", narg - 3, arg + 3);
  input.keywords({{"tol",
                   [&](const Value &v) {
                     tolerance = v.number(FoamInput::ABOVE, 0.0);
                   }},
                  {"dtmax", [&](const Value &v) {
                     longest = v.number(FoamInput::ABOVE, 0.0);
                   }}});
  time_integrate = 1;
  dynamic_group_allow = 1;
  nevery = 1;
  vector_flag = 1;
  size_vector = 4;
  extvector = 0;
  global_freq = 1;
  restart_global = 1;
  maxexchange = NCOLUMNS;

  columns.use(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
  add_callbacks();
}

int FixBubbleNVE::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | END_OF_STEP |
         PRE_EXCHANGE;    // the latter for set-up
}

void FixBubbleNVE::init()
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix bubble/nve needs atom_style sphere");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix bubble/nve needs run_style verlet");
  pair = PairBubbleCollision::of(lmp);
  rise = FixBubbleRise::of(lmp);
  if (pair) pair->check_place("Fix bubble/nve", kokkosable, execution_space);
  if (rise) rise->check_place("Fix bubble/nve", kokkosable, execution_space);
  int others = 0;
  for (auto &fix : modify->get_fix_list())
    if (fix != this && fix->time_integrate) others++;
  if (others && comm->me == 0)
    error->warning(FLERR, "Fix bubble/nve: {} other fix(es) integrate, too: each bubble needs one",
                   others);
  dt_given = update->dt;
}

Bubble::Liquid FixBubbleNVE::liquid() const
{
  return rise ? rise->liquid : Bubble::Liquid();
}

/* ----------------------------------------------------------------------
   set-up: the forces that the last step ended with, unless somebody has changed velocities
------------------------------------------------------------------------- */

void FixBubbleNVE::setup_pre_exchange()
{
  take_predicted();
}

void FixBubbleNVE::setup(int)
{
  give_back();
  if (tolerance > 0.0) set_timestep(h > 0.0 ? h : std::min(update->dt, next_step()));
}

void FixBubbleNVE::initial_integrate(int)
{
  out.begin_step();
  advance();
}

void FixBubbleNVE::final_integrate()
{
  finish();
}

void FixBubbleNVE::take_predicted()
{
  FoamHost space(lmp, groupbit);
  take_predicted_in(space);
}

void FixBubbleNVE::give_back()
{
  FoamHost space(lmp, groupbit);
  give_back_in(space);
}

void FixBubbleNVE::advance()
{
  FoamHost space(lmp, groupbit);
  advance_in(space);
}

void FixBubbleNVE::finish()
{
  FoamHost space(lmp, groupbit);
  finish_in(space);
}

void FixBubbleNVE::end_of_step()
{
  if (!(tolerance > 0.0)) return;
  const double step = h;
  set_timestep(next_step());
  out.schedule_time_dumps(step, h);
}

void FixBubbleNVE::set_timestep(double step)
{
  h = step;
  shortest = shortest > 0.0 ? std::min(shortest, step) : step;
  foam_set_timestep(lmp, step);
}

// The error of a step, h |d| / R, goes with its third power.  Steps are not tried again, so that none may come upon
// forces that it has not seen: no bubble goes further than a part of its radius, no gap closes by more than a part of
// itself.  And friction between bubbles and with walls is explicit: stable for h Gamma < 2, pairs have twice the Gamma.

double FixBubbleNVE::next_step()
{
  constexpr double SAFETY = 0.9, GROW = 1.3, SHRINK = 0.3, STABLE = 0.8;
  double closing = 0.0;
  std::vector<double> mine{totals.error, totals.rate, totals.lightness, 0.0};
  auto meets = [&](const Bubble::CollisionTotals &its) {
    closing = std::max(closing, double(its.closing));
    mine.push_back(its.friction);    // all ranks' largest of each, then their sum
  };
  if (pair) meets(pair->of_this_rank());
  for (auto &fix : modify->get_fix_list())
    if (auto *wall = dynamic_cast<FixWallBubble *>(fix)) meets(wall->of_this_rank());
  mine[3] = closing;
  std::vector<double> all(mine.size());
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_MAX, world);
  const double friction = std::accumulate(all.begin() + 4, all.end(), 0.0);

  error_last = all[0];
  error_worst = std::max(error_worst, error_last);
  const double factor = error_last > 0.0 ? SAFETY * std::cbrt(tolerance / error_last) : GROW;
  double step = update->dt * std::clamp(factor, SHRINK, GROW);
  auto limit = [&](double part, double rate) {
    if (rate > 0.0) step = std::min(step, part / rate);
  };
  limit(Bubble::MOVED_IN_A_STEP, all[1]);
  limit(Bubble::CLOSED_IN_A_STEP, all[3]);
  limit(STABLE, all[2] * friction);
  if (longest > 0.0) step = std::min(step, longest);
  if (!std::isfinite(error_last) || !(update->atime + step > update->atime))
    error->all(FLERR,
               "Fix bubble/nve: the step fell to {} at step {}, with error {}: look for bad forces",
               step, update->ntimestep, error_last);
  return step;
}

void FixBubbleNVE::post_run()
{
  if (!(tolerance > 0.0)) return;
  const double next = h, least = shortest;
  set_timestep(dt_given);
  h = next;
  shortest = least;
}

double FixBubbleNVE::compute_vector(int n)
{
  double all;
  if (n == 0) {
    double mine = totals.error;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
    return all;
  }
  if (n == 1) return tolerance > 0.0 ? error_worst : 0.0;
  if (n == 2) return update->dt;
  return shortest;
}

void FixBubbleNVE::set_arrays(int i)    // a new bubble
{
  for (int k = 0; k < 3; k++) {
    columns[KICK + k][i] = 0.0;
    columns[PREDICTED + k][i] = columns[END + k][i] = atom->v[i][k];
  }
}

void FixBubbleNVE::write_restart(FILE *fp)
{
  const double values[] = {h, error_worst, shortest};
  if (comm->me != 0) return;
  const int size = sizeof(values);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(values, size, 1, fp);
}

void FixBubbleNVE::restart(char *buf)
{
  const auto *values = (const double *) buf;
  h = values[0];
  error_worst = values[1];
  shortest = values[2];
}
