/* ----------------------------------------------------------------------
   A liquid that is resolved by particles (SPH), one function for each formula.

   Plain inline functions without LAMMPS types, callable on the host and on a device: base styles, KOKKOS styles and unit
   tests all use these.  Three dimensions.  Dimensionless: lengths, velocities and times by integral scales, density of
   the liquid 1, Reynolds number Re, Froude number Fr.

   Source:
     [K23]  J. R. C. King, S. J. Lind, B. D. Rogers, P. K. Stansby, R. Vacondio, J. Fluid Mech. 972, A24 (2023)
     [B99]  J. Bonet, T.-S. L. Lok, Comput. Methods Appl. Mech. Eng. 180, 97 (1999)
     [S81]  Y. Sato, M. Sadatomi, K. Sekoguchi, Int. J. Multiphase Flow 7, 167 (1981)
     [M97]  J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys. 136, 214 (1997)
     [W95]  H. Wendland, Adv. Comput. Math. 4, 389 (1995)
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_PHYSICS_H
#define LMP_LIQUID_PHYSICS_H

#include "foam_physics.h"

#include <cmath>

namespace Liquid {

using Foam::PI;

// ---------------------------------------------------------------------- kernel

// Wendland's C2 [W95], q = r/h:
//   W = 21/(16 pi h^3) (1 - q/2)^4 (1 + 2q),  dW/dr = -21/(16 pi h^4) 5q (1 - q/2)^3,  for q < SUPPORT, else 0

inline constexpr double SUPPORT = 2.0;

struct Kernel {
  double h, inverse, scale;    // h, 1/h, 21/(16 pi h^3)
  FOAM_FUNCTION explicit Kernel(double h)
      : h(h), inverse(1.0 / h), scale(21.0 / (16.0 * PI) * inverse * inverse * inverse)
  {
  }
  FOAM_FUNCTION double operator()(double r) const
  {
    const double q = r * inverse, a = 1.0 - 0.5 * q;
    return q < SUPPORT ? scale * a * a * a * a * (1.0 + 2.0 * q) : 0.0;
  }
  FOAM_FUNCTION double
  slope_over_r(double r) const    // (1/r) dW/dr: grad W = slope_over_r (r_i - r_j)
  {
    const double q = r * inverse, a = 1.0 - 0.5 * q;
    return q < SUPPORT ? -5.0 * scale * inverse * inverse * a * a * a : 0.0;
  }
  FOAM_FUNCTION double reach() const { return SUPPORT * h; }
};

// ---------------------------------------------------------------------- operators

// Part of a neighbor in the Laplacian of Morris [M97]: sum_j 2 (f_i - f_j) / r^2 r . grad W V_j, times the
// harmonic mean of coefficients in div(kappa grad f)

FOAM_FUNCTION double laplacian_weight(double slope_over_r, double volume)
{
  return 2.0 * slope_over_r * volume;
}

FOAM_FUNCTION double harmonic_mean(double a, double b)
{
  return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
}

// Symmetric matrices: xx, yy, zz, xy, xz, yz

FOAM_FUNCTION void multiply(const double *m, const double *a, double *result)
{
  result[0] = m[0] * a[0] + m[3] * a[1] + m[4] * a[2];
  result[1] = m[3] * a[0] + m[1] * a[1] + m[5] * a[2];
  result[2] = m[4] * a[0] + m[5] * a[1] + m[2] * a[2];
}

// The correction of gradients [B99], inverse of A = sum_j V_j grad W (r_j - r_i)^T, which is 1 for many neighbors, half of
// it at a plane surface.  Where a particle has few of them, or all in a plane, there is none: 1 in its place.

inline constexpr double LEAST_DETERMINANT = 1.0e-3;

FOAM_FUNCTION bool correction(const double *A, double *L)
{
  const double xx = A[1] * A[2] - A[5] * A[5], xy = A[4] * A[5] - A[3] * A[2],
               xz = A[3] * A[5] - A[4] * A[1];
  const double determinant = A[0] * xx + A[3] * xy + A[4] * xz;
  if (!(determinant > LEAST_DETERMINANT)) {
    for (int k = 0; k < 6; k++) L[k] = k < 3 ? 1.0 : 0.0;
    return false;
  }
  const double inverse = 1.0 / determinant;
  L[0] = inverse * xx;
  L[1] = inverse * (A[0] * A[2] - A[4] * A[4]);
  L[2] = inverse * (A[0] * A[1] - A[3] * A[3]);
  L[3] = inverse * xy;
  L[4] = inverse * xz;
  L[5] = inverse * (A[3] * A[4] - A[0] * A[5]);
  return true;
}

// ---------------------------------------------------------------------- gas and surface

// gas c in a particle [K23 (2.7)]: volume of the particle over that of its liquid is 1 + c.  At c = 1/2 the smoothing
// length has grown as far as cutoffs know of.

inline constexpr double MOST_GAS = 0.5;
FOAM_FUNCTION double liquid_fraction(double c)
{
  return 1.0 / (1.0 + c);
}
FOAM_FUNCTION double smoothing_length(double h0, double alpha)
{
  return h0 / std::cbrt(alpha);
}
FOAM_FUNCTION double fraction_of_length(double h0, double h)    // alpha again
{
  const double ratio = h0 / h;
  return ratio * ratio * ratio;
}

// sum_j V_j (r_j - r_i) . grad W is 3 inside

inline constexpr double SURFACE_COVER = 2.4;

// Shifting [K23 (3.11)]: towards where particles are few, a neighbor's weight 1 + (1/4) (W/W(0))^4, by -(h^2/4) times the
// gradient of concentration

FOAM_FUNCTION double shift_weight(double w, double w0)
{
  const double q = w / w0, square = q * q;
  return 1.0 + 0.25 * square * square;
}
FOAM_FUNCTION double shift_of(double h, double gradient)
{
  return -0.25 * h * h * gradient;
}

// ---------------------------------------------------------------------- large eddies

struct Closure {
  enum Kind { NONE, SMAGORINSKY, MIXED } kind = MIXED;
  double constant = 0.06;    // C_S, or C_M
};

// |S|^2 = 2 S:S of the gradient [a][k] = d u_k / d a

FOAM_FUNCTION double strain_rate(const double (*gradient)[3])
{
  double square = 0.0;
  for (int a = 0; a < 3; a++)
    for (int k = 0; k < 3; k++) {
      const double s = 0.5 * (gradient[a][k] + gradient[k][a]);
      square += 2.0 * s * s;
    }
  return std::sqrt(square);
}

// Viscosity of what is not resolved, over that of the liquid.  Mixed scales [K23 (2.4)], with the exponent of |S| that its
// dimension wants: nu = Re C_M h^(1+xi) |S|^xi (q^2)^((1-xi)/2), xi = 1/2, q^2 = |u - filtered u|^2 / 2.  Smagorinsky:
// nu = Re (C_S h)^2 |S|.

FOAM_FUNCTION double eddy_viscosity(const Closure &closure, double Re, double h, double S,
                                    double q2)
{
  switch (closure.kind) {
    case Closure::MIXED:
      return Re * closure.constant * h * std::sqrt(h * S * std::sqrt(q2));
    case Closure::SMAGORINSKY:
      return Re * closure.constant * closure.constant * h * h * S;
    default:
      return 0.0;
  }
}

FOAM_FUNCTION double dissipation(double Re, double nu_S, double S)
{
  return (1.0 + nu_S) / Re * S * S;
}

// ---------------------------------------------------------------------- step

// No particle goes further than 0.2 h in a step, nor does momentum diffuse further [K23 (3.15)].  The former limit is of
// accuracy, and may be chosen; with the latter at 0.4 a flow at Re = 1 grows without end.  Two limits are ours: for a
// liquid that begins at rest, nothing falls further than that either; and no bubble leaves what is around it, 2 h,
// within a few steps.

inline constexpr double COURANT = 0.2, COURANT_OF_VISCOSITY = 0.2, COURANT_OF_BUBBLES = 0.5;

FOAM_FUNCTION double longest_step(double courant, double h, double speed, double of_bubbles,
                                  double Re, double nu,
                                  double push)    // by gravity and other forces, an acceleration
{
  double step = COURANT_OF_VISCOSITY * Re * h * h / (1.0 + nu);
  if (speed > 0.0) step = std::fmin(step, courant * h / speed);
  if (of_bubbles > 0.0) step = std::fmin(step, COURANT_OF_BUBBLES * h / of_bubbles);
  if (push > 0.0) step = std::fmin(step, courant * std::sqrt(h / push));
  return step;
}

// ---------------------------------------------------------------------- bubbles in it

// Bubbles are smaller than the spacing: radius a, velocity u_b, volume V_b; beta is the density of the liquid over that of
// the gas.  Forces are divided by the density of the gas, so that V_b du_b/dt = F.

FOAM_FUNCTION double bubble_volume(double a)
{
  return 4.0 / 3.0 * PI * a * a * a;
}

// Schiller and Naumann [K23 (2.15)], Re_b = 2 a |u_rel| Re

FOAM_FUNCTION double drag_coefficient(double Re_b)
{
  if (Re_b > 1000.0) return 0.44;
  return 24.0 / Re_b * (1.0 + 0.15 * std::pow(Re_b, 0.687));
}

// F_d = k u_rel, u_rel = u_l - u_b; without the first branch, 0/0 at rest

FOAM_FUNCTION double drag_factor(double a, double speed, double Re, double beta)
{
  const double Re_b = 2.0 * a * speed * Re;
  const double coefficient_by_speed =
      Re_b > 1.0e-12 ? drag_coefficient(Re_b) * speed : 12.0 / (a * Re);
  return 0.5 * beta * PI * a * a * coefficient_by_speed;
}

inline constexpr double LIFT = 0.5, VIRTUAL_MASS = 0.5;    // C_l, C_vm

// Viscosity by a bubble over that of the liquid, before it is spread over the liquid.  Sato's [S81] is 0.6 alpha_g 2a |u_rel|; a
// bubble's part of alpha_g is V_b, so that it is Re V_b 0.6 2a |u_rel|.  [K23 (2.5)] prints it without Re V_b, which depends on the unit of
// length.

FOAM_FUNCTION double bubble_viscosity(double a, double speed)    // as printed
{
  return 0.6 * 2.0 * a * speed;
}
FOAM_FUNCTION double bubble_viscosity_sato(double a, double speed, double Re)
{
  return Re * bubble_volume(a) * bubble_viscosity(a, speed);
}

// Velocity of the liquid at a bubble that is not resolved [K23 (2.19)], a process of Langevin along the resolved relative
// velocity and across it: u' = E u' + W zeta with normal numbers zeta.  Times by [K23 (2.20)] with the squares of velocities that
// their dimension wants; sigma^2 = (2/3) k, a scattering that it keeps.

struct Langevin {
  double E[2], W[2];    // along, across
  FOAM_FUNCTION Langevin(double k, double speed, double h, double dt)
  {
    const double square = 2.0 / 3.0 * k;
    for (int side = 0; side < 2; side++) {
      // 1/tau = sqrt(sigma^2 + u^2) / h, and with 4 u^2 across
      const double rate = std::sqrt(square + (side ? 4.0 : 1.0) * speed * speed) / h;
      E[side] = std::exp(-dt * rate);
      W[side] = std::sqrt(square * (1.0 - E[side] * E[side]));
    }
  }
};

// A bubble that eddies deform [K23 (2.25)]: speed of its length, against surface tension.  It breaks once it is longer than 2 a.

FOAM_FUNCTION double deformation_speed(double eps, double a, double We)
{
  const double s = 8.2 * std::cbrt(4.0 * eps * eps * a * a) - 6.0 / (a * We);
  return s < 0.0 ? -std::sqrt(-s) : std::sqrt(s);
}

// Into parts V and 1 - V of its volume, with a probability [K23 (2.27)] of
//   P(V) ~ V^(-2/3) (1-V)^(-2/3) [V^(2/9) - Lambda^(5/3)] [(1-V)^(2/9) - Lambda^(5/3)],  Lambda the least size over 2 a.
// In y = V^(1/3), since dV = 3 V^(2/3) dy, the first factor goes; P is largest at V = 1/2 or below.

FOAM_FUNCTION double least_size(double We, double eps, double a)
{
  return std::pow(12.0 / (8.2 * We), 0.6) * std::pow(eps, -0.4) / (2.0 * a);
}

FOAM_FUNCTION double splits(double Lambda, double V)    // density in V^(1/3), not normalised
{
  const double part = std::pow(Lambda, 5.0 / 3.0), ninth = 2.0 / 9.0;
  const double one = std::pow(V, ninth) - part, other = std::pow(1.0 - V, ninth) - part;
  return one > 0.0 && other > 0.0 ? one * other / std::cbrt((1.0 - V) * (1.0 - V)) : 0.0;
}

// The smaller part by random numbers, drawn below a bound of the density; 0 if there is none: the bubble is too small

template <class Draws> FOAM_FUNCTION double smaller_part(double Lambda, const Draws &draws)
{
  constexpr double LEAST = 1.0e-3;
  constexpr unsigned FIRST = 8, TRIES = 1000;
  const double least = std::fmax(LEAST, std::pow(Lambda, 7.5));    // V^(2/9) = Lambda^(5/3)
  if (!(least < 0.5)) return 0.0;
  const double lo = std::cbrt(least), hi = std::cbrt(0.5), part = std::pow(Lambda, 5.0 / 3.0);
  const double bound = std::cbrt(4.0) * (std::pow(0.5, 2.0 / 9.0) - part) * (1.0 - part);
  double V = 0.5;
  for (unsigned n = FIRST; n < FIRST + 2 * TRIES; n += 2) {
    const double y = lo + (hi - lo) * draws.uniform(n);
    V = y * y * y;
    if (bound * draws.uniform(n + 1) < splits(Lambda, V)) return V;
  }
  return V;
}

// Bubbles that a surface entrains [K23 (3.22)]: energy for their surfaces, a part of what is dissipated in a particle, and room
// for their gas until it is full.  With the density of the liquid as the unit the energy has no beta; the constant was chosen for
// the product, by entrained volumes, so beta is kept.

inline constexpr double ENTRAINING_EPS = 0.2, ENTRAINED = 0.01;
FOAM_FUNCTION bool entrains(double eps, double alpha)
{
  return eps > ENTRAINING_EPS && alpha > 1.0 / (1.0 + MOST_GAS);
}
FOAM_FUNCTION double energy_for_surfaces(double beta, double eps, double liquid_volume, double dt)
{
  return ENTRAINED * beta * eps * liquid_volume * dt;
}
FOAM_FUNCTION double room_for_gas(double alpha, double w0)
{
  return (1.0 + MOST_GAS - 1.0 / alpha) / w0;
}
FOAM_FUNCTION double surface_energy(double a, double We)
{
  return 4.0 * PI * a * a / We;
}
FOAM_FUNCTION double smallest_entrained(double We)
{
  return std::pow(We, -0.6) / 40.0;
}

// Near the surface [K23 (2.21)]: 1 on it; from LEAST_NEARNESS on a bubble meets it, and is slowed down by this part of all
// other forces

inline constexpr double LEAST_NEARNESS = 0.1;
FOAM_FUNCTION double nearness(double normal, double around)
{
  return around > 0.0 ? normal / (0.353 * around) : 0.0;
}
FOAM_FUNCTION double held_at_surface(double nearness)
{
  return nearness > 0.0 ? 0.5 * (1.0 + std::erf(2.0 * std::log(5.0 * nearness))) : 0.0;
}

// how long a film lasts at the surface [K23 (2.23)], with Schmidt's number of surfactants

inline constexpr double SCHMIDT = 700.0;
FOAM_FUNCTION double persistence(double We, double Fr, double Re, double a)
{
  return std::pow(We, 0.75) * std::sqrt(Fr) * std::sqrt(SCHMIDT * a) / Re;
}

}    // namespace Liquid

#endif
