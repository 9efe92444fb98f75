/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_CONTACTS_H
#define LMP_FOAM_CONTACTS_H

#include "foam_bubbles.h"
#include "foam_law.h"

// The one loop over contacts, for base and KOKKOS styles: forces by a contact law (foam_law.h), and beside
// them, in the same pass, what drag and gas exchange need.

namespace Foam {

struct Coefficients {
  const double *sigma0;    // of a pair of types, [ntypes+1][ntypes+1]
  int ntypes;
  double Rin;
  FOAM_FUNCTION double stiffness(int itype, int jtype) const
  {
    return sigma0[itype * (ntypes + 1) + jtype] * Rin;
  }
};

struct NoTally {
  static constexpr bool ON = false;
  template <class... Any> FOAM_FUNCTION explicit NoTally(const Any &...) {}
};

// List gives a row for bubble number n of the loop: its index, row.i, and
//   row.for_each(visit)    calls visit(j, both) for each of its partners j; both: this is the only
//                          time that the pair occurs, so both get their share
//
// Tally, if ON, is told the energy and the force of each pair.
// A bubble's own sums are added to what is there, or, if ASSIGN, take its place.

template <int D, unsigned WHAT, bool ASSIGN, class Law, class B, class List, class Tally>
struct ContactLoop {
  B b;
  List list;
  Law law;
  Coefficients coefficients;
  ContactSums sums;
  bool forces_add;    // even then
  unsigned what;      // if WHAT has ANY

  FOAM_FUNCTION unsigned asked() const
  {
    if constexpr (WHAT & ANY)
      return what;
    else
      return WHAT;
  }

  FOAM_ALWAYS_INLINE void operator()(int n, Tally &tally) const
  {
    // numbers are written through pointers that might, for all the compiler knows, point to members
    // of this functor: what the inner loop reads is taken out of it

    const unsigned wanted = asked();
    auto gathers = [wanted](unsigned flags) FOAM_INLINE_LAMBDA {
      return (wanted & flags) != 0;
    };
    const auto row = list.row(n);
    const ContactSums s = sums;
    const Law force_law = law;
    const double range = force_law.range();
    const double Rin = coefficients.Rin;
    const int i = row.i;
    const double Ri = b.radius(i);
    const double xi[3] = {b.x(i, 0), b.x(i, 1), D == 3 ? b.x(i, 2) : 0.0};
    const double *const sigma0_i =
        coefficients.ntypes == 1 ? nullptr
                                 : coefficients.sigma0 + b.type(i) * (coefficients.ntypes + 1);
    const double sigma0 = coefficients.sigma0[coefficients.ntypes + 2];    // of types 1 and 1
    [[maybe_unused]] const bool member_i = s.members(i), others = s.members.mask;

    // sums go on from what is there, so that each is made in the order of the pairs, of which rows i is

    const bool forces_go_on = !ASSIGN || forces_add;
    auto there = [&](unsigned flag, const double *sum) FOAM_INLINE_LAMBDA {
      return !ASSIGN && gathers(flag) ? sum[i] : 0.0;
    };
    double fi[3] = {}, vsum_i[3] = {};
    if (gathers(FORCE) && forces_go_on)
      for (int k = 0; k < D; k++) fi[k] = b.f(i, k);
    for (int k = 0; k < D; k++) vsum_i[k] = there(VSUM, s.vsum[k]);
    double contacts_i = there(CONTACTS, s.contacts), area_i = there(AREA, s.area),
           film_i = there(FILM, s.film), espring_i = there(ENERGY, s.espring),
           edurian_i = there(ENERGY, s.edurian);

    auto visit = [&](int j, auto both) FOAM_INLINE_LAMBDA {
      const double Rj = b.radius(j);
      const double Rsum = Ri + Rj;
      const double del[3] = {xi[0] - b.x(j, 0), xi[1] - b.x(j, 1),
                             D == 3 ? xi[2] - b.x(j, 2) : 0.0};
      const double rsq = del[0] * del[0] + del[1] * del[1] + del[2] * del[2];
      const double reach = range * Rsum;
      if (!(rsq < reach * reach) || !(Rj > 0.0)) return;

      const double r = std::sqrt(rsq);
      const double overlap = Rsum - r;    // negative beyond contact
      const double sigma = sigma0_i ? sigma0_i[b.type(j)] : sigma0;

      // each takes its share, j only if the pair is not in a row of its own

      if (gathers(FORCE)) {
        const double F = force_law.force(sigma * Rin, overlap, Ri, Rj);
        double F_xyz[3] = {};
        double F_over_r = 0.0;    // stays 0 at r = 0, where force and virial have no direction
        if (r > 0.0) {
          F_over_r = F / r;
          for (int k = 0; k < D; k++) F_xyz[k] = F_over_r * del[k];
        } else
          F_xyz[0] = coincident_sign(b.tag(i), b.tag(j)) * F;
        if constexpr (Tally::ON)
          tally.pair(i, j, both, force_law.energy(sigma * Rin, overlap, Ri, Rj), F_over_r, del);
        for (int k = 0; k < D; k++) fi[k] += F_xyz[k];
        if (both)
          for (int k = 0; k < D; k++) b.f(j, k) -= F_xyz[k];
      }
      if (gathers(ENERGY)) {
        const double half_spring = 0.5 * force_law.energy(sigma * Rin, overlap, Ri, Rj);
        const double durian = !Law::BEYOND || overlap > 0.0 ? durian_energy(sigma, overlap) : 0.0;
        espring_i += half_spring;
        edurian_i += durian;
        if (both) {
          s.espring[j] += half_spring;
          s.edurian[j] += durian;
        }
      }

      // the rest is between bubbles in contact

      if (Law::BEYOND && !(overlap > 0.0)) return;
      if (!gathers(CONTACTS | VSUM | FILM | AREA)) return;
      if (others && !(member_i && s.members(j))) return;
      if (gathers(CONTACTS)) {
        contacts_i += 1.0;
        if (both) s.contacts[j] += 1.0;
      }
      if (gathers(VSUM))
        for (int k = 0; k < D; k++) {
          if constexpr (WHAT & GIVEN) {
            const double difference = s.given[k][j] - s.given[k][i];
            vsum_i[k] += difference;
            if (both) s.vsum[k][j] -= difference;
          } else {
            vsum_i[k] += b.v(j, k);
            if (both) s.vsum[k][j] += b.v(i, k);
          }
        }
      if (gathers(FILM | AREA)) {
        const double A = contact_area<D>(r, Ri, Rj);
        if (gathers(AREA)) {
          area_i += A;
          if (both) s.area[j] += A;
        }
        if (gathers(FILM)) {
          const double exchange = film_exchange(A, Ri, Rj);
          film_i += exchange;
          if (both) s.film[j] -= exchange;
        }
      }
    };
    if (Ri > 0.0) row.for_each(visit);    // the dead touch nobody

    if constexpr (ASSIGN) s.clear(i, wanted);
    if (gathers(FORCE))
      for (int k = 0; k < (forces_go_on ? D : 3); k++) b.f(i, k) = fi[k];
    if (gathers(CONTACTS)) s.contacts[i] = contacts_i;
    if (gathers(VSUM))
      for (int k = 0; k < D; k++) s.vsum[k][i] = vsum_i[k];
    if (gathers(FILM)) s.film[i] = film_i;
    if (gathers(AREA)) s.area[i] = area_i;
    if (gathers(ENERGY)) {
      s.espring[i] = espring_i;
      s.edurian[i] = edurian_i;
    }
  }
};

}    // namespace Foam

#endif
