/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_bubble_collision.h"

#include "fix_bubble_rise.h"
#include "fix_wall_bubble.h"
#include "foam_input.h"
#include "pair_bubble_collision.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <string>

using namespace LAMMPS_NS;

// in the order of Bubble::Look, and the liquid's

static std::vector<std::string> names_of_quantities()
{
  std::vector<std::string> names;
  auto vectors = [&](const std::vector<std::string> &terms) {
    for (const auto &term : terms)
      for (const char *const axis : {"_x", "_y", "_z"}) names.push_back(term + axis);
  };
  vectors({"elastic", "viscous", "lubrication", "tangential"});
  names.insert(names.end(), {"contacts", "delta", "ra", "h0", "energy"});
  vectors({"drag", "buoyancy"});
  return names;
}

/* ----------------------------------------------------------------------
   compute ID group-ID bubble/collision quantity ...
------------------------------------------------------------------------- */

ComputeBubbleCollision::ComputeBubbleCollision(LAMMPS *lmp, int narg, char **arg)
    : Compute(lmp, narg, arg)
{
  const std::vector<std::string> names = names_of_quantities();
  std::string all;
  for (const auto &name : names) all += (all.empty() ? "" : ", ") + name;
  if (narg < 4) error->all(FLERR, "Compute bubble/collision needs at least one quantity: {}", all);
  for (int iarg = 3; iarg < narg; iarg++) {
    const auto found = std::find(names.begin(), names.end(), arg[iarg]);
    if (found == names.end())
      error->all(FLERR, "Compute bubble/collision: unknown quantity {} (allowed are {})",
                 FoamInput::shown(arg[iarg]), all);
    wanted.push_back(static_cast<int>(found - names.begin()));
  }
  peratom_flag = 1;
  size_peratom_cols = wanted.size() == 1 ? 0 : static_cast<int>(wanted.size());
}

ComputeBubbleCollision::~ComputeBubbleCollision()
{
  memory->destroy(vector);
  memory->destroy(array);
}

void ComputeBubbleCollision::init()
{
  pair = PairBubbleCollision::of(lmp);
  if (!pair) error->all(FLERR, "Compute bubble/collision needs pair_style bubble/collision");
}

void ComputeBubbleCollision::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(vector);
    memory->destroy(array);
    if (wanted.size() == 1)
      memory->create(vector, nmax, "bubble/collision:vector");
    else
      memory->create(array, nmax, static_cast<int>(wanted.size()), "bubble/collision:array");
    vector_atom = vector;
    array_atom = array;
  }
  if (!PairBubbleCollision::of(lmp) || !pair->list)
    error->all(
        FLERR,
        "Compute bubble/collision: run 0 is needed after commands that change the pair style");

  comm->forward_comm();    // ghosts have velocities from before the end of the step
  FoamColumns &looks = pair->look();
  for (auto &fix : modify->get_fix_list())
    if (auto *wall = dynamic_cast<FixWallBubble *>(fix)) wall->add_looks(looks);
  FixBubbleRise *const rise = FixBubbleRise::of(lmp);
  FoamColumns *const liquid = rise ? &rise->look() : nullptr;
  pair->host_reads();

  double *out = wanted.size() == 1 ? vector : array[0];
  for (int i = 0; i < atom->nlocal; i++)
    for (const int quantity : wanted) {
      double value = 0.0;
      if (quantity < OF_LIQUID)
        value = looks[quantity][i];
      else if (liquid)
        value = (*liquid)[quantity - OF_LIQUID][i];
      *out++ = atom->mask[i] & groupbit ? value : 0.0;
    }
}

double ComputeBubbleCollision::memory_usage()
{
  return sizeof(double) * double(nmax) * wanted.size();
}
