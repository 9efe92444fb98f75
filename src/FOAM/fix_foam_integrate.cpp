/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_integrate.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   one timestep: steps are tried until one is accepted
------------------------------------------------------------------------- */

void FixFoamIntegrate::initial_integrate(int)
{
  if (lag.active != lags() || solved_with != pair->mu_c || solved_mean != pair->neighbor_solve)
    error->all(FLERR, "Fix {}: the drag has changed since the last run: run without 'pre no'",
               style);
  out.begin_step();
  atime_start = update->atime;
  if (shear) shear->begin_step();
  if (domain->box_change) list.state_has_changed();    // the box has moved since
  if (gas && gas->changed) {                           // and no set-up has looked at it
    evaluate(0.0);
    take_rates(false);
    lag.known = lag.active;
    driver.h_before = 0.0;
    gas->changed = false;
  }
  driver.step(*this);
  out.schedule_time_dumps(update->dt, MIN(driver.h, largest_step()));
  if (gas && gas->has_dead() && out.due(this)) next_reneighbor = update->ntimestep;
}

// a candidate, and what is to be known of it over all ranks

Foam::Trial FixFoamIntegrate::attempt(double step, bool first)
{
  step_tried = step;
  totals = reduce(candidate(step, first));
  const double components = (totals.bubbles + totals.removed) * (dim + (grows() ? 1 : 0));
  double error =
      Foam::step_error(norm, totals.error, totals.squares, components, pair->hub.record.rin);
  if (totals.bad > 0.0) error = INFINITY;
  const FoamBoxLater box(domain, shear ? step : 0.0);
  return {error, totals.moved, list.margin()};
}

// forces beyond the neighbor list are not trusted: list the start anew, with a wider skin, or step less far

bool FixFoamIntegrate::extend_reach()
{
  if (list.is_new()) {
    const FoamBoxLater box(domain, shear ? step_tried : 0.0);    // as margin() was in attempt()
    if (!list.widen(totals.moved, mean_radius())) {
      list.outlisted++;
      return false;
    }
  }
  return_to_start();
  list.rebuild();
  return true;
}

void FixFoamIntegrate::too_short(double step, bool refused)
{
  if (!refused)
    error->all(FLERR,
               "Fix {}: the step of {} at step {}, t = {}, is too short: raise dt0, dtmax or the "
               "timestep command",
               style, step, update->ntimestep, driver.time);
  error->all(FLERR,
             "Fix {}: the step fell to {} at step {}, t = {}, with error {} above the "
             "tolerance {}: look for bad forces, raise the tolerance or lower dt0; {}",
             style, step, update->ntimestep, driver.time, driver.error_last,
             driver.control.tolerance, worst_bubble());
}

// The history waits for the next rates, in one loop with them, unless these are known already,
// or something changes LAMMPS' v before they are.

bool FixFoamIntegrate::history_at_accept() const
{
  return !evaluates_again() || lag.active || domain->deform_vremap;
}

void FixFoamIntegrate::accept(double step)
{
  if (has_history() && history_at_accept()) keep_history();
  if (paths) add_to_path();
  if (gas) remove_small();    // lets bubbles grow a little: adds to totals.ahead

  if (list.is_new()) list.widen(totals.moved * MIN(driver.h, largest_step()) / step, mean_radius());
  list.state_has_changed();
  list.step_taken();
  if (shear) shear->box_goes_on(step);
  evaluated_later = 0.0;
  {
    const FoamBoxLater box(domain,
                           shear ? step : 0.0);    // as ahead is, at the end of the next one
    if (totals.ahead > list.margin()) next_reneighbor = update->ntimestep;
  }

  update->atime = atime_start + step;
  update->atimestep = update->ntimestep;
  set_timestep(step);

  if (gas) {
    gas->accepted(step, totals.removed, totals.gas_removed);
    const std::string reason = gas->end_reached();
    if (!reason.empty()) out.stop_run(style, reason);
  }
}

// as fix dt/reset does; time dumps see schedule_time_dumps()

void FixFoamIntegrate::set_timestep(double step)
{
  if (update->dt == step) return;
  update->dt = step;
  update->dt_default = 0;
  force->pair->reset_dt();
  for (auto &ifix : modify->get_fix_list()) ifix->reset_dt();
}

// remove the smallest bubbles and share out their gas

void FixFoamIntegrate::remove_small()
{
  using namespace Foam;
  double scale = 1.0;    // of radii
  if (totals.removed > 0.0) {
    if (!(totals.gas > 0.0))
      error->all(FLERR,
                 "Fix {}: no bubbles are left after step {}, t = {}: all {:.0f} fell below "
                 "rmin at once; lower rmin or the tolerance, or end the run earlier with nmin",
                 style, update->ntimestep, driver.time, double(totals.removed));
    const double factor = redistribution_factor(totals.gas_removed, totals.gas);
    scale = with_dimension(dim, [&]<int D>() { return radius_of_power<D>(factor); });
    redistribute(variable == Variable::RADIUS ? scale : factor);
  }
  pair->hub.population = {totals.bubbles, totals.radii * scale, totals.gas + totals.gas_removed,
                          totals.radius_max * scale};
  totals.ahead.value += pair->range() * totals.radius_max * (scale - 1.0);
}

