/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_sparger.h"

#include "fix_bubble_flow.h"
#include "foam_input.h"
#include "foam_start.h"
#include "liquid_births.h"
#include "pair_liquid_sph.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID bubble/sparger X Y Z R0 Q radius A | normal MEAN SD MIN keyword value ...
------------------------------------------------------------------------- */

FixBubbleSparger::FixBubbleSparger(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix bubble/sparger", narg - 3, arg + 3);
  for (int k = 0; k < 3; k++) place[k] = input.argument(std::string(1, "XYZ"[k])).number();
  disc = input.argument("R0").number(FoamInput::AT_LEAST, 0.0);
  rate = input.argument("Q").number(FoamInput::AT_LEAST, 0.0);
  if (input.argument("radius or normal").one_of({"radius", "normal"}) == 0) {
    mean = input.argument("A of radius").number(FoamInput::ABOVE, 0.0);
  } else {
    mean = input.argument("MEAN of normal").number(FoamInput::ABOVE, 0.0);
    sd = input.argument("SD of normal").number(FoamInput::AT_LEAST, 0.0);
    least = input.argument("MIN of normal").number(FoamInput::ABOVE, 0.0);
    if (least >= mean)
      error->all(FLERR, "Fix bubble/sparger: MIN of normal must be below its mean {}, not {}", mean,
                 least);
  }
  input.keywords({{"seed",
                   [&](const Value &v) {
                     seed = v.count();
                   }},
                  {"type", [&](const Value &v) {
                     type = v.integer(1, atom->ntypes);
                   }}});
  if (type > atom->ntypes)
    error->all(FLERR,
               "Fix bubble/sparger: there is no type {} for bubbles: keyword type says which",
               type);
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = 1;
  vector_flag = 1;
  size_vector = 2;
  extvector = 0;
  global_freq = 1;
  restart_global = 1;
}

int FixBubbleSparger::setmask()
{
  return PRE_EXCHANGE | END_OF_STEP;
}

void FixBubbleSparger::init()
{
  gas = FixBubbleFlow::of(lmp);
  if (!gas) error->all(FLERR, "Fix bubble/sparger needs fix bubble/flow");
  const PairLiquidSPH *const liquid = PairLiquidSPH::of(lmp);
  if (liquid) most = liquid->dr;
  if (liquid && mean > liquid->dr)
    error->all(
        FLERR,
        "Fix bubble/sparger: bubbles of radius {} are larger than the spacing of the liquid, "
        "{}",
        mean, liquid->dr);
  for (int k = 0; k < 3; k++) {
    const double around = k < 2 ? disc : 0.0;
    if (!domain->periodicity[k] &&
        (place[k] - around < domain->boxlo[k] || place[k] + around > domain->boxhi[k]))
      error->all(FLERR, "Fix bubble/sparger: it reaches out of the box along {}", "xyz"[k]);
  }
}

void FixBubbleSparger::setup(int)    // some may be owed since the last run
{
  next_reneighbor = update->ntimestep + 1;
}

double FixBubbleSparger::radius(double number) const
{
  if (!(sd > 0.0)) return mean;
  const Foam::Draws draws(seed, static_cast<std::uint64_t>(number));
  for (unsigned n = 0; n < 2000; n += 2) {    // those out of bounds are drawn again
    const double a = mean + sd * draws.normal(n + 4);
    if (a >= least && a <= most) return a;
  }
  return mean;
}

// gas of this step: as many bubbles as it makes

void FixBubbleSparger::end_of_step()
{
  owed += rate * update->dt;
  if (owed >= Liquid::bubble_volume(radius(born))) next_reneighbor = update->ntimestep + 1;
}

void FixBubbleSparger::pre_exchange()
{
  std::vector<Newborn> bubbles;
  for (double a; owed >= Liquid::bubble_volume(a = radius(born)); born += 1.0) {
    const Foam::Draws draws(seed, static_cast<std::uint64_t>(born));
    const double r = disc * std::sqrt(draws.uniform(0)), angle = 2.0 * Foam::PI * draws.uniform(1);
    owed -= Liquid::bubble_volume(a);
    given += Liquid::bubble_volume(a);
    if (comm->me == 0)
      bubbles.push_back({0.0,
                         born,
                         static_cast<double>(type),
                         {place[0] + r * std::cos(angle), place[1] + r * std::sin(angle), place[2]},
                         {0.0, 0.0, 0.0},
                         a});
  }
  LiquidBirths(lmp, gas->groupbit | groupbit, gas->density()).create(bubbles);
}

double FixBubbleSparger::compute_vector(int n)
{
  return n == 0 ? born : given;
}

void *FixBubbleSparger::extract(const char *name, int &dim)
{
  dim = 0;
  if (std::strcmp(name, "type of bubbles") != 0) return nullptr;
  return &type;
}

void FixBubbleSparger::write_restart(FILE *fp)
{
  if (comm->me != 0) return;
  const double values[] = {born, owed, given};
  const int size = sizeof(values);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(values, size, 1, fp);
}

void FixBubbleSparger::restart(char *buf)
{
  const auto *values = (const double *) buf;
  born = values[0];
  owed = values[1];
  given = values[2];
}
