/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_foam_bubble.h"

#include "fix_foam_coarsen.h"
#include "foam_input.h"
#include "foam_physics.h"
#include "pair_foam.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "update.h"

#include <algorithm>
#include <iterator>
#include <string>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

ComputeFoamBubble::ComputeFoamBubble(LAMMPS *lmp, int narg, char **arg)
    : Compute(lmp, narg, arg), pair(nullptr), gas(nullptr), nmax(0), vector(nullptr), array(nullptr)
{
  std::string all;
  for (const char *name : Foam::QUANTITIES) all += (all.empty() ? "" : ", ") + std::string(name);
  if (narg < 4) error->all(FLERR, "Compute foam/bubble needs at least one quantity: {}", all);
  for (int iarg = 3; iarg < narg; iarg++) {
    const auto *const found =
        std::find(std::begin(Foam::QUANTITIES), std::end(Foam::QUANTITIES), std::string(arg[iarg]));
    if (found == std::end(Foam::QUANTITIES))
      error->all(FLERR, "Compute foam/bubble: unknown quantity {} (allowed are {})",
                 FoamInput::shown(arg[iarg]), all);
    if (wanted.count == Foam::Quantities::MOST)
      error->all(FLERR, "Compute foam/bubble: at most {} quantities", Foam::Quantities::MOST);
    wanted.name[wanted.count++] = static_cast<Foam::Quantity>(found - std::begin(Foam::QUANTITIES));
  }

  peratom_flag = 1;
  size_peratom_cols = wanted.count == 1 ? 0 : wanted.count;
}

ComputeFoamBubble::~ComputeFoamBubble()
{
  memory->destroy(vector);
  memory->destroy(array);
}

void ComputeFoamBubble::init()
{
  PairFoam::for_style(lmp, "Compute foam/bubble", kokkosable, execution_space);
  find_foam();
}

void ComputeFoamBubble::find_foam()
{
  pair = PairFoam::of(lmp);
  if (!pair) error->all(FLERR, "Compute foam/bubble needs one pair_style durian/foam");
  gas = nullptr;
  for (auto &ifix : modify->get_fix_list())
    if (auto *found = dynamic_cast<FixFoamCoarsen *>(ifix); found && found->ready()) gas = found;
}

// Between runs commands may have replaced styles, or put bubbles in or taken them out

void ComputeFoamBubble::gather()
{
  find_foam();
  const NeighList *list = pair->list;
  while (list && list->listskip)
    list = list->listskip;    // of pair_style hybrid: without other types
  int outdated = !list || list->inum != atom->nlocal, any;
  MPI_Allreduce(&outdated, &any, 1, MPI_INT, MPI_MAX, world);
  if (any)
    error->all(FLERR,
               "Compute foam/bubble: the neighbor list is that of another foam: use run 0 after "
               "commands that change the pair style or the number of bubbles");
  pair->gather_diagnostics();
}

void ComputeFoamBubble::compute_peratom()
{
  invoked_peratom = update->ntimestep;

  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(vector);
    memory->destroy(array);
    if (wanted.count == 1)
      memory->create(vector, nmax, "foam/bubble:vector");
    else
      memory->create(array, nmax, wanted.count, "foam/bubble:array");
    vector_atom = vector;
    array_atom = array;
  }

  // the sums of the pair style may be those of another state, or fewer: gather them all

  gather();
  FoamHost space(lmp);
  fill(space, Foam::Values<int>{atom->mask}, wanted.count == 1 ? vector : array[0]);
}

double ComputeFoamBubble::memory_usage()
{
  return sizeof(double) * double(nmax) * wanted.count;
}
