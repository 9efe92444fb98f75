/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_coarsen.h"

#include "foam_input.h"
#include "lammps_compat.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixFoamCoarsen::FixFoamCoarsen(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), pair(nullptr), law(Foam::LiquidLaw::AREA), rmin(0.1), ain_given(0.0),
      nmin(0), rho(0.0), dead(false)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix foam/coarsen", narg - 3, arg + 3);
  K = input.argument("K").number(FoamInput::AT_LEAST, 0.0);
  kappa = input.argument("kappa").number(FoamInput::AT_LEAST, 0.0);
  FoamInput::Keywords all = keywords();
  all.push_back({"ain", [&](const Value &v) {
                   ain_given = v.number(FoamInput::ABOVE, 0.0);
                 }});
  input.keywords(all);

  vector_flag = 1;
  size_vector = 10;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
}

FoamInput::Keywords FixFoamCoarsen::keywords()
{
  using Value = FoamInput::Value;
  return {{"rmin",
           [&](const Value &v) {
             rmin = v.number(FoamInput::AT_LEAST, 0.0);
           }},
          {"film",
           [&](const Value &v) {
             through_films = v.one_of({"no", "yes"});
           }},
          {"liquid",
           [&](const Value &v) {
             law = v.one_of({"area", "lsw"}) == 1 ? Foam::LiquidLaw::LSW : Foam::LiquidLaw::AREA;
           }},
          {"nmin", [&](const Value &v) {
             nmin = v.count();
           }}};
}

// between two runs: LAMMPS hands over all words that are left, and takes one keyword with its value

int FixFoamCoarsen::modify_param(int narg, char **arg)
{
  using Value = FoamInput::Value;
  FoamInput::Keywords all = keywords();
  all.push_back({"K", [&](const Value &v) {
                   K = v.number(FoamInput::AT_LEAST, 0.0);
                 }});
  all.push_back({"kappa", [&](const Value &v) {
                   kappa = v.number(FoamInput::AT_LEAST, 0.0);
                 }});
  all.push_back({"tau", [&](const Value &v) {
                   const double tau = v.number(FoamInput::AT_LEAST, 0.0);
                   if (!find_pair())
                     error->all(FLERR,
                                "Fix foam/coarsen: fix_modify tau needs pair_style durian/foam");
                   pair->hub.record.tau = tau;
                 }});
  FoamInput input(error, "Fix foam/coarsen: fix_modify", MIN(narg, 2), arg);
  input.keywords(all);
  if (find_pair()) tell(pair->hub);    // at once: the next run may have no set-up
  changed = true;
  return 2;
}

// what it has to gather

void FixFoamCoarsen::tell(FoamHub &hub) const
{
  hub.gas_wanted = 0;
  if (K > 0.0 && through_films) hub.gas_wanted |= Foam::FILM;
  if (K > 0.0 && kappa > 0.0) hub.gas_wanted |= Foam::AREA;
  hub.liquid_law = law;
}

// it may have been replaced since the last run

bool FixFoamCoarsen::find_pair()
{
  pair = PairFoam::of(lmp);
  return pair;
}

int FixFoamCoarsen::setmask()
{
  return PRE_EXCHANGE;
}

void FixFoamCoarsen::init()
{
  if (!find_pair()) error->all(FLERR, "Fix foam/coarsen needs one pair_style durian/foam");
  if (modify->get_fix_by_style("^foam/coarsen").size() > 1)
    error->all(FLERR, "Fix foam/coarsen: only one fix of this style can be used at a time");
  bool integrated = false;
  for (auto &ifix : modify->get_fix_list())
    if (FoamHub::integrates(ifix)) integrated = true;
  if (!integrated)
    error->all(FLERR,
               "Fix foam/coarsen needs a fix that integrates the foam, fix foam/rkc or foam/abm");
}

/* ---------------------------------------------------------------------- */

double FixFoamCoarsen::smallest_radius() const
{
  return rmin * pair->hub.record.rin;
}

void FixFoamCoarsen::accepted(double h, double removed, double gas_removed)
{
  pair->hub.record.tau += Foam::scaled_time(K, h, pair->hub.record.rin);
  pair->hub.record.removed_bubbles += removed;
  pair->hub.record.removed_gas += gas_removed;
  if (removed > 0.0) dead = true;
}

std::string FixFoamCoarsen::end_reached() const
{
  const FoamHub::Population &population = pair->hub.population;
  if (population.bubbles <= nmin)
    return fmt::format("{:.0f} bubbles are left, nmin is {}", population.bubbles, nmin);
  double side = MIN(domain->xprd, domain->yprd);
  if (domain->dimension == 3) side = MIN(side, domain->zprd);

  // ghosts of comm_style tiled reach no further than the box, and need 2 R_max + skin; in a step a
  // bubble grows by half a skin at most

  if (comm->style == Comm::TILED) side -= 2.0 * neighbor->skin;
  if (2.0 * population.radius_max >= side)
    return fmt::format(
        "the largest bubble, of diameter {:.8}, spans the box, whose shortest side is {:.8}",
        2.0 * population.radius_max, side);
  return {};
}

/* ----------------------------------------------------------------------
   A removed bubble stays as a dead one of radius 0, without force or exchange, so that a
   removal does not force a list build; the next build, whoever asks for it, takes it out.
   A particle that is no bubble is not dead, whatever its radius.
------------------------------------------------------------------------- */

void FixFoamCoarsen::setup_pre_exchange()
{
  take_out_dead();
}

void FixFoamCoarsen::pre_exchange()
{
  take_out_dead();
}

// a run that ends by a time limit may leave some behind

void FixFoamCoarsen::post_run()
{
  take_out_dead();
  critical_radius();    // if it is on a device, it is there no longer than the integrator
}

void FixFoamCoarsen::take_out_dead()
{
  if (!dead) return;

  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  int i = 0;
  while (i < atom->nlocal) {
    if (atom->radius[i] > 0.0 || !(atom->mask[i] & groupbit)) {
      i++;
    } else {
      atom->avec->copy(atom->nlocal - 1, i, 1);
      atom->nlocal--;
    }
  }
  count_particles();
}

void FixFoamCoarsen::count_particles()
{
  atom->nghost = 0;
  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  dead = false;
}

/* ---------------------------------------------------------------------- */

double FixFoamCoarsen::compute_vector(int n)
{
  if (!find_pair() || !(pair->hub.record.rin > 0.0))
    return 0.0;    // replaced since the last run, or there was none
  double box = domain->xprd * domain->yprd;
  if (domain->dimension == 3) box *= domain->zprd;
  const FoamHub::Population &population = pair->hub.population;
  const double N = population.bubbles;
  switch (n) {
    case 0:
      return pair->hub.record.tau;
    case 1:
      return N;
    case 2:
      return N > 0.0 ? population.radius_sum / (N * pair->hub.record.rin) : 0.0;
    case 3:
      return population.radius_max / pair->hub.record.rin;
    case 4:
      return Foam::gas_fraction(population.gas, box);
    case 5:
      return critical_radius();
    case 6:
      return pair->hub.record.removed_bubbles;
    case 7:
      return pair->hub.record.removed_gas;
    case 8:
      return pair->hub.record.rin;
    default:
      return mean_surface();
  }
}

void FixFoamCoarsen::write_restart(FILE *fp)
{
  const double value = critical_radius();    // the rest is in the pair style's record
  if (comm->me == 0) {
    const int size = sizeof(value);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(&value, size, 1, fp);
  }
}

void FixFoamCoarsen::restart(char *buf)
{
  keep_critical_radius(*(const double *) buf);
}
