/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_records.h"

#include "atom.h"
#include "comm.h"
#include "memory.h"

using namespace LAMMPS_NS;

FixFoamRecords::FixFoamRecords(LAMMPS *lmp, int narg, char **arg, int values_of_a_contact)
    : FixFoamTravelling(lmp, narg, arg), history(all_columns, values_of_a_contact)
{
  size_peratom_cols = 0;
  maxexchange = exchange_foreseen = history.most();
}

void FixFoamRecords::keep_records()
{
  grow_arrays(atom->nmax);
  for (int i = 0; i < atom->nlocal; i++) set_arrays(i);
  add_callbacks();
}

FixFoamRecords::~FixFoamRecords()
{
  memory->destroy(array_atom);
}

void FixFoamRecords::make_room(int most)
{
  history.make_room(most);
  maxexchange = history.most();    // a fix may take out bubbles before pre_exchange()
}

// LAMMPS' buffers have room for an exchanged bubble as it was at Comm::init(), and 1024 numbers to spare.
// (With maxexchange_dynamic those of comm_style tiled would grow at each exchange.)

void FixFoamRecords::pre_exchange()
{
  history.agree(world);
  maxexchange = history.most();
  if (maxexchange > exchange_foreseen + 512) {
    exchange_foreseen = maxexchange;
    comm->init();
  }
}

void FixFoamRecords::setup_pre_exchange()
{
  pre_exchange();
}

void FixFoamRecords::min_pre_exchange()
{
  pre_exchange();
}

/* ----------------------------------------------------------------------
   records travel with the bubbles
------------------------------------------------------------------------- */

void FixFoamRecords::grow_arrays(int nmax)
{
  history.committed.use(nmax);
  if (size_peratom_cols) memory->grow(array_atom, MAX(1, nmax), size_peratom_cols, "foam:records");
}

void FixFoamRecords::copy_arrays(int i, int j, int)
{
  history.committed.copy(i, j);
  for (int k = 0; k < size_peratom_cols; k++) array_atom[j][k] = array_atom[i][k];
}

void FixFoamRecords::set_arrays(int i)    // a new bubble
{
  history.committed.clear(i);
  for (int k = 0; k < size_peratom_cols; k++) array_atom[i][k] = 0.0;
}

int FixFoamRecords::pack_exchange(int i, double *buf)
{
  return history.pack(i, buf);
}

int FixFoamRecords::unpack_exchange(int i, double *buf)
{
  const int n = history.unpack(i, buf);
  maxexchange = history.most();
  look_at(i);
  return n;
}

int FixFoamRecords::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  return 1 + history.pack(i, buf + 1);
}

void FixFoamRecords::unpack_restart(int i, int nth)
{
  history.unpack(i, of_restart(atom, i, nth));
  maxexchange = history.most();
  look_at(i);
}

int FixFoamRecords::size_restart(int i)
{
  return 1 + history.size(i);
}

int FixFoamRecords::maxsize_restart()
{
  return 1 + history.most();
}

double FixFoamRecords::memory_usage()
{
  return FixFoamTravelling::memory_usage() +
         sizeof(double) * double(atom->nmax) * size_peratom_cols;
}
