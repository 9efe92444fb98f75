/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_flow.h"

#include "fix_liquid_flow.h"
#include "foam_host.h"
#include "foam_input.h"
#include "liquid_births.h"

#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID bubble/flow WE BETA keyword value ...
------------------------------------------------------------------------- */

FixBubbleFlow::FixBubbleFlow(LAMMPS *lmp, int narg, char **arg) : FixFoamTravelling(lmp, narg, arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix bubble/flow", narg - 3, arg + 3);
  set.We = input.argument("WE").number(FoamInput::ABOVE, 0.0);
  set.beta = input.argument("BETA").number(FoamInput::ABOVE, 1.0);
  auto yes_or_no = [](const Value &v) {
    return v.one_of({"no", "yes"}) == 1;
  };
  input.keywords({{"drag",
                   [&](const Value &v) {
                     set.drag = yes_or_no(v);
                   }},
                  {"lift",
                   [&](const Value &v) {
                     set.lift = yes_or_no(v);
                   }},
                  {"virtual",
                   [&](const Value &v) {
                     set.virtual_mass = yes_or_no(v);
                   }},
                  {"substep",
                   [&](const Value &v) {
                     set.substeps = yes_or_no(v);
                   }},
                  {"surface",
                   [&](const Value &v) {
                     set.surface = yes_or_no(v);
                   }},
                  {"viscosity",
                   [&](const Value &v) {
                     set.viscosity = static_cast<Liquid::BubbleSetting::Viscosity>(
                         v.one_of({"none", "sato", "published"}));
                   }},
                  {"persist",
                   [&](const Value &v) {
                     set.lasts = v.number(FoamInput::AT_LEAST, 0.0);
                   }},
                  {"langevin",
                   [&](const Value &v) {
                     turbulence_seed = v.count();
                     set.turbulence = true;
                   }},
                  {"entrain",
                   [&](const Value &v) {
                     entrain_seed = v.count();
                     entrains = true;
                   }},
                  {"type",
                   [&](const Value &v) {
                     born_type = v.integer(1, atom->ntypes);
                   }},
                  {"breakup", [&](const Value &v) {
                     breakup_seed = v.count();
                     set.breaks = true;
                   }}});
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = 1;
  vector_flag = 1;
  size_vector = 6;
  restart_global = 1;
  maxexchange = Liquid::BUBBLE_STATES + 1;
  extvector = 0;
  global_freq = 1;
  state.use(atom->nmax);
  if (entrains) dissipates.use(atom->nmax);
  add_callbacks();
}

FixBubbleFlow *FixBubbleFlow::of(LAMMPS *lmp)
{
  for (auto &fix : lmp->modify->get_fix_list())
    if (auto *its = dynamic_cast<FixBubbleFlow *>(fix)) return its;
  return nullptr;
}

int FixBubbleFlow::setmask()
{
  return INITIAL_INTEGRATE | PRE_EXCHANGE | END_OF_STEP;
}

void FixBubbleFlow::init()
{
  if (of(lmp) != this) error->all(FLERR, "Fix bubble/flow: there can be one only");
  const FixLiquidFlow *const liquid = FixLiquidFlow::of(lmp);
  if (!liquid) error->all(FLERR, "Fix bubble/flow needs fix liquid/flow");
  set.Fr = liquid->froude();
  if (entrains && born_type > atom->ntypes)
    error->all(FLERR,
               "Fix bubble/flow: there is no type {} for bubbles that are entrained: keyword "
               "type says which",
               born_type);
  if (const PairLiquidSPH *pair = PairLiquidSPH::of(lmp)) check_sizes(pair->dr);
}

// The model is that of bubbles smaller than the spacing

void FixBubbleFlow::check_sizes(double dr) const
{
  for (int i = 0; i < atom->nlocal; i++)
    if ((atom->mask[i] & groupbit) && !(atom->radius[i] > 0.0 && atom->radius[i] <= dr))
      error->one(
          FLERR,
          "Fix bubble/flow: bubble {} has radius {}: it must be > 0, and at most the spacing "
          "of the liquid, {}",
          atom->tag[i], atom->radius[i], dr);
}

void FixBubbleFlow::setup(int)    // some may have been due since the last run
{
  next_reneighbor = update->ntimestep + 1;
}

void FixBubbleFlow::initial_integrate(int)
{
  FixLiquidFlow::of(lmp)->begin_run();
  advance(update->dt);
}

void FixBubbleFlow::advance(double dt)
{
  FoamHost space(lmp, groupbit);
  space.for_each(atom->nlocal, Liquid::Advance<FoamHost::Bubbles>{
                                   space.bubbles(), FixLiquidFlow::of(lmp)->walls, dt});
}

void FixBubbleFlow::go_back()
{
  FoamHost space(lmp, groupbit);
  go_back_in(space);
}

/* ----------------------------------------------------------------------
   births and deaths
------------------------------------------------------------------------- */

void FixBubbleFlow::end_of_step()
{
  double mine = events.gone + events.broken, all;
  if (entrains) mine += FixLiquidFlow::of(lmp)->entraining();
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_MAX, world);
  if (all > 0.0) next_reneighbor = update->ntimestep + 1;
}

void FixBubbleFlow::pre_exchange()
{
  if (next_reneighbor != update->ntimestep) return;
  if (set.breaks) break_up();
  if (entrains) entrain();
  remove_burst();
}

void FixBubbleFlow::remove_burst()
{
  std::vector<bool> gone(atom->nlocal, false);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !(state[Liquid::GONE][i] > 0.0)) continue;
    gone[i] = true;
    burst += 1.0;
    burst_volume += Liquid::bubble_volume(atom->radius[i]);
  }
  LiquidBirths(lmp, groupbit, density()).remove(gone);
}

