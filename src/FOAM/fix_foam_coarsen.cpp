/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_coarsen.h"

#include "fix_foam_integrate.h"
#include "foam_input.h"
#include "lammps_compat.h"
#include "pair_durian_foam.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixFoamCoarsen::FixFoamCoarsen(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), rho(0.0), pair(nullptr), reduce(world), law(Foam::LiquidLaw::AREA),
      rmin(0.1), ain_given(0.0), nmin(0), time(0.0), removed_bubbles(0.0), removed_gas(0.0),
      dead(false)
{
  if (narg < 5) error->all(FLERR, "Fix foam/coarsen needs K and kappa as first arguments");
  if (igroup != 0)
    error->all(FLERR, "Fix foam/coarsen needs group all, since gas exchange couples all bubbles");

  const FoamInput input(lmp, error, "Fix foam/coarsen");
  K = input.number("K", arg[3], FoamInput::AT_LEAST, 0.0);
  kappa = input.number("kappa", arg[4], FoamInput::AT_LEAST, 0.0);

  for (int iarg = 5; iarg < narg; iarg += 2) {
    const std::string keyword = arg[iarg];
    if (iarg + 2 > narg)
      error->all(
          FLERR,
          "Fix foam/coarsen: keyword {} needs a value (keywords are rmin, liquid, nmin, ain)",
          keyword);
    const char *value = arg[iarg + 1];
    if (keyword == "rmin")
      rmin = input.number("rmin", value, FoamInput::AT_LEAST, 0.0);
    else if (keyword == "ain")
      ain_given = input.number("ain", value, FoamInput::ABOVE, 0.0);
    else if (keyword == "nmin")
      nmin = input.count("nmin", value);
    else if (keyword == "liquid") {
      if (strcmp(value, "area") == 0)
        law = Foam::LiquidLaw::AREA;
      else if (strcmp(value, "lsw") == 0)
        law = Foam::LiquidLaw::LSW;
      else
        error->all(FLERR, "Fix foam/coarsen: liquid must be area or lsw, not {}", value);
    } else
      error->all(FLERR,
                 "Fix foam/coarsen: unknown keyword {} (allowed are rmin, liquid, nmin, ain)",
                 keyword);
  }

  vector_flag = 1;
  size_vector = 8;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
}

int FixFoamCoarsen::setmask()
{
  return PRE_EXCHANGE;
}

void FixFoamCoarsen::init()
{
  pair = dynamic_cast<PairDurianFoam *>(force->pair_match("durian/foam", 0));
  if (!pair) error->all(FLERR, "Fix foam/coarsen needs pair_style durian/foam");
  if (modify->get_fix_by_style("^foam/coarsen").size() > 1)
    error->all(FLERR, "Fix foam/coarsen: only one fix of this style can be used at a time");
  bool integrated = false;
  for (auto &ifix : modify->get_fix_list())
    if (dynamic_cast<FixFoamIntegrate *>(ifix)) integrated = true;
  if (!integrated)
    error->all(FLERR,
               "Fix foam/coarsen needs a fix that integrates the foam, such as fix foam/abm");
}

unsigned FixFoamCoarsen::wanted() const
{
  unsigned what = 0;
  if (K > 0.0) what |= PairDurianFoam::FILM;
  if (K > 0.0 && kappa > 0.0) what |= PairDurianFoam::AREA;
  return what;
}

/* ----------------------------------------------------------------------
   rates of gas content: Vdot_i = K sum_j A_ij (1/R_j - 1/R_i)
                                + c w_i (1/rho - 1/R_i), see foam_physics.h
------------------------------------------------------------------------- */

template <int D> double FixFoamCoarsen::weight(int i) const
{
  const double R = atom->radius[i];
  return Foam::liquid_weight(law, Foam::free_area(Foam::surface<D>(R), pair->area[i]), R);
}

template <int D> FixFoamCoarsen::Liquid FixFoamCoarsen::liquid_in() const
{
  const double *const radius = atom->radius;
  FoamTotals mine;
  for (int i = 0; i < atom->nlocal; i++) {
    const double R = radius[i];
    if (!(R > 0.0)) continue;
    const double w = weight<D>(i);
    mine.sum[0] += 1.0;
    mine.sum[1] += Foam::surface<D>(R);
    mine.sum[2] += w;
    mine.sum[3] += w / R;
  }
  const FoamTotals all = reduce(mine);
  const double Amean = all.sum[1] / all.sum[0];
  const double ain = ain_given > 0.0 ? ain_given : pair->ain;
  return {Foam::liquid_coefficient(law, kappa, K, pair->rin, ain, Amean),
          Foam::inverse_critical_radius(all.sum[2], all.sum[3])};
}

