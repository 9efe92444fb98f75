/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_flow.h"

#include "foam_variable.h"

#include "foam_input.h"

#include "comm.h"
#include "error.h"
#include "group.h"
#include "modify.h"
#include "region.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID foam/flow region REGION velocity VX VY VZ touch yes|no
   fix ID group-ID foam/flow shear
   fix ID group-ID foam/flow field v_UX v_UY v_UZ
------------------------------------------------------------------------- */

FixFoamFlow::FixFoamFlow(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix foam/flow", narg - 3, arg + 3);
  const std::vector<Kind> KINDS = {Kind::REGION, Kind::SHEAR, Kind::FIELD};
  kind = KINDS[input.argument("KIND").one_of({"region", "shear", "field"})];
  const std::string AXES[] = {"X", "Y", "Z"};
  FoamInput::Keywords keywords;
  if (kind == Kind::REGION) {
    region_id = input.argument("REGION").word("the ID of a region");
    input.argument("velocity").one_of({"velocity"});
    for (int k = 0; k < 3; k++) velocity[k] = input.argument("V" + AXES[k]).number();
    keywords = {{"touch", [&](const Value &v) {
                   touching = v.one_of({"no", "yes"});
                 }}};
  } else if (kind == Kind::FIELD) {
    const std::string allowed = "v_NAME of an atom-style variable, 0 or NULL";
    for (int k = 0; k < 3; k++) {
      const Value v = input.argument("U" + AXES[k]);
      const std::string word = v.word(allowed);
      if (word == "0" || word == "NULL") continue;
      if (!utils::strmatch(word, "^v_.")) v.reject(allowed);
      variable_name[k] = word.substr(2);
    }
  }
  input.keywords(keywords);
  if (domain->dimension == 2 && (velocity[2] != 0.0 || !variable_name[2].empty()))
    error->all(FLERR, "Fix foam/flow: {} must be 0 in 2D", kind == Kind::REGION ? "VZ" : "UZ");

  vector_flag = 1;
  size_vector = 5;
  extvector = 0;
  global_freq = 1;
}

int FixFoamFlow::setmask()
{
  return moves_box() ? PRE_EXCHANGE : 0;
}

void FixFoamFlow::init()
{
  check_foam();
  if (kind == Kind::REGION) {
    region = domain->get_region_by_id(region_id);
    if (!region)
      error->all(FLERR, "Fix foam/flow: REGION must be the ID of a region, not {}",
                 FoamInput::shown(region_id));
    if (touching && region->dynamic)
      error->all(FLERR, "Fix foam/flow: touch yes needs a region that stays where it is, unlike {}",
                 FoamInput::shown(region_id));
    if (touching && region->openflag)
      error->all(FLERR, "Fix foam/flow: touch yes needs a region without open faces, which {} has",
                 FoamInput::shown(region_id));
  }
  for (const std::string &name : variable_name)
    if (!name.empty()) check_atom_variable(lmp, "foam/flow", name);
}

void FixFoamFlow::check_foam()
{
  pair = PairFoam::for_style(lmp, "Fix foam/flow", kokkosable, execution_space);
  bool integrated = false, deforms = false, before = true;
  for (auto &ifix : modify->get_fix_list()) {
    if (FoamHub::integrates(ifix)) integrated = true;
    if (ifix == this) before = false;
    if (before && utils::strmatch(ifix->style, "^deform")) deforms = true;
  }
  if (!integrated)
    error->all(FLERR,
               "Fix foam/flow needs a fix that integrates the foam, fix foam/rkc or foam/abm");
  if (!moves_box()) return;
  if (!deforms)
    error->all(FLERR,
               "Fix foam/flow shear follows the box of a fix deform, which has to stand before it "
               "in the input");
  if (domain->deform_vremap)
    error->all(FLERR,
               "Fix foam/flow shear moves bubbles by their own velocities: fix deform must have "
               "remap none, not remap v");
  if (pair->neighbor_drag || pair->neighbor_solve)
    error->all(FLERR,
               "Fix foam/flow shear cannot be used with drag neighbor: velocities of neighbors "
               "across a boundary that moves are not those of their images; use drag static");
}

Fix *FixFoamFlow::fix_deform() const
{
  for (auto &ifix : modify->get_fix_list())
    if (utils::strmatch(ifix->style, "^deform")) return ifix;
  return nullptr;
}

void FixFoamFlow::setup(int)
{
  last_step = -1;
}

/* ----------------------------------------------------------------------
   u_i
------------------------------------------------------------------------- */

// Region::surface() is for particles on the side of the region itself

