/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_travelling.h"

#include "atom.h"

using namespace LAMMPS_NS;

FixFoamTravelling::FixFoamTravelling(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  restart_peratom = 1;
  create_attribute = 1;
}

void FixFoamTravelling::add_callbacks()
{
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  called_back = true;
}

FixFoamTravelling::~FixFoamTravelling()
{
  if (!called_back) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

void FixFoamTravelling::grow_arrays(int nmax)
{
  for (FoamColumns *all : travelling()) all->grow(nmax);
}

void FixFoamTravelling::copy_arrays(int i, int j, int)
{
  for (FoamColumns *all : travelling()) all->copy(i, j);
}

void FixFoamTravelling::set_arrays(int i)
{
  for (FoamColumns *all : travelling()) all->clear(i);
}

int FixFoamTravelling::pack_exchange(int i, double *buf)
{
  int m = 0;
  for (FoamColumns *all : travelling()) m += all->pack(i, buf + m);
  return m;
}

int FixFoamTravelling::unpack_exchange(int i, double *buf)
{
  int m = 0;
  for (FoamColumns *all : travelling()) m += all->unpack(i, buf + m);
  return m;
}

// in a restart file: the size, which columns were in use, their numbers

int FixFoamTravelling::pack_restart(int i, double *buf)
{
  const FoamColumnList all = travelling();
  unsigned in_use = 0;
  for (size_t n = 0; n < all.size(); n++)
    if (all[n]->in_use()) in_use |= 1u << n;
  buf[0] = size_restart(i);
  buf[1] = in_use;
  return 2 + FixFoamTravelling::pack_exchange(i, buf + 2);
}

const double *FixFoamTravelling::of_restart(const Atom *atom, int i, int nth)
{
  const double *extra = atom->extra[i];
  for (int m = 0; m < nth; m++) extra += static_cast<int>(*extra);
  return extra + 1;
}

void FixFoamTravelling::unpack_restart(int i, int nth)
{
  const double *numbers = of_restart(atom, i, nth);
  const auto in_use = static_cast<unsigned>(*numbers++);
  const FoamColumnList all = travelling();
  for (size_t n = 0; n < all.size(); n++) {
    if (!(in_use & (1u << n))) continue;
    if (wanted(*all[n])) all[n]->use(atom->nmax);
    all[n]->unpack(i, numbers);
    numbers += all[n]->capacity();
  }
}

int FixFoamTravelling::size_restart(int)
{
  int n = 2;
  for (const FoamColumns *all : travelling()) n += all->active();
  return n;
}

int FixFoamTravelling::maxsize_restart()
{
  return 2 + capacity(travelling());
}

double FixFoamTravelling::memory_usage()
{
  return bytes(all_columns);
}
