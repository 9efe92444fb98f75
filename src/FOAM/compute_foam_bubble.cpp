/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_foam_bubble.h"

#include "fix_foam_coarsen.h"
#include "foam_physics.h"
#include "pair_durian_foam.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;

static const char *const NAMES[] = {"contacts", "area", "free",    "vfilm",
                                    "vliquid",  "rdot", "espring", "edurian"};

/* ---------------------------------------------------------------------- */

ComputeFoamBubble::ComputeFoamBubble(LAMMPS *lmp, int narg, char **arg)
    : Compute(lmp, narg, arg), pair(nullptr), gas(nullptr), nmax(0), vector(nullptr), array(nullptr)
{
  if (narg < 4)
    error->all(FLERR, "Compute foam/bubble needs at least one quantity: "
                      "contacts, area, free, vfilm, vliquid, rdot, espring or edurian");
  for (int iarg = 3; iarg < narg; iarg++) {
    int q = 0;
    while (q <= EDURIAN && strcmp(arg[iarg], NAMES[q]) != 0) q++;
    if (q > EDURIAN)
      error->all(FLERR,
                 "Compute foam/bubble: unknown quantity {} "
                 "(allowed are contacts, area, free, vfilm, vliquid, rdot, espring, edurian)",
                 arg[iarg]);
    quantities.push_back(static_cast<Quantity>(q));
  }

  peratom_flag = 1;
  size_peratom_cols = quantities.size() == 1 ? 0 : quantities.size();
}

ComputeFoamBubble::~ComputeFoamBubble()
{
  memory->destroy(vector);
  memory->destroy(array);
}

void ComputeFoamBubble::init()
{
  pair = dynamic_cast<PairDurianFoam *>(force->pair_match("durian/foam", 0));
  if (!pair) error->all(FLERR, "Compute foam/bubble needs pair_style durian/foam");
  gas = nullptr;
  for (auto &ifix : modify->get_fix_list())
    if (auto *found = dynamic_cast<FixFoamCoarsen *>(ifix)) gas = found;
}

void ComputeFoamBubble::compute_peratom()
{
  invoked_peratom = update->ntimestep;

  const int columns = quantities.size();
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(vector);
    memory->destroy(array);
    if (columns == 1)
      memory->create(vector, nmax, "foam/bubble:vector");
    else
      memory->create(array, nmax, columns, "foam/bubble:array");
    vector_atom = vector;
    array_atom = array;
  }

  // the sums of the pair style may be those of another state, or fewer: gather them all

  pair->gather();
  const FixFoamCoarsen::Liquid liquid =
      gas && gas->wanted() & PairDurianFoam::AREA ? gas->liquid() : FixFoamCoarsen::Liquid();

  const double *const radius = atom->radius;
  const bool flat = domain->dimension == 2;
  for (int i = 0; i < atom->nlocal; i++) {
    const double R = radius[i];
    const bool counts = (atom->mask[i] & groupbit) && R > 0.0;
    const FixFoamCoarsen::Split V =
        gas ? gas->exchange(i, liquid) : FixFoamCoarsen::Split{0.0, 0.0};

    for (int c = 0; c < columns; c++) {
      double value = 0.0;
      if (counts) switch (quantities[c]) {
          case CONTACTS:
            value = pair->contacts[i];
            break;
          case AREA:
            value = pair->area[i];
            break;
          case FREE:
            value =
                Foam::free_area(flat ? Foam::surface<2>(R) : Foam::surface<3>(R), pair->area[i]);
            break;
          case VFILM:
            value = V.film;
            break;
          case VLIQUID:
            value = V.liquid;
            break;
          case RDOT:
            value = flat ? Foam::radius_rate<2>(V.film + V.liquid, R)
                         : Foam::radius_rate<3>(V.film + V.liquid, R);
            break;
          case ESPRING:
            value = pair->espring[i];
            break;
          case EDURIAN:
            value = pair->edurian[i];
            break;
        }
      if (columns == 1)
        vector[i] = value;
      else
        array[i][c] = value;
    }
  }
}

double ComputeFoamBubble::memory_usage()
{
  return sizeof(double) * double(nmax) * quantities.size();
}
