/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_wall_bubble.h"

#include "bubble_input.h"
#include "pair_bubble_collision.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "region.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID wall/bubble plane PX PY PZ NX NY NZ keyword value ...
   fix ID group-ID wall/bubble region ID keyword value ...
------------------------------------------------------------------------- */

FixWallBubble::FixWallBubble(LAMMPS *lmp, int narg, char **arg)
    : FixBubbleFilms(lmp, narg, arg, Derived())
{
  FoamInput input(error, "Fix wall/bubble", narg - 3, arg + 3);
  int used = 3;
  if (input.argument("kind of wall").one_of({"plane", "region"}) == 1) {
    region_name = input.argument("region").word("the ID of a region");
    if (!domain->get_region_by_id(region_name))
      error->all(FLERR, "Fix wall/bubble: there is no region {}", FoamInput::shown(region_name));
    used += 2;
  } else {
    const char *const of_place[] = {"PX", "PY", "PZ"}, *const of_normal[] = {"NX", "NY", "NZ"};
    for (int k = 0; k < 3; k++) place[k] = input.argument(of_place[k]).number();
    for (int k = 0; k < 3; k++) normal[k] = input.argument(of_normal[k]).number();
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    if (!(length > 0.0))
      error->all(FLERR,
                 "Fix wall/bubble: the normal NX NY NZ must not be 0: it points to the bubbles");
    for (double &n : normal) n /= length;
    used += 7;
  }
  words.assign(arg + used, arg + narg);
  take_model();    // bad words are told here

  vector_flag = scalar_flag = 1;
  size_vector = ENERGY;
  extscalar = extvector = 1;
  global_freq = 1;
  energy_global_flag = virial_global_flag = 1;
  restart_global = 1;
  keep_records();
}

// the model of the pair style with what the keywords say; without a pair style yet, to look at the words only

void FixWallBubble::take_model()
{
  const PairBubbleCollision *const pair = PairBubbleCollision::of(lmp);
  model = pair ? pair->model : Bubble::Collision();
  bool exact = pair && pair->exact;
  model.slides = true;
  std::vector<char *> arguments;
  for (std::string &word : words) arguments.push_back(&word[0]);
  FoamInput input(error, "Fix wall/bubble", static_cast<int>(arguments.size()), arguments.data());
  FoamInput::Keywords keywords = collision_keywords(model, exact);
  keywords.emplace_back("tangential", [&](const FoamInput::Value &v) {
    model.slides = v.one_of({"no", "yes"});
  });
  input.keywords(keywords);
  if (exact && table.empty()) table = Bubble::film_table();
  model.integral.first = exact ? table.data() : nullptr;
}

int FixWallBubble::setmask()
{
  return POST_FORCE | PRE_REVERSE | PRE_EXCHANGE | MIN_PRE_EXCHANGE;    // PRE_REVERSE: for set-up
}

void FixWallBubble::init()
{
  const PairBubbleCollision *const pair = PairBubbleCollision::of(lmp);
  if (!pair)
    error->all(FLERR, "Fix wall/bubble needs pair_style bubble/collision, whose model it takes");
  pair->check_place("Fix wall/bubble", kokkosable, execution_space);
  take_model();
  region = nullptr;
  if (region_name.empty()) return;
  region = domain->get_region_by_id(region_name);
  if (!region) error->all(FLERR, "Fix wall/bubble: region {} is gone", region_name);
  if (region->dynamic_check())
    error->all(FLERR, "Fix wall/bubble: region {} moves or changes: its surface must rest",
               region_name);
}

// before setup() of any fix: fix bubble/nve gives bubbles back their velocities there

void FixWallBubble::setup_pre_reverse(int, int vflag)
{
  act(vflag);
  losses.begin(totals);
}

void FixWallBubble::post_force(int vflag)
{
  act(vflag);
  losses.step(totals, update->dt);
}

void FixWallBubble::act(int vflag)
{
  v_init(vflag);
  push();
  reduced = false;
  if (!vflag_global) return;
  const double sums[6] = {totals.xx, totals.yy, totals.zz, totals.xy, totals.xz, totals.yz};
  for (int k = 0; k < 6; k++) virial[k] += sums[k];
}

/* ----------------------------------------------------------------------
   forces
------------------------------------------------------------------------- */

namespace {

// the surface of a region, on the host: LAMMPS finds the places where it is next to a bubble

template <class B> struct MeetRegion {
  Bubble::MeetPlane<B> wall;
  Region *region;

  void operator()(int i, Bubble::WallTotals &all) const
  {
    const auto &b = wall.b;
    if (wall.films.done(i)) return;
    const double R = b.radius(i), reach = R + wall.encounter.model.range(Bubble::Gap::to_wall(R));
    const bool within = region->match(b.x(i, 0), b.x(i, 1), b.x(i, 2));
    const int n = within ? region->surface(b.x(i, 0), b.x(i, 1), b.x(i, 2), reach) : 0;
    Bubble::Films::Met met = wall.films.begin(i);
    for (int m = 0; m < n; m++) {
      const auto &contact = region->contact[m];
      const double unit[3] = {contact.delx / contact.r, contact.dely / contact.r,
                              contact.delz / contact.r};
      wall.touch(i, contact.r, unit, contact.iwall, met, all);
    }
    met.more = 0;    // where there are more than a record has room for, h0 of some is not kept
    wall.films.end(i, b.tag(i), met);
  }
};

}    // namespace

Bubble::WallTotals FixWallBubble::meet(FoamHost &space,
                                       const Bubble::MeetPlane<Foam::HostBubbles> &wall)
{
  if (!region) return space.totals<Bubble::WallTotals>(atom->nlocal, wall);
  region->prematch();
  return space.totals<Bubble::WallTotals>(atom->nlocal,
                                          MeetRegion<Foam::HostBubbles>{wall, region});
}

void FixWallBubble::push()
{
  FoamHost space(lmp, groupbit);
  push_in(space);
}

void FixWallBubble::add_looks(FoamColumns &looks)
{
  FoamHost space(lmp, groupbit);
  add_looks_in(space, looks);
}

/* ----------------------------------------------------------------------
   output
------------------------------------------------------------------------- */

void FixWallBubble::reduce()
{
  if (reduced) return;
  double mine[ALL] = {totals.fx,      totals.fy,          totals.fz,      totals.closed,
                      totals.viscous, totals.lubrication, totals.sliding, losses.sum[0],
                      losses.sum[1],  losses.sum[2],      totals.energy};
  MPI_Allreduce(mine, all, ALL, MPI_DOUBLE, MPI_SUM, world);
  reduced = true;
}

double FixWallBubble::compute_scalar()
{
  reduce();
  return all[ENERGY];
}

double FixWallBubble::compute_vector(int n)
{
  reduce();
  return all[n];
}

void FixWallBubble::write_restart(FILE *fp)
{
  double sums[Bubble::Losses::TERMS];
  MPI_Reduce(losses.sum, sums, Bubble::Losses::TERMS, MPI_DOUBLE, MPI_SUM, 0, world);
  if (comm->me != 0) return;
  const int size = sizeof(sums);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(sums, size, 1, fp);
}

void FixWallBubble::restart(char *buf)
{
  const auto *sums = (const double *) buf;
  for (int k = 0; k < Bubble::Losses::TERMS; k++) losses.sum[k] = comm->me == 0 ? sums[k] : 0.0;
}
