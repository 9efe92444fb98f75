/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_PHYSICS_H
#define LMP_BUBBLE_PHYSICS_H

#include "foam_physics.h"

#include <cmath>

// Bubbles with inertia that collide, after Heitkam, Sommer, Drenckhan & Froehlich, J. Phys.: Condens. Matter 29, 124005
// (2017), [H17].  Formulae alone: no types of LAMMPS, any consistent units.  What differs from [H17] and why:
// doc/collision.rst.
//
//   R      radius of a bubble            sigma  surface tension of the liquid
//   gap    between undeformed surfaces   mu     viscosity
//   u      approach speed, > 0 closing   rho    density
//   Delta  deformation of one bubble     h0     film thickness at which surfaces stop

namespace Bubble {

using Foam::PI;

// ---------------------------------------------------------------------- who meets whom

// The geometry of a gap.  A wall is a partner that does not deform: Rj = 0.

struct Gap {
  double Ri, Rj;
  double reduced;    // R_i R_j / (R_i + R_j), or R: curvature of the gap
  double mean;       // 2 R_i R_j / (R_i + R_j), or R
  double larger;     // of the two: it has less pressure and yields first
  bool wall;

  FOAM_FUNCTION static Gap to_wall(double R) { return {R, 0.0, R, R, R, true}; }
  FOAM_FUNCTION static Gap to_bubble(double Ri, double Rj)
  {
    const double reduced = Ri * Rj / (Ri + Rj);
    return {Ri, Rj, reduced, 2.0 * reduced, Ri > Rj ? Ri : Rj, false};
  }
};

// ---------------------------------------------------------------------- elastic force

// F = sigma R (18.5 x^2 + 2 x), x = Delta / R; [H17] eq. 9

FOAM_FUNCTION double elastic_force(double sigma, double Delta, double R)
{
  const double x = Delta / R;
  return sigma * R * x * (18.5 * x + 2.0);
}

FOAM_FUNCTION double elastic_energy(double sigma, double Delta, double R)
{
  const double x = Delta / R;
  return sigma * R * R * x * x * (18.5 / 3.0 * x + 1.0);
}

// F = 4 pi sigma Delta; [H17] eq. 1, for comparison: too stiff

FOAM_FUNCTION double spring_force(double sigma, double Delta)
{
  return 4.0 * PI * sigma * Delta;
}

FOAM_FUNCTION double spring_energy(double sigma, double Delta)
{
  return 2.0 * PI * sigma * Delta * Delta;
}

// Two bubbles in series: Delta_i + Delta_j = overlap, and the same force deforms both.  With c = 74 F / sigma and
// s = sqrt(4 + c / R), each has Delta = R (s - 2) / 37, so that R_i s_i + R_j s_j = L = 2 (R_i + R_j) + 37 overlap.  That
// is a quadratic equation for c.  Written for the smaller bubble i, all its terms are positive: nothing cancels.

FOAM_FUNCTION double in_series(double overlap, double Ri, double Rj)    // F / sigma
{
  const double R = Ri < Rj ? Ri : Rj, sum = Ri + Rj;
  const double x = 37.0 * overlap, L = 2.0 * sum + x, q = (sum - 2.0 * R) / L;
  const double above = x * (1.0 + 2.0 * q), p = 4.0 * R + above;
  const double e = above * (p + 4.0 * R);
  return e / (74.0 * (2.0 * R + p * q + 2.0 * std::sqrt(R * (R + p * q + 4.0 * q * q * R))));
}

FOAM_FUNCTION double deformation(double force, double R)    // force / sigma
{
  return 2.0 * force / (2.0 + std::sqrt(4.0 + 74.0 * force / R));
}

// ---------------------------------------------------------------------- the film

// Thickness at which the pressure in the gap reaches that in the (larger) bubble: h0^2 = (3/8) mu u R* R_> / sigma;
// [H17] eq. 14 for a wall and for equal bubbles

FOAM_FUNCTION double film_thickness_squared(double sigma, double mu, double u, const Gap &gap)
{
  return 0.375 * mu * u * gap.reduced * gap.larger / sigma;    // < 0 where surfaces part: no film
}

FOAM_FUNCTION double film_thickness(double sigma, double mu, double u, const Gap &gap)
{
  return u > 0.0 ? std::sqrt(film_thickness_squared(sigma, mu, u, gap)) : 0.0;
}

// Radius of the flat film over that of the bubble; [H17] eq. 10, solved for it

FOAM_FUNCTION double film_radius(double x)    // x = Delta / R
{
  return (std::sqrt(0.0016 + 9.44 * x) - 0.04) / 4.72;
}

// dR_a / dDelta, as [H17] eq. 17 has it

FOAM_FUNCTION double film_growth(double x)
{
  return 0.34 / std::sqrt(x + 0.0002);
}

// Approach of spheres before anything deforms: force = coefficient u; [H17] eq. 11

FOAM_FUNCTION double lubrication(double mu, double width, const Gap &gap)
{
  return 6.0 * PI * mu * gap.reduced * gap.reduced / width;
}

// The liquid that leaves the gap round the film has to pass it: its dissipation is (6 mu / pi) (u dR_a/dDelta)^2 R I,
// I = integral of q^2 / (r h^3) dr, q = flow for dR_a/dt = 1, all in units of R.  Here the fit of [H17], eq. 17;
// the integral itself: bubble_film.h.

FOAM_FUNCTION double film_fit(double h, double a)    // h0 / R, R_a / R
{
  return 4.0 / std::sqrt(h) + 3.0 * a / h;
}

// force = coefficient u.  [H17] prints the first power of dR_a/dDelta (eq. 17) and derives the second (B.5, B.12).

FOAM_FUNCTION double film_viscous(double mu, double growth, bool squared, double integral,
                                  const Gap &gap)
{
  const double part = gap.wall ? 1.0 : 0.25;
  return part * 6.0 / PI * mu * (squared ? growth * growth : growth) * gap.mean * integral;
}

// Sliding along a wall: force = coefficient u_t, no longer than the gap is narrower than R; [H17] eqs. 18, 19

FOAM_FUNCTION double sliding(double mu, double width, double R)
{
  return width < R ? -3.2 * PI * mu * R * std::log(width / R) : 0.0;
}

// ---------------------------------------------------------------------- in the liquid

enum class Drag { NONE, CONTAMINATED, CLEAN };

// force = coefficient u, u relative to the liquid; Re = 2 R rho u / mu.
// Contaminated (rigid surface): C_D = 24/Re (1 + 0.15 Re^0.687), Schiller & Naumann (1933), 0.44 above Re = 1000.
// Clean: C_D = 16/Re (1 + [8/Re + (1 + 3.315 Re^-1/2) / 2]^-1), Mei, Klausner & Lawrence, Phys. Fluids 6, 418 (1994).

FOAM_FUNCTION double drag(Drag kind, double rho, double mu, double R, double u)
{
  const double Re = 2.0 * R * rho * u / mu;
  if (kind == Drag::NONE) return 0.0;
  if (kind == Drag::CLEAN)
    return 4.0 * PI * mu * R * (1.0 + Re / (8.0 + 0.5 * (Re + 3.315 * std::sqrt(Re))));
  if (Re > 1000.0) return 0.22 * PI * rho * R * R * u;
  return 6.0 * PI * mu * R * (1.0 + 0.15 * std::pow(Re, 0.687));
}

FOAM_FUNCTION double volume(double R)
{
  return 4.0 / 3.0 * PI * R * R * R;
}

}    // namespace Bubble

#endif
