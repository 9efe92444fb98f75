/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_HISTORY_H
#define LMP_FOAM_HISTORY_H

#include "foam_columns.h"
#include "foam_physics.h"
#include "lmptype.h"

#include <mpi.h>

namespace Foam {

// The contacts of each bubble as its own record: its ID, their number, and for each the ID of the partner
// and values.  Both partners have a record of their contact and keep up their own, so that nothing is
// atomic and ghosts have nothing to send back: values are the same on both sides, or opposite.
// Two bubbles have one contact, even if they touch through more than one periodic image.

struct ContactRecords {
  double *first;    // columns, one after the other
  size_t rows;
  int slots;     // room for so many contacts of a bubble
  int values;    // of each contact

  enum { ID, COUNT, HEAD };
  FOAM_FUNCTION double &at(int c, int i) const { return first[c * rows + i]; }
  FOAM_FUNCTION double &id(int i) const { return at(ID, i); }
  FOAM_FUNCTION double &count(int i) const { return at(COUNT, i); }
  FOAM_FUNCTION double &partner(int i, int m) const { return at(HEAD + m * (1 + values), i); }
  FOAM_FUNCTION double &value(int i, int m, int k) const
  {
    return at(HEAD + m * (1 + values) + 1 + k, i);
  }

  FOAM_FUNCTION int find(int i, LAMMPS_NS::tagint id) const    // its slot, or -1
  {
    const int n = static_cast<int>(count(i)), kept = n < slots ? n : slots;
    for (int m = 0; m < kept; m++)
      if (partner(i, m) == static_cast<double>(id)) return m;
    return -1;
  }

  // a new one; -1 where there is no room: the count goes on, and tells how much is needed

  FOAM_FUNCTION int add(int i, LAMMPS_NS::tagint id) const
  {
    const int m = static_cast<int>(count(i));
    count(i) = m + 1;
    if (m >= slots) return -1;
    partner(i, m) = static_cast<double>(id);
    return m;
  }
};

}    // namespace Foam

namespace LAMMPS_NS {

// What goes with the steps of an integrator, though it is no part of its state.  A step is attempted from
// the state accepted last, perhaps again and again: what an attempt finds is on trial, and replaces
// what was found by the one before.

class FoamFollower {
 public:
  // forces have been evaluated in an attempt, so much later than the last accepted state

  virtual void attempted(double later) = 0;

  // the state so much later is accepted; its ghosts, lists and forces are up to date. Will anything
  // look at the bubbles in this step?

  virtual void accepted(double step, bool output_due) = 0;

 protected:
  ~FoamFollower() = default;    // nobody owns one as such
};

// Storage of numbers of contacts, with commit and rollback: a trial is made of what was committed, and
// takes its place by commit(); without, nothing has happened.  What is committed travels with the bubbles
// and stands in restart files.

class FoamHistory {
 public:
  enum : unsigned { STAYS = 1, TRAVELS = 2 };    // as in FixFoamTravelling
  using Records = Foam::ContactRecords;

  FoamHistory(FoamColumnList &all, int values_of_a_contact)
      : values(values_of_a_contact), all_columns(all)
  {
  }

  void use(int nmax)
  {
    committed.use(nmax);
    trial.use(nmax);
  }
  void commit() { committed.swap(trial); }
  template <class Space> Records records(Space &space, FoamColumns &columns) const
  {
    return {space.column(columns, 0), static_cast<size_t>(columns.rows()), room, values};
  }

  int slots() const { return room; }
  void make_room(int most)    // for so many contacts of a bubble, with some to spare
  {
    if (most > room) widen(most + most / 4);
  }
  void agree(MPI_Comm world)    // before bubbles travel: those on a device have records of one size
  {
    int all;
    MPI_Allreduce(&room, &all, 1, MPI_INT, MPI_MAX, world);
    if (all > room) widen(all);
  }

  // the record of a bubble on the host, no longer than needed: it fits whatever room there is elsewhere

  int most() const { return committed.capacity(); }
  int size(int i) { return width(static_cast<int>(committed[Records::COUNT][i])); }
  int pack(int i, double *buf)
  {
    const int n = size(i);
    for (int c = 0; c < n; c++) buf[c] = committed[c][i];
    return n;
  }
  int unpack(int i, const double *buf)
  {
    const int count = static_cast<int>(buf[Records::COUNT]), n = width(count);
    make_room(count);
    for (int c = 0; c < n; c++) committed[c][i] = buf[c];
    return n;
  }

 private:
  const int values;
  int room = 8;
  FoamColumnList &all_columns;

  int width(int contacts) const { return Records::HEAD + contacts * (1 + values); }
  void widen(int slots)
  {
    room = slots;
    committed.widen(width(room));
    trial.widen(width(room));
  }

 public:
  FoamColumns committed{all_columns, "contact records", width(room), TRAVELS};
  FoamColumns trial{all_columns, "contact records on trial", width(room), STAYS};
};

}    // namespace LAMMPS_NS

#endif
