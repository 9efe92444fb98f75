/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "relax_foam.h"

#include "foam_input.h"
#include "foam_physics.h"
#include "pair_foam.h"

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "input.h"
#include "modify.h"
#include "timer.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   relax_foam keyword value ...
------------------------------------------------------------------------- */

void RelaxFoam::command(int narg, char **arg)
{
  settings(narg, arg);
  check();
  if (limit < 0.0) limit = 1.0e-3 * pair->stiffest() / pair->mu0;

  if (phi > 0.0) {
    relax();
    const double now = gas_fraction();
    scale(std::pow(now / phi, 1.0 / domain->dimension));
    if (comm->me == 0)
      utils::logmesg(lmp, "Relax_foam: box scaled from gas fraction {:.6g} to {:.6g}\n", now, phi);
    relax();
  }
  if (pressure > 0.0)
    reach_pressure();
  else
    relax_until_rest();
}

void RelaxFoam::check()
{
  if (!domain->box_exist || atom->natoms == 0)
    error->all(FLERR, "Relax_foam: there is no bubble yet: see create_foam");
  pair = PairFoam::of(lmp);
  if (!pair) error->all(FLERR, "Relax_foam needs one pair_style durian/foam");
  bool integrated = false;
  for (auto &ifix : modify->get_fix_list()) {
    if (FoamHub::integrates(ifix)) integrated = true;
    if (utils::strmatch(ifix->style, "^foam/coarsen"))
      error->all(FLERR,
                 "Relax_foam keeps the radii: give it before fix foam/coarsen, or unfix that");
    if (!utils::strmatch(ifix->style, "^foam/wall")) continue;
    if (!ifix->thermo_energy || (pressure > 0.0 && !ifix->thermo_virial))
      error->all(FLERR,
                 "Relax_foam: energy and pressure must be those of walls, too: fix_modify {} "
                 "energy yes virial yes",
                 ifix->id);
  }
  if (minimize.empty() && !integrated)
    error->all(FLERR, "Relax_foam with method run needs fix foam/rkc or foam/abm");
  if (phi == 0.0 && pressure == 0.0) return;
  if (domain->triclinic)
    error->all(
        FLERR,
        "Relax_foam scales orthogonal boxes only: with a tilt, use neither phi nor pressure");
  for (int k = 0; k < domain->dimension; k++)
    if (domain->boundary[k][0] > 1 || domain->boundary[k][1] > 1)
      error->all(FLERR,
                 "Relax_foam: boundaries of a box that is scaled must be p or f, not s or m");
}

void RelaxFoam::settings(int narg, char **arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Relax_foam", narg, arg);
  input.keywords({{"phi",
                   [&](const Value &v) {
                     phi = v.between(0.0, 2.0);
                   }},
                  {"pressure",
                   [&](const Value &v) {
                     pressure = v.number(FoamInput::ABOVE, 0.0);
                   }},
                  {"within",
                   [&](const Value &v) {
                     tolerance = v.between(0.0, 1.0);
                   }},
                  {"steps",
                   [&](const Value &v) {
                     steps = v.integer(1, MAXSMALLINT);
                   }},
                  {"rounds",
                   [&](const Value &v) {
                     rounds = v.integer(1, MAXSMALLINT);
                   }},
                  {"limit",
                   [&](const Value &v) {
                     limit = v.number(FoamInput::AT_LEAST, 0.0);
                   }},
                  {"method", [&](const Value &v) {
                     minimize.clear();
                     if (v.one_of({"run", "minimize"}) == 0) return;
                     auto part = [&](const char *what) {
                       return input.argument(std::string("method minimize ") + what);
                     };
                     etol = part("etol").number(FoamInput::AT_LEAST, 0.0);
                     ftol = part("ftol").number(FoamInput::AT_LEAST, 0.0);
                     const int maxiter = part("maxiter").integer(1, MAXSMALLINT);
                     const int maxeval = part("maxeval").integer(1, MAXSMALLINT);
                     minimize = fmt::format("minimize {:.17g} {:.17g} {} {}", etol, ftol, maxiter,
                                            maxeval);
                   }}});
}

// LAMMPS' minimize does not say how it ended, but forces do