bool FixFoamFlow::touches(double *x, double R)
{
  return region->interior ? region->surface_exterior(x, R) : region->surface_interior(x, R);
}

void FixFoamFlow::fill_region(FoamColumns &u)
{
  double *const columns[3] = {u[0], u[1], u[2]};
  region->prematch();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    double x[3] = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
    domain->remap(x);    // between two list builds bubbles may be beyond a boundary
    if (region->match(x[0], x[1], x[2]) || (touching && touches(x, atom->radius[i])))
      for (int k = 0; k < 3; k++) columns[k][i] = velocity[k];
  }
}

void FixFoamFlow::fill_field(FoamColumns &u)
{
  const int n = atom->nlocal;
  double *const columns[3] = {u[0], u[1], u[2]};
  modify->clearstep_compute();
  for (int k = 0; k < 3; k++) {
    if (variable_name[k].empty()) {
      for (int i = 0; i < n; i++)
        if (atom->mask[i] & groupbit) columns[k][i] = 0.0;
      continue;
    }
    take_atom_variable(lmp, "foam/flow", variable_name[k], igroup, columns[k]);
  }
  modify->addstep_compute(update->ntimestep + 1);
}

/* ----------------------------------------------------------------------
   a box that moves
------------------------------------------------------------------------- */

// The rates of its style variable fix deform has only told once it has acted, and whether it moves bubbles, too, it
// tells nobody.  So it acts now, where it changes nothing but what is put back: on a box that is a bit off bubbles must
// stay, and the present one gives the rates.  Styles that add up what they do step by step see no time pass.

void FixFoamFlow::begin_run()
{
  host_reads();
  std::vector<double> x;
  if (atom->nlocal) x.assign(&atom->x[0][0], &atom->x[0][0] + 3 * size_t(atom->nlocal));

  const FoamBoxShape now(domain);
  constexpr double OFF = 1.0e-3;
  FoamBoxShape off = now;
  for (int k = 0; k < domain->dimension; k++) off.hi[k] += OFF * domain->prd[k];
  if (domain->triclinic) {
    off.xy += OFF * domain->xprd;
    if (domain->dimension == 3) {
      off.xz += OFF * domain->xprd;
      off.yz += OFF * domain->yprd;
    }
  }
  const double dt = update->dt;
  update->dt = 0.0;
  off.put(domain);
  fix_deform()->end_of_step();
  now.put(domain);
  fix_deform()->end_of_step();    // rates may depend on the size of the box
  now.put(domain);
  update->dt = dt;
  for (double *rate : {&domain->h_rate[0], &domain->h_rate[1], &domain->h_rate[2]})
    if (!std::isfinite(*rate)) *rate = domain->h_ratelo[rate - domain->h_rate] = 0.0;

  host_reads();
  int moved = 0, any;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++)
      if (atom->x[i][k] != x[3 * size_t(i) + k]) moved = 1;
  MPI_Allreduce(&moved, &any, 1, MPI_INT, MPI_MAX, world);
  if (any)
    error->all(FLERR,
               "Fix foam/flow shear moves bubbles by their own velocities: fix deform must have "
               "remap none, not remap x, which moves them once more");
}

void FixFoamFlow::box_goes_on(double step)
{
  FoamBoxShape then(domain);
  then.move(domain, step);
  then.put(domain);
  moved_by = step;
  moved_tilts[0] = then.yz;
  moved_tilts[1] = then.xz;
  moved_tilts[2] = then.xy;
}

// fix deform has just flipped the box, by the tilts at the end of the last step

void FixFoamFlow::pre_exchange()
{
  if (moved_by == 0.0) return;
  FoamBoxShape now(domain);
  if (now.yz == moved_tilts[0] && now.xz == moved_tilts[1] && now.xy == moved_tilts[2]) return;
  now.tilt(domain, moved_by);
  now.put(domain);
  moved_tilts[0] = now.yz;
  moved_tilts[1] = now.xz;
  moved_tilts[2] = now.xy;
}

/* ----------------------------------------------------------------------
   output
------------------------------------------------------------------------- */

Foam::FlowTotals FixFoamFlow::totals_there()
{
  FoamHost space(lmp);
  return totals_in(space);
}

double FixFoamFlow::compute_vector(int n)
{
  if (!pair) return 0.0;    // no run so far
  if (last_step != update->ntimestep) {
    last = foam_sum(totals_there(), world);
    last_step = update->ntimestep;
  }
  if (n == 3) return last.bubbles;
  if (n == 4) return last.dissipated;
  return last.bubbles > 0.0 ? last.velocity[n] / last.bubbles : 0.0;
}

double FixFoamFlow::memory_usage()
{
  return bytes(all_columns);
}
