/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

// FixFoamIntegrate: its command, and who else is in the input

#include "fix_foam_integrate.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID STYLE tolerance keyword value ...
------------------------------------------------------------------------- */

FixFoamIntegrate::FixFoamIntegrate(LAMMPS *lmp, int narg, char **arg)
    : FixFoamTravelling(lmp, narg, arg), reduce(world), list(lmp), out(lmp), dim(domain->dimension)
{
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  nevery = 1;

  vector_flag = 1;
  size_vector = 7;
  global_freq = 1;
  extvector = 0;

  restart_global = 1;
  maxexchange = capacity(travelling());
  columns.use(atom->nmax);
}

void FixFoamIntegrate::settings(int narg, char **arg, double tolerance,
                                const FoamInput::Keywords &own)
{
  using Value = FoamInput::Value;
  FoamInput input(error, fmt::format("Fix {}", style), narg - 3, arg + 3);
  const Value given = input.argument("tolerance");
  driver.control.tolerance = given.is("auto") ? tolerance : given.number(FoamInput::ABOVE, 0.0);

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
         driver.control.safety = v.between(0.0, 1.0);
       }},
      {"growth",
       [&](const Value &v) {
         driver.control.growth = v.number(FoamInput::ABOVE, 1.0);
         driver.control.growth_at_start = 0.0;
       }},
      {"skin",
       [&](const Value &v) {
         list.follows = v.one_of({"fixed", "auto"}) == 1;
       }},
      {"path",
       [&](const Value &v) {
         paths = v.one_of({"no", "yes"}) == 1;
       }},
      {"drift", [&](const Value &v) {
         drift_removed = v.one_of({"keep", "remove"}) == 1;
         drift_given = true;
       }}};
  all.insert(all.end(), own.begin(), own.end());
  input.keywords(all);

  if (!paths) return;
  peratom_flag = 1;
  size_peratom_cols = 0;
  peratom_freq = 1;
  path.use(atom->nmax);
}

int FixFoamIntegrate::setmask()
{
  return INITIAL_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR | FINAL_INTEGRATE |
         END_OF_STEP;
}

void FixFoamIntegrate::init()
{
  dim = domain->dimension;
  pair = PairFoam::of(lmp);
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
  list.begin_run(pair->hub.skin);

  gas = nullptr;
  followers.clear();
  flows.clear();
  shear = nullptr;
  for (auto &ifix : modify->get_fix_list()) {
    if (auto *found = dynamic_cast<FixFoamCoarsen *>(ifix)) gas = found;
    if (auto *found = dynamic_cast<FoamFollower *>(ifix)) followers.push_back(found);
    if (auto *found = dynamic_cast<FixFoamFlow *>(ifix)) {
      flows.push_back(found);
      if (found->moves_box() && !shear) shear = found;
    }
  }
  list.goes_with_box = shear;
  check_companions();
  time_then = driver.time;
  if (record.rin > 0.0) pair->hub.go_on_from(record);

  const bool mean = pair->neighbor_drag || pair->neighbor_solve;
  if (mean && !flows.empty() && drift_given && drift_removed)
    error->all(FLERR,
               "Fix {}: drift remove cannot be used with drag neighbor and fix foam/flow, which "
               "moves the foam as a whole: use drift keep",
               style);
  const bool drifts =
      mean && flows.empty() && domain->xperiodic && domain->yperiodic && domain->zperiodic;
  const bool source = driver.control.scheme == Foam::Scheme::SOURCE;
  if (!drift_given)
    drift_removed = drifts && (suffers_from_drift() || (pair->neighbor_solve && !source));
  if (drifts && pair->neighbor_drag && !drift_removed && comm->me == 0)
    error->warning(FLERR,
                   "Fix {}: with neighbor drag, nothing holds the foam as a whole in a "
                   "periodic box: it drifts, faster with more steps; see keyword drift",
                   style);

  // what is switched off is not gathered

  pair->hub.gas_wanted = 0;
  if (gas) gas->tell(pair->hub);
  pair->hub.radii_change = gas != nullptr;
  lag.active = lags();
  if (pair->neighbor_drag) lag.columns.use(atom->nmax);
  if (pair->mu_c > 0.0) solved.use(atom->nmax);
  solved_with = pair->mu_c;
  solved_mean = pair->neighbor_solve;
}