void RelaxFoam::relax()
{
  if (minimize.empty()) {
    input->one(fmt::format("run {} post no", steps));
    update->update_time();
    if (timer->is_timeout())
      error->all(FLERR,
                 "Relax_foam: the run was stopped by timer timeout before the foam was at rest");
    return;
  }
  input->one(minimize);
  double mine = 0.0, largest = 0.0;    // force on a bubble, squared
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const f = atom->f[i];
    mine = std::max(mine, f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  }
  MPI_Allreduce(&mine, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  largest = std::sqrt(largest);
  if (etol > 0.0 || !(largest > 2.0 * ftol)) return;    // whatever min_modify norm it was
  const std::string told = fmt::format(
      "Relax_foam: minimize ended with forces of up to {:.3g}, above its ftol of {:.3g}: "
      "raise maxiter and maxeval, or choose another min_style",
      largest, ftol);
  if (pressure > 0.0) error->all(FLERR, told);
  if (comm->me == 0) error->warning(FLERR, told);
}

// Until the energy changes by less than limit of it in a unit of time, 2 |E2 - E1| / ((E1 + E2) (t2 - t1)); loose
// bubbles lose all of it, and then rest at some 1e-12 of what was there.

double RelaxFoam::relax_until_rest()
{
  const double start = update->atime;
  relax();
  if (!minimize.empty()) return 0.0;
  double e1 = energy(), t1 = update->atime;
  energy_most = std::max(energy_most, e1);
  for (int round = 1; round <= rounds; round++) {
    relax();
    const double e2 = energy(), t2 = update->atime;
    const double floor = 1.0e-12 * energy_most;
    const double change =
        e1 + e2 > floor ? 2.0 * std::abs(e2 - e1) / ((e1 + e2 + floor) * (t2 - t1)) : 0.0;
    if (comm->me == 0)
      utils::logmesg(
          lmp,
          "Relax_foam: round {}, energy {:.8g}, of it {:.3g} in a unit of time, limit {:.3g}\n",
          round, e2, change, limit);
    if (change < limit) return t2 - start;
    e1 = e2;
    t1 = t2;
  }
  if (comm->me == 0)
    error->warning(FLERR, "Relax_foam: the energy does not rest after {} rounds of {} steps",
                   rounds, steps);
  return update->atime - start;
}

void RelaxFoam::relax_for(double time)
{
  const double end = update->atime + time;
  for (int round = 0; round < rounds && update->atime < end; round++) relax();
}

// ln phi by the secant of the last two pressures, no more than 5 % at once. A foam without pressure is compressed
// by 2 % of its gas fraction until it has one.  The pressure goes on to fall while the foam relaxes: it is the one that
// is wanted if it still is so after twice the time.

void RelaxFoam::reach_pressure()
{
  constexpr double MOST = 0.05, COMPRESS = 0.02, FIRST = 0.002;
  double step = 0.0, before = 0.0;
  auto found = [&](double now) {
    const double fraction = gas_fraction();
    if (comm->me == 0)
      utils::logmesg(lmp, "Relax_foam: pressure {:.8g} at gas fraction {:.8g}, wanted {:.8g}\n",
                     now, fraction, pressure);
    return std::abs(pressure - now) <= tolerance * pressure;
  };
  for (int n = 0; n <= rounds; n++) {
    const double spent = relax_until_rest();
    double now = pressure_now();
    if (found(now)) {
      relax_for(spent);
      now = pressure_now();
      if (found(now)) return;
    }
    const double off = pressure - now;
    const double slope = step != 0.0 ? (now - before) / step : 0.0;    // dp / d ln phi
    if (now <= 1.0e-3 * pressure)
      step = COMPRESS;
    else if (slope > 0.0)
      step = std::clamp(off / slope, -MOST, MOST);
    else
      step = off > 0.0 ? FIRST : -FIRST;
    before = now;
    scale(std::exp(-step / domain->dimension));
  }
  error->all(
      FLERR,
      "Relax_foam: no pressure of {} within {} of it after {} changes of the box; see keywords "
      "within, rounds, limit",
      pressure, tolerance, rounds);
}

void RelaxFoam::scale(double factor)
{
  std::string command = "change_box all";
  for (int k = 0; k < domain->dimension; k++)
    command += fmt::format(" {} scale {:.17g}", "xyz"[k], factor);
  input->one(command + " remap");
}

// known at the last step of a run or a minimization, where thermo output has it

double RelaxFoam::energy()
{
  Compute *pe = modify->get_compute_by_id("thermo_pe");
  return pe->invoked_scalar == update->ntimestep ? pe->scalar : pe->compute_scalar();
}

double RelaxFoam::pressure_now()
{
  Compute *press = modify->add_compute("relax_foam_press all pressure NULL virial");
  press->addstep(update->ntimestep);
  input->one("run 0 post no");
  const double p = press->compute_scalar();
  modify->delete_compute("relax_foam_press");
  return p;
}

double RelaxFoam::gas_fraction()
{
  const int dim = domain->dimension;
  pair->hub.find_group();
  double mine = 0.0, all = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (pair->hub.groupbit == Foam::GROUP_ALL || (atom->mask[i] & pair->hub.groupbit))
      mine += std::pow(atom->radius[i], dim);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  double volume = 1.0;
  for (int k = 0; k < dim; k++) volume *= domain->prd[k];
  return all * Foam::with_dimension(dim, []<int D>() { return Foam::CONTENT<D>; }) / volume;
}
