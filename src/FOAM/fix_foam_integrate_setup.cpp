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
#include <limits>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   before a run
------------------------------------------------------------------------- */

void FixFoamIntegrate::setup_pre_exchange()
{
  check_bubbles();
  evaluated_later = 0.0;
  images_shifted = false;
  if (shear) {
    shear->begin_run();
    shear->begin_step();
  }
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
    if (same)
      std::copy_n(before.begin(), 3, x);
    else if (shear)
      take_image(i, before.data());
  }
  places.clear();
  host_wrote();
  comm->forward_comm();
}

// the same as shift_by_images(), for a bubble that has come back at another side

void FixFoamIntegrate::take_image(int i, const double *x_before)
{
  const Foam::AffineFlow affine = foam_affine_flow(domain);
  double u[3], u_before[3];
  affine(atom->x[i], u);
  affine(x_before, u_before);
  for (int k = 0; k < dim; k++) {
    atom->v[i][k] += u[k] - u_before[k];
    if (has_history()) columns[VX_BEFORE + k][i] += u[k] - u_before[k];
  }
}

void FixFoamIntegrate::pre_neighbor()
{
  if (domain->triclinic && update->ntimestep == output->next_restart) comm->forward_comm();
}

void FixFoamIntegrate::check_bubbles()
{
  host_reads();
  struct Checked {
    FoamMax bad_radius, bad_place;    // IDs
    FoamSum bubbles, others;          // others: with a radius
    void join(const Checked &other)
    {
      bad_radius.join(other.bad_radius);
      bad_place.join(other.bad_place);
      bubbles.join(other.bubbles);
      others.join(other.others);
    }
  } mine;
  for (int i = 0; i < atom->nlocal; i++) {
    const double R = atom->radius[i], *const x = atom->x[i];
    if (!is_bubble(i)) {
      if (R > 0.0) mine.others += 1.0;
      continue;
    }
    mine.bubbles += 1.0;
    if (!(R > 0.0) || !std::isfinite(R)) mine.bad_radius.raise(atom->tag[i]);
    if (!std::isfinite(x[0] + x[1] + x[2])) mine.bad_place.raise(atom->tag[i]);
  }
  const Checked all = foam_reduce(mine, world);
  bubbles_sorted = all.bubbles;
  if (all.bad_radius > 0.0)
    error->all(FLERR,
               "Fix {}: the radius of bubble {:.0f} is zero, negative or not a number: "
               "set its diameter or delete it",
               style, double(all.bad_radius));
  if (all.bad_place > 0.0)
    error->all(FLERR, "Fix {}: Non-numeric atom coords of bubble {:.0f}", style,
               double(all.bad_place));
  if (igroup != 0 && all.bubbles == 0.0)
    error->all(FLERR, "Fix {}: no particle is in group {}, so there is no bubble", style,
               group->names[igroup]);
  if (all.others > 0.0 && !others_told && comm->me == 0)
    utils::logmesg(lmp,
                   "Fix {}: {:.0f} particles with a radius are not in group {}: bubbles feel their "
                   "forces, but exchange no gas with them and do not follow them\n",
                   style, double(all.others), group->names[igroup]);
  others_told = true;

  if (pair->neighbor_drag && domain->deform_vremap && force->newton_pair && !pair->kokkosable)
    error->all(FLERR,
               "Fix {}: pair style durian/foam with drag neighbor and fix deform with remap v "
               "need newton off: a velocity sent back from a ghost is that on its own side of the "
               "boundary",
               style);

  // q follows R where a command has changed R since the last run, by more than the rounding of roots

  constexpr double ROUNDING = 4.0 * std::numeric_limits<double>::epsilon();
  double *const q = columns[Q];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_bubble(i)) continue;
    const double R = atom->radius[i];
    const double known =
        Foam::with_dimension(dim, [&]<int D>() { return Foam::radius_of<D>(variable, q[i]); });
    if (!(std::fabs(known - R) <= ROUNDING * R)) q[i] = q_of(R);
  }
}

void FixFoamIntegrate::setup_post_neighbor()
{
  post_neighbor();
  give_lag();
}

void FixFoamIntegrate::give_lag()
{
  lag_given = true;
  if (!lag.active) return;
  host_reads();
  lag.give({atom->mask, groupbit});
  host_wrote();
  comm->forward_comm();
}

// how far rates are from those that are known, and how large they are

struct FixFoamIntegrate::ChangeOfRates {
  FoamMax of_v, v, of_qdot, qdot;
  void join(const ChangeOfRates &other)
  {
    of_v.join(other.of_v);
    v.join(other.v);
    of_qdot.join(other.of_qdot);
    qdot.join(other.qdot);
  }
};

