/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_CONTACT_BLOCKS_H
#define LMP_FOAM_CONTACT_BLOCKS_H

#include "foam_contacts.h"
#include "foam_vectors.h"

// A loop over contacts for one thread of a processor with wide vectors, where nothing but forces and what gas exchange
// needs is gathered: the numbers of ContactLoop, to the last bit.  It goes through listed pairs in blocks, and through
// each block three times.  Those that touch are put side by side, then evaluated, then added to the sums.  The first
// leaves no branch to be guessed; the second has the roots and divisions, and compilers do several pairs at a time.

// With two numbers in a vector, or none, this loop is slower than ContactLoop.

namespace Foam {

struct ContactBlock {
  static constexpr int SIZE = 248;    // fits into the nearest cache; columns no power of 2 apart
  int i[SIZE], j[SIZE];
  double del[3][SIZE], rsq[SIZE], Ri[SIZE], Rj[SIZE], stiffness[SIZE];
  double F_over_r[SIZE], area[SIZE], film[SIZE];
};

template <int D, unsigned WHAT, class Law>
FOAM_WIDE_VECTORS void evaluate_contacts(ContactBlock &c, int n, const Law &law)
{
  for (int m = 0; m < n; m++) {
    const double Ri = c.Ri[m], Rj = c.Rj[m], r = std::sqrt(c.rsq[m]);
    const double overlap = Ri + Rj - r;
    c.F_over_r[m] = law.force(c.stiffness[m], overlap, Ri, Rj) / r;
    if constexpr (WHAT & (FILM | AREA)) {
      double A = contact_area<D>(r, Ri, Rj);
      if (Law::BEYOND && !(overlap > 0.0)) A = 0.0;
      c.area[m] = A;
      if constexpr (WHAT & FILM) c.film[m] = film_exchange(A, Ri, Rj);
    }
  }
}

// Pairs of bubbles first[p] and second[p], in the order of rows.  The second has its share if it is one of those from
// begin to end: any other has its pairs in rows of its own, or is a ghost whose sums nobody asks for.

template <int D, unsigned WHAT, class Law, class B> struct ContactBlocks {
  static constexpr bool POSSIBLE = (WHAT & FORCE) && !(WHAT & ~(FORCE | FILM | AREA));
  B b;
  const int *first, *second;
  int count, begin, end;
  Law law;
  Coefficients coefficients;
  ContactSums sums;    // of all particles: they are bubbles

  void operator()() const
  {
    ContactBlock block;
    const double alike = coefficients.stiffness(1, 1);
    for (int m = 0; m < ContactBlock::SIZE; m++) block.stiffness[m] = alike;
    for (int p = 0; p < count; p += ContactBlock::SIZE) {
      const int size = count - p < ContactBlock::SIZE ? count - p : ContactBlock::SIZE;
      const int n = take(block, first + p, second + p, size);
      evaluate_contacts<D, WHAT>(block, n, law);
      add(block, n);
    }
  }

 private:
  int take(ContactBlock &c, const int *is, const int *js, int size) const
  {
    const B bubbles = b;
    const double range = law.range();
    const bool types = coefficients.ntypes > 1;
    int n = 0;
    for (int p = 0; p < size; p++) {
      const int i = is[p], j = js[p];
      const double Ri = bubbles.radius(i), Rj = bubbles.radius(j), reach = range * (Ri + Rj);
      double rsq = 0.0;
      for (int k = 0; k < D; k++) {
        const double d = bubbles.x(i, k) - bubbles.x(j, k);
        c.del[k][n] = d;
        rsq += d * d;
      }
      c.i[n] = i;
      c.j[n] = j;
      c.Ri[n] = Ri;
      c.Rj[n] = Rj;
      c.rsq[n] = rsq;
      if (types) c.stiffness[n] = coefficients.stiffness(bubbles.type(i), bubbles.type(j));
      n += (rsq < reach * reach) & (Ri > 0.0) & (Rj > 0.0);
    }
    return n;
  }

  void add(const ContactBlock &c, int n) const
  {
    const B bubbles = b;
    const ContactSums s = sums;
    for (int m = 0; m < n; m++) {
      const int i = c.i[m], j = c.j[m];
      const bool both = j >= begin && j < end;
      double F[3];
      for (int k = 0; k < D; k++) F[k] = c.F_over_r[m] * c.del[k][m];
      if (!(c.rsq[m] > 0.0)) {    // as in ContactLoop
        for (int k = 0; k < D; k++) F[k] = 0.0;
        F[0] = coincident_sign(bubbles.tag(i), bubbles.tag(j)) *
               law.force(c.stiffness[m], c.Ri[m] + c.Rj[m], c.Ri[m], c.Rj[m]);
      }
      for (int k = 0; k < D; k++) bubbles.f(i, k) += F[k];
      if (both)
        for (int k = 0; k < D; k++) bubbles.f(j, k) -= F[k];
      if constexpr (WHAT & AREA) {
        s.area[i] += c.area[m];
        if (both) s.area[j] += c.area[m];
      }
      if constexpr (WHAT & FILM) {
        s.film[i] += c.film[m];
        if (both) s.film[j] -= c.film[m];
      }
    }
  }
};

}    // namespace Foam

#endif