// Bubbles that particles on the surface entrain, by what the last step has dissipated there: at most MOST from a
// particle, and until so many have been refused.  Sizes are uniform from the smallest to the spacing.

void FixBubbleFlow::entrain()
{
  constexpr int MOST = 10, REFUSED = 5;
  FixLiquidFlow &liquid = *FixLiquidFlow::of(lmp);
  std::vector<Newborn> bubbles;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const x = atom->x[i], *const v = atom->v[i];
    if (!(atom->mask[i] & liquid.groupbit) || !(dissipates[0][i] > 0.0)) continue;
    const Liquid::Setting &its = liquid.setting();
    const double h = liquid.state[FixLiquidFlow::SMOOTHING][i];
    double energy = Liquid::energy_for_surfaces(set.beta, dissipates[0][i], its.volume_of_liquid(),
                                                liquid.last_step());
    double room =
        Liquid::room_for_gas(Liquid::fraction_of_length(its.h0, h), Liquid::Kernel(h)(0.0));
    dissipates[0][i] = 0.0;
    const Foam::Draws draws(of_this_step(entrain_seed), atom->tag[i]);
    const double least = Liquid::smallest_entrained(set.We);
    int accepted = 0, refused = 0;
    for (unsigned n = 0; energy > 0.0 && room > 0.0 && accepted < MOST && refused <= REFUSED;
         n += 5) {
      const double a = least + (its.dr - least) * draws.uniform(n);
      const double needed = Liquid::surface_energy(a, set.We), V = Liquid::bubble_volume(a);
      if (std::min(energy / needed, room / V) < draws.uniform(n + 1)) {
        refused++;
        continue;
      }
      Newborn child{static_cast<double>(atom->tag[i]),
                    static_cast<double>(accepted++),
                    static_cast<double>(born_type),
                    {},
                    {},
                    a};
      for (int k = 0; k < 3; k++) {
        child.x[k] = x[k] + (draws.uniform(n + 2 + k) - 0.5) * its.dr;
        child.v[k] = v[k];
        liquid.walls.keep(k, child.x[k], child.v[k]);
      }
      bubbles.push_back(child);
      energy -= needed;
      room -= V;
      born += 1.0;
    }
  }
  LiquidBirths(lmp, groupbit, density()).create(bubbles);
}

// A bubble that is too long becomes two, the larger of which it remains, side by side with its centre of mass where it was.
// Random numbers are those of its ID and of the step.

void FixBubbleFlow::break_up()
{
  std::vector<Newborn> children;
  for (int i = 0; i < atom->nlocal; i++) {
    const double a = atom->radius[i], age = state[Liquid::AGE][i];
    if (!(atom->mask[i] & groupbit) || state[Liquid::GONE][i] > 0.0) continue;
    if (!(state[Liquid::DEFORMED][i] > 2.0 * a)) continue;
    state[Liquid::DEFORMED][i] = 0.0;
    const double eps = age > 0.0 ? state[Liquid::STRESSED][i] / age : 0.0;
    const Foam::Draws draws(of_this_step(breakup_seed), atom->tag[i]);
    const double V = Liquid::smaller_part(Liquid::least_size(set.We, eps, a), draws);
    if (!(V > 0.0)) continue;    // too small to break
    double n[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
      n[k] = draws.normal(2 * k);
      square += n[k] * n[k];
    }
    const double small = a * std::cbrt(V), large = a * std::cbrt(1.0 - V);
    const double apart = (small + large) / std::sqrt(square);
    Newborn child{
        static_cast<double>(atom->tag[i]), 0.0, static_cast<double>(atom->type[i]), {}, {}, small};
    const Liquid::Walls &walls = FixLiquidFlow::of(lmp)->walls;
    for (int k = 0; k < 3; k++) {
      child.x[k] = atom->x[i][k] + (1.0 - V) * apart * n[k];
      child.v[k] = atom->v[i][k];
      atom->x[i][k] -= V * apart * n[k];
      walls.keep(k, child.x[k], child.v[k]);
      walls.keep(k, atom->x[i][k], atom->v[i][k]);
    }
    children.push_back(child);
    atom->radius[i] = large;
    atom->rmass[i] *= 1.0 - V;
    state[Liquid::AGE][i] = state[Liquid::STRESSED][i] = 0.0;
    broken += 1.0;
  }
  LiquidBirths(lmp, groupbit, density()).create(children);
}

/* ----------------------------------------------------------------------
   output and restart
------------------------------------------------------------------------- */

// number and volume of the bubbles; how many have been born here, have broken, have burst, and the volume of the latter

double FixBubbleFlow::compute_vector(int n)
{
  double mine[] = {0.0, 0.0, born, broken, burst, burst_volume}, all;
  if (n < 2)
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit)
        mine[n] += n == 0 ? 1.0 : Liquid::bubble_volume(atom->radius[i]);
  MPI_Allreduce(&mine[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

void *FixBubbleFlow::extract(const char *name, int &dim)
{
  dim = 0;
  if (std::strcmp(name, "type of bubbles") != 0) return nullptr;
  return entrains ? &born_type : nullptr;
}

void FixBubbleFlow::write_restart(FILE *fp)
{
  const double mine[] = {born, broken, burst, burst_volume};
  double all[4];
  MPI_Reduce(mine, all, 4, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me != 0) return;
  const int size = sizeof(all);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(all, size, 1, fp);
}

void FixBubbleFlow::restart(char *buf)
{
  if (comm->me != 0) return;
  const auto *values = (const double *) buf;
  born = values[0];
  broken = values[1];
  burst = values[2];
  burst_volume = values[3];
}
