/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_MEMORY_H
#define LMP_BUBBLE_MEMORY_H

#include "foam_history.h"

// What bubbles with inertia remember of their contacts, with each other and with walls

namespace Bubble {

using Foam::ContactRecords;

// h0 of a contact in its record, from one evaluation to the next.  Records are changed in place, and an evaluation of the
// same state changes nothing.  Contacts come in the order in which they are met, so that the next one is mostly the next
// in the record.  If a bubble has more contacts than its record has room for, it takes no forces, and is done again.

struct Films {
  ContactRecords records;
  bool kept = false;       // h0 is that of the record
  bool renewed = false;    // and the record follows
  bool again = false;      // for bubbles alone whose records were too small

  // One evaluation of a bubble.  The first n of its record are those met so far, the others may have come apart

  struct Met {
    int n = 0, count = 0, more = 0;
    double widest = 0.0;    // h0 of any
    FOAM_FUNCTION int needed() const { return count + more; }
  };

  FOAM_FUNCTION bool done(int i) const { return again && records.id(i) != 0.0; }
  FOAM_FUNCTION Met begin(int i) const
  {
    Met met;
    if (!kept) return met;
    met.count = static_cast<int>(records.count(i));
    for (int m = 0; m < met.count; m++)
      if (records.value(i, m, 0) > met.widest) met.widest = records.value(i, m, 0);
    return met;
  }
  FOAM_FUNCTION double of(int i, LAMMPS_NS::tagint partner, const Met &met) const
  {
    const double wanted = static_cast<double>(partner);
    for (int m = met.n; m < met.count; m++) {
      if (records.partner(i, m) != wanted) continue;
      const double h0 = records.value(i, m, 0);
      if (renewed && m > met.n) {
        move(i, met.n, m);
        put(i, met.n, wanted, h0);
      }
      return h0;
    }
    for (int m = 0; !renewed && m < met.n; m++)
      if (records.partner(i, m) == wanted) return records.value(i, m, 0);
    return 0.0;
  }
  FOAM_FUNCTION void keep(int i, LAMMPS_NS::tagint partner, double h0, double h_kept,
                          Met &met) const
  {
    if (!renewed) {
      if (h_kept > 0.0) met.n++;    // another image of the same partner has the next one
    } else if (h_kept == h0) {
      met.n++;
    } else if (h_kept > 0.0) {
      put(i, met.n++, static_cast<double>(partner), h0);
    } else if (met.count < records.slots) {
      move(i, met.n, met.count++);
      put(i, met.n++, static_cast<double>(partner), h0);
    } else {
      met.more++;
    }
  }
  FOAM_FUNCTION bool end(int i, LAMMPS_NS::tagint id, const Met &met) const    // was there room?
  {
    if (!renewed) return true;
    const double count = met.more ? met.count : met.n, mark = met.more ? 0.0 : id;
    if (records.count(i) != count) records.count(i) = count;
    if (records.id(i) != mark) records.id(i) = mark;
    return met.more == 0;
  }

 private:
  FOAM_FUNCTION void put(int i, int m, double partner, double h0) const
  {
    records.partner(i, m) = partner;
    records.value(i, m, 0) = h0;
  }
  FOAM_FUNCTION void move(int i, int from, int to) const
  {
    if (from != to) put(i, to, records.partner(i, from), records.value(i, from, 0));
  }
};

}    // namespace Bubble

#endif
