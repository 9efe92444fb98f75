/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_COLLISION_H
#define LMP_BUBBLE_COLLISION_H

#include "bubble_film.h"
#include "bubble_memory.h"
#include "foam_bubbles.h"

#include <cmath>
#include <type_traits>

// What happens where two bubbles, or a bubble and a wall, are close: the model as the user has chosen it, and the loops
// over pairs and walls.  Formulae: bubble_physics.h.

namespace Bubble {

enum class Elastic { NONE, SPRING, QUADRATIC };
enum class Viscous { NONE, PUBLISHED, DERIVED };
enum class Stop {
  CONTACT,
  CURRENT,
  GIVEN
};    // h0: kept by each contact, of the present speed, a number

// Where steps are chosen: no gap closes by more than this part of itself in one, and no bubble moves by more than this
// part of its radius

constexpr double CLOSED_IN_A_STEP = 0.2, MOVED_IN_A_STEP = 0.1;

struct Collision {
  double sigma = 0.0, mu = 0.0;
  Elastic elastic = Elastic::QUADRATIC;
  Viscous viscous = Viscous::PUBLISHED;
  FilmTable integral{};    // of the film; none: the fit
  Stop stop = Stop::CONTACT;
  double h0 = 0.0, hmin = 0.0;
  bool film = true;           // the elastic force begins at h0, else where surfaces meet
  bool lubrication = true;    // where the gap is wider than h0
  double reach = -1.0;        // of it, in R; < 0: not given, 1
  bool slides = false;        // force along the surface

  // No force beyond this gap.  Unless a reach is given, gaps are seen in which a film may close within the next step.

  FOAM_FUNCTION double range(const Gap &gap) const { return farthest(gap.mean, gap.Ri + gap.Rj); }
  FOAM_FUNCTION double longest(double sum) const    // for all pairs with this sum of radii
  {
    return farthest(0.5 * sum, sum);
  }
  FOAM_FUNCTION double of_lubrication() const { return reach < 0.0 ? 1.0 : reach; }    // in R