void FixFoamIntegrate::setup(int)
{
  out.begin_run();
  list.outlisted = 0;
  accepted_then = driver.accepted;
  update->update_time();
  atime_start = update->atime;

  list.spare_checks();

  if (pair->neighbor_solve && others_act() && comm->me == 0)
    error->warning(FLERR,
                   "Fix {}: with drag neighbor solve, walls and forces of other fixes do not move "
                   "a cluster of bubbles as a whole: use drag static or contact for that",
                   style);

  // Fixes that come after this one in the input have not added their forces yet, and will, to
  // those in f: the rates need all of them now.  A run without set-up has not taken l from v.

  const double rho = gas ? gas->critical_radius() : 0.0;
  std::vector<double> f_so_far;
  if (modify->n_post_force_any || !lag_given) {
    host_reads();
    const size_t n = 3 * size_t(atom->nlocal + (force->newton ? atom->nghost : 0));
    if (n) f_so_far.assign(&atom->f[0][0], &atom->f[0][0] + n);
    if (!lag_given) give_lag();
    evaluate(0.0);
  } else {
    solve_drag();
    evaluations++;
  }
  lag_given = false;

  // The history of steps is good for as long as the state is the one that it led to: if a
  // command has changed the foam, the rates are no longer those at the end of the last run.
  // Those of the source belong to the predicted state, within the tolerance of the present one;
  // its velocities with neighbor drag do not settle, and so tell nothing.

  const double number = bubbles();
  const ChangeOfRates change =
      Foam::with_dimension(dim, [&]<int D>() { return change_of_rates<D>(); });
  constexpr double SAME = 1.0e-6;    // well above rounding, well below any change of interest
  double v_same = SAME * change.v, qdot_same = SAME * change.qdot;
  if (!evaluates_again()) {
    double tolerance = 10.0 * driver.control.tolerance;
    if (norm == Foam::Norm::RMS) tolerance *= std::sqrt((dim + 1) * number);    // of one bubble
    v_same += pair->neighbor_drag ? INFINITY : tolerance * pair->hub.record.rin / natural_time();
    qdot_same += std::sqrt(tolerance) * change.qdot;    // contact area ~ sqrt(overlap)
  }
  const double exchange = gas ? gas->K * std::pow(pair->hub.record.rin,
                                                  variable == Foam::Variable::RADIUS ? -1 : dim - 2)
                              : 0.0;
  if (grows() && change.qdot <= 1.0e-12 * exchange && number > 1.0 && !idle_told) {
    idle_told = true;
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Fix {}: no gas is exchanged in this state, and nothing will coarsen: all radii "
          "are equal, or no bubbles touch and there is no exchange through the liquid",
          style);
  }
  if (change.of_v > v_same || change.of_qdot > qdot_same || bubbles_last != number)
    driver.h_before = 0.0;

  if (gas) gas->changed = false;
  if (evaluates_again() || driver.h_before == 0.0) {
    take_rates(false);
    lag.known = lag.active;
  } else {
    evaluations--;    // only looked at: the rates of the last run go on
    if (gas) gas->keep_critical_radius(rho);
  }
  if (!f_so_far.empty()) {
    host_reads();
    std::copy(f_so_far.begin(), f_so_far.end(), &atom->f[0][0]);
    host_wrote();
  }

  record = pair->hub.record;

  // after read_restart the timestep is that of the last step, if the file was written in a run

  if (dt_given == 0.0 || update->dt != driver.h_last) dt_given = update->dt;
  double &h = driver.h;
  if (h == 0.0) h = dt_start > 0.0 ? dt_start : update->dt;
  if (!(h > 0.0))
    error->all(FLERR,
               "Fix {}: the first step must be > 0, not {}: see keyword dt0 and the "
               "timestep command",
               style, h);
  set_timestep(MIN(h, largest_step()));
  show_path();

  take_population();
  if (gas) {
    const std::string reason = gas->end_reached();
    if (!reason.empty()) out.stop_run(style, reason);
  }
}

template <int D> FixFoamIntegrate::ChangeOfRates FixFoamIntegrate::change_of_rates()
{
  host_reads();
  FoamHost space(lmp, groupbit);
  const auto f = rates<D>(space);
  const bool last = lag.active && lag.known != 0.0;
  ChangeOfRates mine;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_bubble(i)) continue;
    for (int k = 0; k < D; k++) {
      const double now = f.drag.velocity(i, k);
      const double then = last ? lag.last(k, i) : atom->v[i][k];
      mine.of_v.raise(std::fabs(now - then));
      mine.v.raise(std::fabs(now));
    }
    const double now = gas ? f.qdot(i) : 0.0;
    mine.of_qdot.raise(std::fabs(now - columns[QDOT][i]));
    mine.qdot.raise(std::fabs(now));
  }
  return foam_reduce(mine, world);
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
  bigint mine[2] = {0, 0}, all[2];    // ghosts without and with their radii
  for (int i = nlocal; i < nall; i++) mine[atom->radius[i] < 0.0 ? 0 : 1]++;
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all[0] > 0)
    error->all(FLERR,
               "Fix foam/coarsen changes radii, which have to be communicated in every step: "
               "use atom_style sphere 1");
  ghosts_checked = all[1] > 0;    // else there were none to look at
}

double FixFoamIntegrate::count_bubbles()
{
  FoamHost space(lmp, groupbit);
  return count_bubbles_in(space);
}

// on all ranks, while none is dead

double FixFoamIntegrate::bubbles()
{
  if (groupbit == Foam::GROUP_ALL) return atom->natoms;
  double mine = count_bubbles();
  double all;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void FixFoamIntegrate::take_population()
{
  if (!gas) return;
  using namespace Foam;
  host_reads();
  Judgement mine;
  const double *const q = columns[Q];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_bubble(i)) continue;
    mine.bubbles += 1.0;
    mine.radii += atom->radius[i];
    mine.gas += with_dimension(dim, [&]<int D>() { return gas_content<D>(variable, q[i]); });
    mine.radius_max.raise(atom->radius[i]);
  }
  const Judgement all = reduce(mine);
  pair->hub.population = {all.bubbles, all.radii, all.gas, all.radius_max};
}