template <int D> FixFoamCoarsen::Split FixFoamCoarsen::exchange_in(int i, const Liquid &l) const
{
  const double R = atom->radius[i];
  if (!(R > 0.0)) return {0.0, 0.0};
  Split split{K * pair->film[i], 0.0};
  if (l.coefficient > 0.0)
    split.liquid = Foam::liquid_exchange(l.coefficient, weight<D>(i), l.inverse_rho, R);
  return split;
}

template <int D> void FixFoamCoarsen::rates_in(double *qdot, bool of_radius)
{
  const int nlocal = atom->nlocal;
  const double *const radius = atom->radius;
  const Liquid l = kappa > 0.0 ? liquid_in<D>() : Liquid();
  rho = l.inverse_rho > 0.0 ? 1.0 / l.inverse_rho : 0.0;
  for (int i = 0; i < nlocal; i++) {
    const Split split = exchange_in<D>(i, l);
    const double Vdot = split.film + split.liquid;
    qdot[i] = Foam::power_rate<D>(Vdot);
    if (of_radius) qdot[i] = radius[i] > 0.0 ? Foam::radius_rate<D>(Vdot, radius[i]) : 0.0;
  }
}

// the same for either dimension

FixFoamCoarsen::Liquid FixFoamCoarsen::liquid() const
{
  return domain->dimension == 2 ? liquid_in<2>() : liquid_in<3>();
}

FixFoamCoarsen::Split FixFoamCoarsen::exchange(int i, const Liquid &l) const
{
  return domain->dimension == 2 ? exchange_in<2>(i, l) : exchange_in<3>(i, l);
}

void FixFoamCoarsen::rates(double *qdot, bool of_radius)
{
  if (K == 0.0)
    for (int i = 0; i < atom->nlocal; i++) qdot[i] = 0.0;
  else if (domain->dimension == 2)
    rates_in<2>(qdot, of_radius);
  else
    rates_in<3>(qdot, of_radius);
}

/* ---------------------------------------------------------------------- */

double FixFoamCoarsen::smallest_radius() const
{
  return rmin * pair->rin;
}

void FixFoamCoarsen::accepted(double h, double removed, double gas_removed)
{
  time += h;
  removed_bubbles += removed;
  removed_gas += gas_removed;
  if (removed > 0.0) dead = true;
}

std::string FixFoamCoarsen::end_reached() const
{
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
}

void FixFoamCoarsen::take_out_dead()
{
  if (!dead) return;

  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  int i = 0;
  while (i < atom->nlocal) {
    if (atom->radius[i] > 0.0) {
      i++;
    } else {
      atom->avec->copy(atom->nlocal - 1, i, 1);
      atom->nlocal--;
    }
  }
  atom->nghost = 0;
  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  dead = false;
}

/* ---------------------------------------------------------------------- */

double FixFoamCoarsen::compute_vector(int n)
{
  pair = dynamic_cast<PairDurianFoam *>(force->pair_match("durian/foam", 0));
  if (!pair) return 0.0;    // replaced since the last run
  double box = domain->xprd * domain->yprd;
  if (domain->dimension == 3) box *= domain->zprd;
  const double N = population.bubbles;
  switch (n) {
    case 0:
      return Foam::scaled_time(K, time, pair->rin);
    case 1:
      return N;
    case 2:
      return N > 0.0 ? population.radius_sum / (N * pair->rin) : 0.0;
    case 3:
      return population.radius_max / pair->rin;
    case 4:
      return Foam::gas_fraction(population.gas, box);
    case 5:
      return rho;
    case 6:
      return removed_bubbles;
    default:
      return removed_gas;
  }
}

void FixFoamCoarsen::write_restart(FILE *fp)
{
  const double values[4] = {time, removed_bubbles, removed_gas, rho};
  if (comm->me == 0) {
    const int size = sizeof(values);
    fwrite(&size, sizeof(int), 1, fp);
    fwrite(values, sizeof(double), 4, fp);
  }
}

void FixFoamCoarsen::restart(char *buf)
{
  const auto *values = (const double *) buf;
  time = values[0];
  removed_bubbles = values[1];
  removed_gas = values[2];
  rho = values[3];
}
