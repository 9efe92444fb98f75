/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_AGES_H
#define LMP_FOAM_AGES_H

#include "foam_bubbles.h"
#include "foam_history.h"

// How long contacts have lasted: functors of fix foam/contacts

namespace Foam {

enum { AGE, AGE_VALUES };                                 // of a contact
enum { SHOWN_COUNT, SHOWN_OLDEST, SHOWN_MEAN, SHOWN };    // of a bubble

struct ContactTotals {
  FoamSum formed, present, ages;    // contacts that are new, all of them, their ages
  FoamMax most, oldest;             // contacts of a bubble; age
  FOAM_FUNCTION void join(const ContactTotals &other)
  {
    formed.join(other.formed);
    present.join(other.present);
    ages.join(other.ages);
    most.join(other.most);
    oldest.join(other.oldest);
  }
};

// Those of a state, so much later than the contacts before: who touched then is older, others are new.
// Rows of pairs are in chunks, see FoamRows; bubbles of a chunk are the work of one thread.  Contacts are those
// of ContactLoop.

template <class B, class List> struct FollowContacts {
  static constexpr const char *NAME = "foam: ages of contacts";
  B b;
  List list;
  Members member;
  ContactRecords before, now;
  double later;
  int nrows, nlocal, chunk;
  bool flat, images;    // may two bubbles touch through more than one image

  FOAM_FUNCTION void operator()(int c, ContactTotals &all) const
  {
    const int begin = c * chunk, end = begin + chunk < nlocal ? begin + chunk : nlocal;
    for (int i = begin; i < end; i++) {
      now.id(i) = static_cast<double>(b.tag(i));
      now.count(i) = 0.0;
    }
    for (int n = begin; n < end && n < nrows; n++) {
      const auto row = list.row(n);
      const int i = row.i;
      if (!(b.radius(i) > 0.0) || !member(i)) continue;    // the dead touch nobody
      row.for_each([&](int j, auto both) {
        if (touch(i, j) && member(j)) meet(i, j, both, all);
      });
    }
    for (int i = begin; i < end; i++) all.most.raise(now.count(i));
  }

  FOAM_FUNCTION bool touch(int i, int j) const
  {
    const double Rj = b.radius(j), Rsum = b.radius(i) + Rj;
    const double del[3] = {b.x(i, 0) - b.x(j, 0), b.x(i, 1) - b.x(j, 1),
                           flat ? 0.0 : b.x(i, 2) - b.x(j, 2)};
    return del[0] * del[0] + del[1] * del[1] + del[2] * del[2] < Rsum * Rsum && Rj > 0.0;
  }

  // partners keep the same age, so one of them tells

  FOAM_FUNCTION void meet(int i, int j, bool both, ContactTotals &all) const
  {
    const LAMMPS_NS::tagint id_i = b.tag(i), id_j = b.tag(j);
    if (id_i == id_j) return;                               // a bubble and its own image
    const bool i_has = images && now.find(i, id_j) >= 0;    // by another image
    const bool j_has = !both || (images && now.find(j, id_i) >= 0);
    if (i_has && j_has) return;
    const int was = before.find(i, id_j);
    const double age = was < 0 ? 0.0 : before.value(i, was, AGE) + later;
    if (!i_has) keep(i, id_i, id_j, was < 0, age, all);
    if (!j_has) keep(j, id_j, id_i, was < 0, age, all);
  }

  // sums take a contact once, from the partner with the lower ID

  FOAM_FUNCTION void keep(int i, LAMMPS_NS::tagint own, LAMMPS_NS::tagint other, bool is_new,
                          double age, ContactTotals &all) const
  {
    const int m = now.add(i, other);
    if (m >= 0) now.value(i, m, AGE) = age;
    if (other < own) return;
    if (is_new) all.formed += 1.0;
    all.present += 1.0;
    all.ages += age;
    all.oldest.raise(age);
  }
};

struct ShowAges {
  static constexpr const char *NAME = "foam: ages of each bubble's contacts";
  ContactRecords records;
  double *shown[SHOWN];

  FOAM_FUNCTION void operator()(int i) const
  {
    double values[SHOWN];
    fill(i, values);
    for (int k = 0; k < SHOWN; k++) shown[k][i] = values[k];
  }
  FOAM_FUNCTION void fill(int i, double *values) const
  {
    const int n = static_cast<int>(records.count(i));
    double oldest = 0.0, sum = 0.0;
    for (int m = 0; m < n; m++) {
      const double age = records.value(i, m, AGE);
      if (age > oldest) oldest = age;
      sum += age;
    }
    values[SHOWN_COUNT] = n;
    values[SHOWN_OLDEST] = oldest;
    values[SHOWN_MEAN] = n > 0 ? sum / n : 0.0;
  }
};

}    // namespace Foam

#endif
