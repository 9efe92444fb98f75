/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_wall.h"

#include "foam_host.h"
#include "foam_input.h"
#include "foam_reduce.h"

#include "error.h"
#include "modify.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;
using namespace FixConst;

static const std::vector<std::string> FACES{"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"};

/* ----------------------------------------------------------------------
   fix ID group-ID foam/wall face ... keyword value ...
------------------------------------------------------------------------- */

FixFoamWall::FixFoamWall(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix foam/wall", narg - 3, arg + 3);
  const FoamInput::Keywords keywords{{"drag",
                                      [&](const Value &v) {
                                        drag = v.from_to(0.0, 1.0);
                                      }},
                                     {"cover", [&](const Value &v) {
                                        covers = v.one_of({"no", "yes"});
                                      }}};
  auto is_keyword = [&](const std::string &word) {
    return std::any_of(keywords.begin(), keywords.end(),
                       [&](const auto &keyword) { return keyword.first == word; });
  };
  int iarg = 3;
  do {
    const int face = input.argument("face").one_of(FACES);
    if (std::find(faces.begin(), faces.end(), face) != faces.end())
      error->all(FLERR, "Fix foam/wall: face {} is given twice: each can have one wall",
                 FACES[face]);
    faces.push_back(face);
  } while (++iarg < narg && !is_keyword(arg[iarg]));
  input.keywords(keywords);
  check_box();

  scalar_flag = vector_flag = 1;
  size_vector = 4;
  extscalar = extvector = 1;
  global_freq = 1;
  energy_global_flag = 1;
  virial_global_flag = virial_peratom_flag = 1;
}

FixFoamWall::~FixFoamWall()
{
  if (!lmp->force) return;    // LAMMPS ends
  if (PairFoam *its = PairFoam::of(lmp)) its->hub.take_away(this);
}

int FixFoamWall::setmask()
{
  return POST_FORCE | MIN_POST_FORCE;
}

// A face of boundary s or m follows the outermost centres, which would be on the wall

void FixFoamWall::check_box() const
{
  if (domain->triclinic)
    error->all(FLERR, "Fix foam/wall needs an orthogonal box: this one is triclinic");
  for (int face : faces) {
    const int axis = face / 2;
    if (axis >= domain->dimension)
      error->all(FLERR, "Fix foam/wall: face {} is none of a box of dimension 2", FACES[face]);
    const int type = domain->boundary[axis][face % 2];
    if (type != 1)
      error->all(FLERR,
                 "Fix foam/wall: face {} is no place for a wall: its boundary must be f, not {}",
                 FACES[face], "pfsm"[type]);
  }
}

void FixFoamWall::init()
{
  pair = PairFoam::for_style(lmp, "Fix foam/wall", kokkosable, execution_space);
  check_box();
  for (auto &ifix : modify->get_fix_list())
    if (auto *other = dynamic_cast<FixFoamWall *>(ifix); other && other != this)
      for (int face : faces)
        if (std::find(other->faces.begin(), other->faces.end(), face) != other->faces.end())
          error->all(FLERR,
                     "Fix foam/wall: fixes {} and {} both have face {}: each can have one wall", id,
                     other->id, FACES[face]);

  pair->hub.take_away(this);
  for (int face : faces) pair->hub.walls.push_back({this, face, drag, covers});
}

/* ----------------------------------------------------------------------
   forces
------------------------------------------------------------------------- */

void FixFoamWall::setup(int vflag)
{
  post_force(vflag);
}

void FixFoamWall::min_setup(int vflag)
{
  post_force(vflag);
}

void FixFoamWall::min_post_force(int vflag)
{
  post_force(vflag);
}

void FixFoamWall::post_force(int vflag)
{
  v_init(vflag);
  if (vflag_atom) stress.use(atom->nmax);
  push();
  reduced = false;

  if (vflag_global) {
    const Foam::WallTotals mine = fetch();
    for (int k = 0; k < 3; k++) virial[k] += mine.virial[k];
  }
  if (vflag_atom) {
    host_reads();
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit)
        for (int k = 0; k < 3; k++) vatom[i][k] += stress[k][i];
  }
}

void FixFoamWall::push()
{
  FoamHost space(lmp, groupbit);
  push_in(space);
}

/* ----------------------------------------------------------------------
   output
------------------------------------------------------------------------- */

const Foam::WallTotals &FixFoamWall::of_all_ranks()
{
  if (!reduced) all_totals = foam_sum(fetch(), world);
  reduced = true;
  return all_totals;
}

double FixFoamWall::compute_scalar()
{
  return of_all_ranks().energy;
}

double FixFoamWall::compute_vector(int n)
{
  const Foam::WallTotals &all = of_all_ranks();
  return n < 3 ? all.force[n] : all.touching;
}

double FixFoamWall::memory_usage()
{
  return bytes(all_columns);
}
