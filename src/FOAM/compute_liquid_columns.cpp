/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_liquid_columns.h"

#include "foam_input.h"

#include "atom.h"
#include "error.h"
#include "memory.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

ComputeLiquidColumns::ComputeLiquidColumns(LAMMPS *lmp, int narg, char **arg, const char *name,
                                           const std::vector<Quantity> &known)
    : Compute(lmp, narg, arg)
{
  std::string all;
  for (const auto &its : known) all += (all.empty() ? "" : ", ") + its.name;
  if (narg < 4) error->all(FLERR, "Compute {} needs at least one quantity: {}", name, all);
  for (int iarg = 3; iarg < narg; iarg++) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto &its) { return its.name == arg[iarg]; });
    if (found == known.end())
      error->all(FLERR, "Compute {}: unknown quantity {} (known are {})", name,
                 FoamInput::shown(arg[iarg]), all);
    wanted.push_back(*found);
  }
  peratom_flag = 1;
  size_peratom_cols = wanted.size() == 1 ? 0 : static_cast<int>(wanted.size());
}

ComputeLiquidColumns::~ComputeLiquidColumns()
{
  memory->destroy(vector);
  memory->destroy(array);
}

void ComputeLiquidColumns::add_vector(std::vector<Quantity> &all, const std::string &name,
                                      int column, int place)
{
  for (int k = 0; k < 3; k++) all.push_back({name + "xyz"[k], column + k, place});
}

void ComputeLiquidColumns::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  const int width = static_cast<int>(wanted.size());
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(vector);
    memory->destroy(array);
    if (width == 1)
      vector_atom = memory->create(vector, nmax, "liquid/columns:vector");
    else
      array_atom = memory->create(array, nmax, width, "liquid/columns:array");
  }
  double *const out = width == 1 ? vector : array[0];
  const int both = groupbit | members();
  for (int c = 0; c < width; c++) {
    FoamColumns &from = columns(wanted[c].place);
    const double *const column = from.in_use() ? from[wanted[c].column] : nullptr;
    for (int i = 0; i < atom->nlocal; i++)    // some may have been created since
      out[static_cast<size_t>(i) * width + c] =
          column && i < from.rows() && (atom->mask[i] & both) == both ? column[i] : 0.0;
  }
}

double ComputeLiquidColumns::memory_usage()
{
  return sizeof(double) * double(nmax) * wanted.size();
}