/* ----------------------------------------------------------------------
   the loops over bubbles on the host
------------------------------------------------------------------------- */

void FixFoamIntegrate::keep_history()
{
  FoamHost space(lmp, groupbit);
  keep_history_in(space);
}

void FixFoamIntegrate::take_rates(bool history)
{
  FoamHost space(lmp, groupbit);
  take_rates_in(space, history);
}

void FixFoamIntegrate::redistribute(double factor)
{
  FoamHost space(lmp, groupbit);
  redistribute_in(space, factor);
}

void FixFoamIntegrate::return_to_start()
{
  FoamHost space(lmp, groupbit);
  return_to_start_in(space);
}

void FixFoamIntegrate::add_to_path()
{
  FoamHost space(lmp, groupbit);
  add_to_path_in(space);
}

void FixFoamIntegrate::take_listed()
{
  FoamHost space(lmp, groupbit);
  take_listed_in(space);
  pair->take_list();
}

void FixFoamIntegrate::solve_drag()
{
  FoamHost space(lmp, groupbit);
  solve_drag_in(space);
}

// Velocities whose error moves bubbles by a small part of the tolerance of a step, and is small beside the change of
// velocities from which the spectral radius is estimated

double FixFoamIntegrate::error_of_drag() const
{
  constexpr double PART = 0.02;
  const double first = dt_start > 0.0 ? dt_start : update->dt;
  const double h = MIN(driver.h > 0.0 ? driver.h : first, largest_step());
  const double length = pair->hub.record.rin;
  return MIN(PART * driver.control.tolerance * length / h,
             PART * displacement() * length / natural_time());
}

// of drag by the mean of neighbors, see foam_contact_drag.h

double FixFoamIntegrate::least_eigenvalue() const
{
  double longest = 0.0;    // between walls the longest wave is twice as long
  for (int k = 0; k < dim; k++)
    longest = std::max(longest, domain->prd[k] * (domain->periodicity[k] ? 1.0 : 2.0));
  const double angle = 2.0 * Foam::PI * MIN(2.0 * pair->hub.record.rin / longest, 0.25);
  return 0.25 * angle * angle / (2.0 * dim);
}

void FixFoamIntegrate::no_solution()
{
  if (pair->neighbor_solve)
    error->all(FLERR,
               "Fix {}: the velocities of bubbles that move with their neighbors were not found: "
               "use drag neighbor, which follows them step by step",
               style);
  error->all(
      FLERR,
      "Fix {}: the velocities of bubbles that drag each other were not found: mu_c = {} is too "
      "large beside mu0 = {}",
      style, pair->mu_c, pair->mu0);
}

void FixFoamIntegrate::shift_by_images(double sign)
{
  FoamHost space(lmp, groupbit);
  shift_by_images_in(space, sign);
}

double FixFoamIntegrate::largest_radius()
{
  FoamHost space(lmp, groupbit);
  return largest_radius_in(space);
}

/* ----------------------------------------------------------------------
   evaluation out of turn, in the order in which LAMMPS evaluates in turn
------------------------------------------------------------------------- */

void FixFoamIntegrate::compute_forces(int eflag, int vflag)
{
  timer->stamp(Timer::MODIFY);
  comm->forward_comm();
  timer->stamp(Timer::COMM);

  const int nall = atom->nlocal + (force->newton ? atom->nghost : 0);
  if (nall) memset(&atom->f[0][0], 0, 3 * sizeof(double) * nall);
  if (modify->n_pre_force) modify->pre_force(vflag);
  timer->stamp(Timer::MODIFY);
  force->pair->compute(eflag, vflag);
  timer->stamp(Timer::PAIR);
  if (force->newton) comm->reverse_comm();
  timer->stamp(Timer::COMM);
  if (modify->n_post_force_any) modify->post_force(vflag);
}

// fix enforce2d, which 2D scenes often have, sets to 0 what is 0; the forces of fix foam/wall depend on the state alone

bool FixFoamIntegrate::others_act() const
{
  if (!modify->n_pre_force && !modify->n_post_force_any) return false;
  for (int m = 0; m < modify->nfix; m++)
    if ((modify->fmask[m] & (PRE_FORCE | POST_FORCE)) &&
        !utils::strmatch(modify->fix[m]->style, "^enforce2d") &&
        !utils::strmatch(modify->fix[m]->style, "^foam/wall"))
      return true;
  return false;
}

// Forces of other fixes may depend on time, which LAMMPS counts in steps: its last time, and the steps since
// then.

