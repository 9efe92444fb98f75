/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "liquid_births.h"

#include "lammps_compat.h"
#include "liquid_physics.h"

#include "atom.h"
#include "comm.h"
#include "library.h"

#include <algorithm>
#include <tuple>

using namespace LAMMPS_NS;

void LiquidBirths::create(const std::vector<Newborn> &of_this_rank)
{
  constexpr int WIDTH = sizeof(Newborn) / sizeof(double);
  const int mine = WIDTH * static_cast<int>(of_this_rank.size());
  std::vector<int> counts(comm->nprocs), places(comm->nprocs, 0);
  int one = mine;
  MPI_Allgather(&one, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int rank = 1; rank < comm->nprocs; rank++)
    places[rank] = places[rank - 1] + counts[rank - 1];
  const int doubles = places.back() + counts.back();
  if (doubles == 0) return;
  std::vector<Newborn> all(doubles / WIDTH), own(of_this_rank);
  own.resize(std::max<size_t>(own.size(), 1));
  MPI_Allgatherv(own.data(), mine, MPI_DOUBLE, all.data(), counts.data(), places.data(), MPI_DOUBLE,
                 world);
  std::sort(all.begin(), all.end(), [](const Newborn &a, const Newborn &b) {
    return std::tie(a.from, a.number) < std::tie(b.from, b.number);
  });

  tagint largest = 0, next;
  for (int i = 0; i < atom->nlocal; i++) largest = std::max(largest, atom->tag[i]);
  MPI_Allreduce(&largest, &next, 1, MPI_LMP_TAGINT, MPI_MAX, world);

  std::vector<tagint> ids;
  std::vector<int> types;
  std::vector<double> x, v;
  for (const Newborn &its : all) {
    ids.push_back(++next);
    types.push_back(static_cast<int>(its.type));
    x.insert(x.end(), its.x, its.x + 3);
    v.insert(v.end(), its.v, its.v + 3);
  }
  atom->nghost = 0;
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  const int before = atom->nlocal;
  const bigint others = present(), gone = atom->natoms - others;
  lammps_create_atoms(lmp, static_cast<int>(ids.size()), ids.data(), types.data(), x.data(),
                      v.data(), nullptr, 0);
  for (int i = before; i < atom->nlocal; i++) {
    const Newborn &its = all[std::lower_bound(ids.begin(), ids.end(), atom->tag[i]) - ids.begin()];
    atom->radius[i] = its.radius;
    atom->rmass[i] = density * Liquid::bubble_volume(its.radius);
    atom->mask[i] |= groupbit;
  }
  // who is born beyond an open face is lost, as any atom that passes it

  atom->natoms = others + gone + static_cast<bigint>(ids.size());
}

// Atoms that have left the box are not here.  LAMMPS finds out by its own number of all, so that only those that are
// born and taken out may change it.

bigint LiquidBirths::present() const
{
  bigint mine = atom->nlocal, all;
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

void LiquidBirths::remove(const std::vector<bool> &gone)
{
  const bigint before = present();
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  for (int i = atom->nlocal - 1; i >= 0; i--) {
    if (!gone[i]) continue;
    atom->avec->copy(atom->nlocal - 1, i, 1);
    atom->nlocal--;
  }
  atom->nghost = 0;
  atom->natoms -= before - present();
}