 private:
  FOAM_FUNCTION double farthest(double mean, double sum) const
  {
    const bool film_alone = reach < 0.0 && !lubrication && stop == Stop::GIVEN;
    double end = film_alone ? 0.0 : of_lubrication();
    if (slides && end < 1.0) end = 1.0;    // sliding ends at R
    double film = h0 > hmin ? h0 : hmin;
    if (reach < 0.0)
      film += 1.5 * MOVED_IN_A_STEP * sum;    // half as much again: speeds change within a step
    return end * mean > film ? end * mean : film;
  }
};

// Forces along the normal are > 0 where they push apart

struct Meeting {
  bool closed = false;    // the gap is narrower than h0
  double h0 = 0.0, overlap = 0.0;
  double elastic = 0.0;
  double viscous = 0.0, lubrication = 0.0, sliding = 0.0;    // coefficients of speeds
  double friction = 0.0;    // the largest coefficient within the next step
};

// Does the gap become a film, and how thick is that?  h_kept: h0 of this contact, if it has one; it is lost where the gap
// is wider.  No root is taken where the gap is wide.

FOAM_ALWAYS_INLINE void close(const Collision &c, const Gap &gap, double width, double u,
                              double h_kept, Meeting &m)
{
  m.h0 = c.hmin;
  if (c.stop == Stop::GIVEN) {
    m.h0 = c.h0;
  } else if (c.stop == Stop::CONTACT && h_kept > 0.0 && width < h_kept) {
    m.h0 = h_kept;
  } else {
    const double square =
        film_thickness_squared(c.sigma, c.mu, c.stop == Stop::CURRENT ? std::fabs(u) : u, gap);
    if ((width < 0.0 || width * width < square) && c.hmin * c.hmin < square)
      m.h0 = std::sqrt(square);
  }
  m.closed = width < m.h0;
}

FOAM_FUNCTION void deform(const Collision &c, const Gap &gap, double overlap, Meeting &m)
{
  if (c.elastic == Elastic::SPRING) {
    m.elastic = spring_force(c.sigma, gap.wall ? overlap : 0.5 * overlap);
  } else if (c.elastic == Elastic::QUADRATIC) {
    m.elastic = c.sigma * (gap.wall ? elastic_force(1.0, overlap, gap.Ri)
                                    : in_series(overlap, gap.Ri, gap.Rj));
  }
}

FOAM_FUNCTION double film_coefficient(const Collision &c, const Gap &gap, double overlap,
                                      double thickness)
{
  const double x = (gap.wall ? 1.0 : 0.5) * overlap / gap.mean;
  const double h = thickness / gap.mean, a = film_radius(x);
  return film_viscous(c.mu, film_growth(x), c.viscous == Viscous::DERIVED,
                      c.integral.first ? c.integral(h, a) : film_fit(h, a), gap);
}

FOAM_ALWAYS_INLINE Meeting meet(const Collision &c, const Gap &gap, double width, double u,
                                double h_kept)
{
  Meeting m;
  close(c, gap, width, u, h_kept, m);
  if (m.closed) {
    const double overlap = (c.film ? m.h0 : 0.0) - width;
    if (overlap > 0.0) {
      m.overlap = overlap;
      deform(c, gap, overlap, m);
    }
    if (c.viscous != Viscous::NONE) m.viscous = film_coefficient(c, gap, m.overlap, m.h0);
  } else if (c.lubrication && width < c.of_lubrication() * gap.mean) {
    m.lubrication = lubrication(c.mu, width, gap);
  }
  if (c.slides) m.sliding = sliding(c.mu, width > c.hmin ? width : c.hmin, gap.mean);
  m.friction = m.viscous + m.lubrication + m.sliding;

  // The next step may close the film, whose friction is up to 30 times that of the liquid before

  if (!m.closed && c.viscous != Viscous::NONE && width * (1.0 - CLOSED_IN_A_STEP) < m.h0)
    m.friction += film_coefficient(c, gap, 0.0, m.h0);
  return m;
}

// What is looked at now and then only: energy of the deformed surfaces, deformation and film of bubble i

struct Surfaces {
  double energy = 0.0, Delta = 0.0, Ra = 0.0;
};

FOAM_FUNCTION Surfaces surfaces(const Collision &c, const Gap &gap, const Meeting &m)
{
  Surfaces s;
  if (!m.closed) return s;
  s.Delta = gap.wall ? m.overlap : 0.5 * m.overlap;
  if (c.elastic == Elastic::SPRING) {
    s.energy = (gap.wall ? 1.0 : 2.0) * spring_energy(c.sigma, s.Delta);
  } else if (c.elastic == Elastic::QUADRATIC) {
    if (!gap.wall) s.Delta = deformation(m.elastic / c.sigma, gap.Ri);
    s.energy = elastic_energy(c.sigma, s.Delta, gap.Ri);
    if (!gap.wall)
      s.energy += elastic_energy(c.sigma, deformation(m.elastic / c.sigma, gap.Rj), gap.Rj);
  }
  s.Ra = gap.Ri * film_radius(s.Delta / gap.Ri);
  return s;
}

// between pairs of bubbles, see Foam::ComesNear

struct ReachOfCollision {
  Collision model;
  FOAM_FUNCTION double operator()(double sum) const { return sum + model.longest(sum); }
};

// ---------------------------------------------------------------------- what is known of all of them

struct CollisionRates {      // always
  Foam::FoamMax most;        // contacts of a bubble
  Foam::FoamMax closing;     // 1 / time in which a gap closes, as it does now
  Foam::FoamMax friction;    // of a bubble in all its gaps: force per speed and volume
  FOAM_FUNCTION void join(const CollisionRates &other)
  {
    most.join(other.most);
    closing.join(other.closing);
    friction.join(other.friction);
  }
};

struct CollisionTotals : CollisionRates {    // where energies and stresses are asked for
  Foam::FoamSum energy, viscous, lubrication, sliding;    // powers: work done on the bubbles
  Foam::FoamSum closed;                                   // contacts
  Foam::FoamSum xx, yy, zz, xy, xz, yz;                   // sums of r f
  using CollisionRates::join;
  FOAM_FUNCTION void join(const CollisionTotals &other)
  {
    CollisionRates::join(other);
    energy.join(other.energy);
    viscous.join(other.viscous);
    lubrication.join(other.lubrication);
    sliding.join(other.sliding);
    closed.join(other.closed);
    xx.join(other.xx);
    yy.join(other.yy);
    zz.join(other.zz);
    xy.join(other.xy);
    xz.join(other.xz);
    yz.join(other.yz);
  }
};

// Columns that users look at: sums of forces by each term, and the closest contact

enum Look {
  ELASTIC,
  VISCOUS = ELASTIC + 3,
  LUBRICATION = VISCOUS + 3,
  SLIDING = LUBRICATION + 3,
  CONTACTS = SLIDING + 3,
  DELTA,
  RA,
  H0,
  ENERGY,
  LOOKS
};

struct Looks {
  double *column[LOOKS]{};
  FOAM_FUNCTION void clear(int i) const
  {
    for (int k = 0; k < LOOKS; k++) column[k][i] = 0.0;
  }
};

// One bubble and one partner: the force, and, where TALLY, what is to be known of it.  half: the partner has the other
// half.

template <class B, bool TALLY> struct Encounter {
  using Totals = std::conditional_t<TALLY, CollisionTotals, CollisionRates>;
  Collision model;
  Looks looks;
  bool looked;

  // n: unit vector from the partner to bubble i; u: velocity of i relative to the partner

  FOAM_FUNCTION Meeting operator()(int i, const Gap &gap, double width, const double *n,
                                   const double *u, double h_kept, double *force, Totals &all) const
  {
    const double un = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
    const Meeting m = meet(model, gap, width, -un, h_kept);
    const double push = m.elastic - (m.viscous + m.lubrication - m.sliding) * un;
    for (int k = 0; k < 3; k++) force[k] = push * n[k] - m.sliding * u[k];
    if (un < 0.0) all.closing.raise(-un / (width > m.h0 ? width : closed_scale(gap)));
    if constexpr (TALLY) tally(i, gap, m, n, u, un, all);
    return m;
  }

  // a film is no singularity: within a step the bubbles come closer by a part of this

  FOAM_FUNCTION static double closed_scale(const Gap &gap) { return 0.1 * gap.mean; }

  FOAM_FUNCTION void tally(int i, const Gap &gap, const Meeting &m, const double *n,
                           const double *u, double un, CollisionTotals &all) const
  {
    const double half = gap.wall ? 1.0 : 0.5;
    const Surfaces s = surfaces(model, gap, m);
    double slip = 0.0;
    for (int k = 0; k < 3; k++) {
      const double ut = u[k] - un * n[k];
      slip += ut * ut;
      if (looked) {
        looks.column[ELASTIC + k][i] += m.elastic * n[k];
        looks.column[VISCOUS + k][i] -= m.viscous * un * n[k];
        looks.column[LUBRICATION + k][i] -= m.lubrication * un * n[k];
        looks.column[SLIDING + k][i] -= m.sliding * ut;
      }
    }
    all.energy += half * s.energy;
    all.viscous += -half * m.viscous * un * un;
    all.lubrication += -half * m.lubrication * un * un;
    all.sliding += -half * m.sliding * slip;
    if (!m.closed) return;
    all.closed += half;
    if (!looked) return;
    looks.column[CONTACTS][i] += 1.0;
    looks.column[ENERGY][i] += half * s.energy;
    if (looks.column[H0][i] > 0.0 && !(s.Delta > looks.column[DELTA][i])) return;
    looks.column[DELTA][i] = s.Delta;
    looks.column[RA][i] = s.Ra;
    looks.column[H0][i] = m.h0;
  }
};

// Pairs: each bubble has all its partners in its row of the list, and takes its own forces alone

template <class B, class List, bool TALLY> struct Collide {
  static constexpr const char *NAME = "bubble: collide";
  B b;
  List list;
  Encounter<B, TALLY> encounter;
  Films films;
  bool moves = true;      // adds the forces to those of LAMMPS
  double *virial[6]{};    // of each bubble, where it is asked for

  using Totals = typename Encounter<B, TALLY>::Totals;

  FOAM_FUNCTION void operator()(int n, Totals &all) const
  {
    const auto row = list.row(n);
    const int i = row.i;
    if (films.done(i)) return;
    if constexpr (TALLY)
      if (encounter.looked) encounter.looks.clear(i);
    const Self self(b, i);
    Sum mine;
    mine.met = films.begin(i);
    row.for_each([&](int j, auto) FOAM_INLINE_LAMBDA { pass(self, j, mine); });

    all.most.raise(mine.met.needed());
    if (!films.end(i, b.tag(i), mine.met)) return;
    if (moves)
      for (int k = 0; k < 3; k++) b.f(i, k) += mine.force[k];
    all.friction.raise(mine.coefficient / volume(self.R));
    all.join(mine);
    if constexpr (TALLY) {
      const double v[6] = {mine.xx, mine.yy, mine.zz, mine.xy, mine.xz, mine.yz};
      if (virial[0])
        for (int k = 0; k < 6; k++) virial[k][i] = v[k];
    }
  }

 private:
  struct Self {    // the bubble, read once for all its partners
    int i;
    double R, x[3], v[3];
    FOAM_FUNCTION Self(const B &b, int n) : i(n), R(b.radius(n))
    {
      for (int k = 0; k < 3; k++) {
        x[k] = b.x(n, k);
        v[k] = b.v(n, k);
      }
    }
  };
  struct Sum : Totals {
    double force[3] = {0.0, 0.0, 0.0}, coefficient = 0.0;    // the latter of friction
    Films::Met met;
  };

  FOAM_ALWAYS_INLINE void pass(const Self &self, int j, Sum &mine) const
  {
    double r[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
      r[k] = self.x[k] - b.x(j, k);
      square += r[k] * r[k];
    }
    const double Rj = b.radius(j), sum = self.R + Rj;
    const double most = sum + encounter.model.longest(sum);
    if (square < most * most) near(self, j, Gap::to_bubble(self.R, Rj), r, std::sqrt(square), mine);
  }

  FOAM_ALWAYS_INLINE void near(const Self &self, int j, const Gap &gap, const double *r,
                               double distance, Sum &mine) const
  {
    const double width = distance - (gap.Ri + gap.Rj);
    if (!(width < encounter.model.range(gap))) return;
    const int i = self.i;
    double u[3], unit[3], force[3];
    const double inverse = 1.0 / distance;
    for (int k = 0; k < 3; k++) {
      unit[k] = r[k] * inverse;
      u[k] = self.v[k] - b.v(j, k);
    }
    if (!(distance > 0.0)) {    // coincident: apart along x
      unit[0] = b.tag(i) > b.tag(j) ? 1.0 : -1.0;
      unit[1] = unit[2] = 0.0;
    }
    const double h_kept = width < mine.met.widest ? films.of(i, b.tag(j), mine.met) : 0.0;
    const Meeting m = encounter(i, gap, width, unit, u, h_kept, force, mine);
    if (m.closed) films.keep(i, b.tag(j), m.h0, h_kept, mine.met);
    for (int k = 0; k < 3; k++) mine.force[k] += force[k];
    mine.coefficient += m.friction;
    if constexpr (TALLY) {
      mine.xx += 0.5 * r[0] * force[0];
      mine.yy += 0.5 * r[1] * force[1];
      mine.zz += 0.5 * r[2] * force[2];
      mine.xy += 0.5 * r[0] * force[1];
      mine.xz += 0.5 * r[0] * force[2];
      mine.yz += 0.5 * r[1] * force[2];
    }
  }
};

// A plane.  It has no ID: partner 0 in the records.  Forces are those on the wall, > 0 along the axes.

struct WallTotals : CollisionTotals {
  Foam::FoamSum fx, fy, fz;
  FOAM_FUNCTION void join(const WallTotals &other)
  {
    CollisionTotals::join(other);
    fx.join(other.fx);
    fy.join(other.fy);
    fz.join(other.fz);
  }
};

template <class B> struct MeetPlane {
  static constexpr const char *NAME = "bubble: meet plane";
  B b;
  double place[3], normal[3];
  Encounter<B, true> encounter;
  Films films;
  bool moves = true;

  FOAM_FUNCTION void operator()(int i, WallTotals &all) const
  {
    if (films.done(i)) return;
    double height = 0.0;
    for (int k = 0; k < 3; k++) height += (b.x(i, k) - place[k]) * normal[k];
    Films::Met met = films.begin(i);
    touch(i, height, normal, 0, met, all);
    films.end(i, b.tag(i), met);
  }

  // distance of the centre from the wall, unit vector to it

  FOAM_FUNCTION void touch(int i, double distance, const double *unit, LAMMPS_NS::tagint id,
                           Films::Met &met, WallTotals &all) const
  {
    const Gap gap = Gap::to_wall(b.radius(i));
    const double width = distance - gap.Ri, u[3] = {b.v(i, 0), b.v(i, 1), b.v(i, 2)};
    if (!(width < encounter.model.range(gap))) return;
    double force[3];
    const double h_kept = width < met.widest ? films.of(i, id, met) : 0.0;
    const Meeting m = encounter(i, gap, width, unit, u, h_kept, force, all);
    if (m.closed) films.keep(i, id, m.h0, h_kept, met);
    all.friction.raise(m.friction / volume(gap.Ri));
    if (!moves) return;
    for (int k = 0; k < 3; k++) b.f(i, k) += force[k];
    all.fx += -force[0];
    all.fy += -force[1];
    all.fz += -force[2];
    auto stress = [&](int k, int l) {
      return 0.5 * distance * (unit[k] * force[l] + unit[l] * force[k]);
    };

    // the symmetric part of r f; r from the wall, as LAMMPS' walls have it

    all.xx += stress(0, 0);
    all.yy += stress(1, 1);
    all.zz += stress(2, 2);
    all.xy += stress(0, 1);
    all.xz += stress(0, 2);
    all.yz += stress(1, 2);
  }
};

// Energy that the viscous terms have taken, from their powers at each step

struct Losses {
  enum { VISCOUS, LUBRICATION, SLIDING, TERMS };
  double sum[TERMS] = {0.0, 0.0, 0.0};

  void begin(const CollisionTotals &now) { take(now, before); }
  void step(const CollisionTotals &now, double dt)    // trapezoidal rule
  {
    double power[TERMS];
    take(now, power);
    for (int k = 0; k < TERMS; k++) {
      sum[k] -= 0.5 * dt * (before[k] + power[k]);
      before[k] = power[k];
    }
  }

 private:
  double before[TERMS] = {0.0, 0.0, 0.0};
  static void take(const CollisionTotals &now, double *power)
  {
    power[VISCOUS] = now.viscous;
    power[LUBRICATION] = now.lubrication;
    power[SLIDING] = now.sliding;
  }
};

}    // namespace Bubble

#endif