void FixFoamIntegrate::evaluate(double later)
{
  update->atime = atime_start + later;
  update->atimestep = update->ntimestep;
  evaluated_later = shear ? later : 0.0;
  {
    const FoamBoxLater box(domain, evaluated_later);
    compute_forces(0, 0);
  }
  solve_drag();
  evaluations++;
  for (FoamFollower *one : followers) one->attempted(later);
}

/* ----------------------------------------------------------------------
   the rates of the new state, from LAMMPS' own force computation
------------------------------------------------------------------------- */

void FixFoamIntegrate::final_integrate()
{
  for (FoamFollower *one : followers) one->accepted(driver.h_last, out.due(this));
  if (paths && out.due(this)) show_path();
  if (!evaluates_again()) return;
  evaluations++;
  solve_drag();
  take_rates(has_history() && !history_at_accept());
  lag.known = lag.active;
}

/* ----------------------------------------------------------------------
   neighbor lists: see FoamListGuard
------------------------------------------------------------------------- */

void FixFoamIntegrate::post_neighbor()
{
  start.use(atom->nmax);
  listed.use(atom->nmax);
  if (lag.active) lag.v_start.use(atom->nmax);
  if (uses_work()) work.use(atom->nmax);
  if (images_shifted) shift_by_images(-1.0);
  images_shifted = false;
  take_listed();
  list.built();

  check_ghosts();

  // Other fixes may just have put bubbles in or taken them out.  Where a restart file is written, a mean has to be the
  // sum in the order in which it will be taken from there.

  const bool restart_due = update->ntimestep == output->next_restart;
  if (!gas) return;
  if (restart_due || pair->hub.population.bubbles != bubbles()) take_population();
  const double number = pair->hub.population.bubbles;
  bubbles_sorted = sorts ? number : MAX(bubbles_sorted, number);
  sorts = false;
}

// Bubbles that have outgrown the cutoffs, or another skin, need new ones.  A step that writes a restart file
// also leaves the order of bubbles and the list just as a run from that file will find them,
// so that it goes on bit by bit.

void FixFoamIntegrate::pre_exchange()
{
  if (shear) shift_by_images(1.0);
  images_shifted = shear;
  const bool restart_due = update->ntimestep == output->next_restart;
  double mine = largest_radius(), largest;
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  const bool skin_due = list.skin_is_due();
  if (restart_due || skin_due || pair->outgrown(largest)) {
    list.with_checks([&] { pair->refresh(); });
  }
  if (restart_due) atom->setup();

  // The last bubbles in memory take the places of those that vanish: after a while neighbors are no longer near each other

  constexpr double MANY = 0.1;
  sorts = restart_due || (gas && pair->hub.population.bubbles < (1.0 - MANY) * bubbles_sorted);
  if (sorts) atom->nextsort = update->ntimestep;
}
/* ----------------------------------------------------------------------
   the end of a run
------------------------------------------------------------------------- */

void FixFoamIntegrate::end_of_step()
{
  if (!out.last_line_due()) return;
  compute_forces(ENERGY_GLOBAL | ENERGY_ATOM, VIRIAL_PAIR | VIRIAL_ATOM);
  out.add_last_line();
}

void FixFoamIntegrate::post_run()
{
  bubbles_last = gas ? pair->hub.population.bubbles : bubbles();    // without the dead
  out.end_run();
  record = pair->hub.record;
  set_timestep(dt_given);    // minimizers, for one, step by it
  list.give_checks_back();
  list.warn(style, driver.accepted - accepted_then);
  list.end_run(style);
  pair->hub.skin = list.skin_now;
  lag.keep_last();
}

/* ---------------------------------------------------------------------- */

// in which a spring relaxes; else in which a bubble coarsens

double FixFoamIntegrate::natural_time() const
{
  const double sigma0 = pair->stiffest();
  if (sigma0 > 0.0) return pair->mu0 / sigma0;
  return grows() ? Foam::time_of_scaled(gas->K, 1.0, pair->hub.record.rin) : 1.0;
}

// by default, the time in which a bubble of the mean radius coarsens, or a thousand relaxation times at fixed radii

double FixFoamIntegrate::largest_step() const
{
  double largest = 1000.0 * natural_time();
  if (dt_limit > 0.0)
    largest = dt_limit;
  else if (grows())
    largest = Foam::time_of_scaled(gas->K, 1.0, mean_radius());
  return MIN(largest, stable_step());
}

double FixFoamIntegrate::mean_radius() const
{
  const FoamHub::Population &now = pair->hub.population;    // empty where radii stay
  return now.bubbles > 0.0 ? now.radius_sum / now.bubbles : pair->hub.record.rin;
}

double FixFoamIntegrate::compute_vector(int n)
{
  switch (n) {
    case 0:
      return driver.time;
    case 1:
      return driver.h_last;
    case 2:
      return driver.accepted;
    case 3:
      return driver.rejected;
    case 4:
      return evaluations;
    case 5:
      return driver.error_last;
    default:
      return driver.time - time_then;
  }
}
