/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

// FixFoamIntegrate: the set-up of a run, on the host. What commands may have changed since the last run
// is found here.

#include "fix_foam_integrate.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "output.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

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
  enum { MEMBERS, OTHERS };    // OTHERS: with a radius
  for (int i = 0; i < atom->nlocal; i++) {
    const double R = atom->radius[i], *const x = atom->x[i];
    if (!is_bubble(i)) {
      if (R > 0.0) mine.sum[OTHERS] += 1.0;
      continue;
    }
    mine.sum[MEMBERS] += 1.0;
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
  if (igroup != 0 && bad.sum[MEMBERS] == 0.0)
    error->all(FLERR, "Fix {}: no particle is in group {}, so there is no bubble", style,
               group->names[igroup]);
  if (bad.sum[OTHERS] > 0.0 && !others_told && comm->me == 0)
    utils::logmesg(lmp,
                   "Fix {}: {:.0f} particles with a radius are not in group {}: bubbles feel their "
                   "forces, but exchange no gas with them and do not follow them\n",
                   style, bad.sum[OTHERS], group->names[igroup]);
  others_told = true;

  if (pair->neighbor_drag && domain->deform_vremap && force->newton_pair && !pair->kokkosable)
    error->all(FLERR,
               "Fix {}: pair style durian/foam with drag neighbor and fix deform with remap v "
               "need newton off: a velocity sent back from a ghost is that on its own side of the "
               "boundary",
               style);

  // q follows R where a command has changed R since the last run

  double *const q = columns[Q];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_bubble(i)) continue;
    const double R = atom->radius[i];
    const double known =
        Foam::with_dimension(dim, [&]<int D>() { return Foam::radius_of<D>(variable, q[i]); });
    if (known != R) q[i] = q_of(R);
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
      bool same = is_bubble(i);
      for (int k = 0; k < 3; k++) same = same && v[i][k] == lags[LASTX + k][i];
      if (same)
        for (int k = 0; k < 3; k++) v[i][k] = lags[LAGX + k][i];
    }
  host_wrote();
  comm->forward_comm();
}

void FixFoamIntegrate::setup(int)
{
  out.begin_run();
  list.outlisted = 0;
  accepted_then = accepted;
  update->update_time();
  atime_start = update->atime;

  list.spare_checks();

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

  const double number = bubbles();
  const FoamTotals change =
      Foam::with_dimension(dim, [&]<int D>() { return change_of_rates<D>(); });
  constexpr double SAME = 1.0e-6;    // well above rounding, well below any change of interest
  double v_same = SAME * change.max[1], qdot_same = SAME * change.max[3];
  if (!evaluates_again()) {
    double tolerance = 10.0 * control.tolerance;
    if (norm == Foam::Norm::RMS) tolerance *= std::sqrt((dim + 1) * number);    // of one bubble
    v_same += pair->neighbor_drag ? INFINITY : tolerance * pair->rin / natural_time();
    qdot_same += std::sqrt(tolerance) * change.max[3];    // contact area ~ sqrt(overlap)
  }
  const double exchange =
      gas ? gas->K * std::pow(pair->rin, variable == Foam::Variable::RADIUS ? -1 : dim - 2) : 0.0;
  if (grows() && change.max[3] <= 1.0e-12 * exchange && number > 1.0 && !idle_told) {
    idle_told = true;
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Fix {}: no gas is exchanged in this state, and nothing will coarsen: all radii "
          "are equal, or no bubbles touch and there is no exchange through the liquid",
          style);
  }
  if (change.max[0] > v_same || change.max[2] > qdot_same || bubbles_last != number) h_before = 0.0;

  if (gas) gas->changed = false;
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
    if (!reason.empty()) out.stop_run(style, reason);
  }
}

// largest change of a velocity, largest velocity; the same of qdot

template <int D> FoamTotals FixFoamIntegrate::change_of_rates()
{
  host_reads();
  FoamHost here(lmp, groupbit);
  const auto f = rates<D>(here);
  const bool last = lagged() && have_lags != 0.0;
  FoamTotals mine;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_bubble(i)) continue;
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

double FixFoamIntegrate::count_bubbles()
{
  FoamHost here(lmp, groupbit);
  return count_bubbles_in(here);
}

// on all ranks, while none is dead

double FixFoamIntegrate::bubbles()
{
  if (groupbit == Foam::GROUP_ALL) return atom->natoms;
  const double mine = count_bubbles();
  double all;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixFoamIntegrate::take_population()
{
  if (!gas) return;
  using namespace Foam;
  host_reads();
  FoamTotals mine;
  const double *const q = columns[Q];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_bubble(i)) continue;
    mine.sum[BUBBLES] += 1.0;
    mine.sum[RADII] += atom->radius[i];
    mine.sum[GAS] += with_dimension(dim, [&]<int D>() { return gas_content<D>(variable, q[i]); });
    mine.max[LARGEST] = MAX(mine.max[LARGEST], atom->radius[i]);
  }
  const FoamTotals all = reduce(mine);
  gas->population = {all.sum[BUBBLES], all.sum[RADII], all.sum[GAS], all.max[LARGEST]};
}
