/* ----------------------------------------------------------------------
   The physics of the wet-foam model, one function for each formula.

   Plain inline functions without LAMMPS types, callable on the host and on a
   device: the base styles, the KOKKOS styles and the unit tests all use these.
   D is the dimension, 2 or 3.  Any consistent set of units: R is a length,
   sigma0 a force per length in units where the spring constant of a pair of
   bubbles is sigma0 <R_in> / (R_i + R_j), <R_in> the mean radius at the start of
   the simulation.

   Sources:
     [D95]  D. J. Durian, Phys. Rev. Lett. 75, 4780 (1995)
     [G00]  B. S. Gardiner, B. Z. Dlugogorski, G. J. Jameson,
            Phil. Mag. A 80, 981 (2000)
     [K18]  K. Khakalo, K. Baumgarten, B. P. Tighe, A. Puisto,
            Phys. Rev. E 98, 012607 (2018)
     [L20]  J. Lankinen, thesis on the simulation of wet foams on GPUs (2020)
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_PHYSICS_H
#define LMP_FOAM_PHYSICS_H

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__CUDACC__) || defined(__HIPCC__)
#define FOAM_FUNCTION __host__ __device__ inline
#else
#define FOAM_FUNCTION inline
#endif

// for the one loop that a compiler may take for too large, and for what is called in it; and for what few foams need, so
// that loops of others are small enough

#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#define FOAM_INLINE_LAMBDA __attribute__((always_inline))
#define FOAM_ALWAYS_INLINE FOAM_INLINE_LAMBDA inline
#define FOAM_RARELY_CALLED __attribute__((noinline))
#define FOAM_FLAT          __attribute__((flatten))
#else
#define FOAM_INLINE_LAMBDA
#define FOAM_ALWAYS_INLINE FOAM_FUNCTION
#define FOAM_RARELY_CALLED FOAM_FUNCTION
#define FOAM_FLAT
#endif

namespace Foam {

// The dimension is a template argument wherever it matters: run<D>() for the one that LAMMPS is told

template <class Run> auto with_dimension(int dimension, Run &&run)
{
  return dimension == 2 ? run.template operator()<2>() : run.template operator()<3>();
}

inline constexpr double PI = 3.14159265358979323846;

// ---------------------------------------------------------------------- one bubble

// R^D, the variable in which the gas content of a bubble is linear; the
// integrators advance this and not R, so that the sum of gas is a linear
// invariant and nothing is singular where a bubble vanishes

template <int D> FOAM_FUNCTION double power_of_radius(double R)
{
  return D == 2 ? R * R : R * R * R;
}

template <int D> FOAM_FUNCTION double slope_of_power(double R)    // d R^D / dR
{
  return D * (D == 2 ? R : R * R);
}

// Cube root of a number >= 0, or NaN, without a branch or a call, so that compilers do several at a time.  y is the inverse
// root: from 1 - h = q y^3 follows
//   q^(-1/3) = y (1 - h)^(-1/3) = y (1 + h/3 + 2 h^2/9 + 14 h^3/81 + 35 h^4/243 + ...).
// It begins with a third of the exponent, taken off from its place among the bits (|h| < 0.103), and two such steps leave
// 4e-20.  A step of Newton's for r^3 = q takes off the rounding: what remains is below 2^-52.

FOAM_FUNCTION double cube_root(double q)
{
  constexpr double SMALL = 0x1p-900, LARGE = 0x1p900;    // beyond, products lose digits or overflow
  const double scale = q < SMALL ? 0x1p300 : q > LARGE ? 0x1p-300 : 1.0;
  const double back = q < SMALL ? 0x1p-100 : q > LARGE ? 0x1p100 : 1.0;
  const double s = q * scale;

  // A double below 2^52 with 2^52 added has its whole part in the low bits

  constexpr std::uint64_t BITS_OF_2_52 = 0x4330000000000000u;
  constexpr double START = 1430186361.0;    // 4/3 of 2^20 1023, less what makes |h| least
  std::uint64_t bits;
  double upper, y;
  std::memcpy(&bits, &s, sizeof(s));
  bits = (bits >> 32) | BITS_OF_2_52;
  std::memcpy(&upper, &bits, sizeof(upper));
  const double third = START - (upper - 0x1p52) * (1.0 / 3.0) + 0x1p52;
  std::memcpy(&bits, &third, sizeof(third));
  bits <<= 32;
  std::memcpy(&y, &bits, sizeof(y));

  for (int step = 0; step < 2; step++) {
    const double h = 1.0 - s * y * y * y;
    y += y * (h * (1.0 / 3.0 + h * (2.0 / 9.0 + h * (14.0 / 81.0))));
  }
  const double r = s * (y * y), root = r + (s - r * r * r) * (y * y * (1.0 / 3.0));
  return q < INFINITY ? root * back : q;
}

template <int D> FOAM_FUNCTION double radius_of_power(double q)
{
  const double left = q > 0.0 ? q : 0.0;    // used up: no radius; NaN stays NaN
  return q == q ? (D == 2 ? std::sqrt(left) : cube_root(left)) : q;
}

// gas content is V = CONTENT<D> R^D: pi R^2 or (4/3) pi R^3

template <int D> inline constexpr double CONTENT = D == 2 ? PI : 4.0 * PI / 3.0;

// surface: 2 pi R (a length) or 4 pi R^2

template <int D> FOAM_FUNCTION double surface(double R)
{
  return D == 2 ? 2.0 * PI * R : 4.0 * PI * R * R;
}

// ---------------------------------------------------------------------- two bubbles

// Square of the lens radius h of two overlapping bubbles at distance r.  With
// a = (r^2 + R_j^2 - R_i^2) / (2 r), h^2 = R_j^2 - a^2 is the squared height of
// the triangle with sides r, R_i, R_j; Heron's product loses no digits where the
// bubbles just touch, nor where equal ones nearly coincide.  Once the lens plane
// has passed the centre of the smaller bubble, r^2 <= |R_i^2 - R_j^2|, h would
// shrink again and turn imaginary: there it shows its full cross-section.

FOAM_ALWAYS_INLINE double lens_radius_squared(double r, double Ri, double Rj)
{
  const double smaller = Ri < Rj ? Ri : Rj;
  if (r * r <= std::fabs((Ri - Rj) * (Ri + Rj))) return smaller * smaller;
  const double h2 =
      (Ri + Rj - r) * (Ri + Rj + r) * ((r + (Ri - Rj)) * (r - (Ri - Rj))) / (4.0 * r * r);
  return h2 > 0.0 ? h2 : 0.0;
}

// contact area of two touching bubbles: 2 h (a length) or pi h^2

template <int D> FOAM_ALWAYS_INLINE double contact_area(double r, double Ri, double Rj)
{
  const double h2 = lens_radius_squared(r, Ri, Rj);
  return D == 2 ? 2.0 * std::sqrt(h2) : PI * h2;
}

// one bubble's share of the energy of [L20], E = (1/2) sigma0 sum_i sum_j overlap^2
// over ordered pairs; not the potential of the force, kept to compare curves

FOAM_FUNCTION double durian_energy(double sigma0, double overlap)
{
  return 0.5 * sigma0 * overlap * overlap;
}

// sign of the fixed direction in which coincident centres are pushed apart:
// opposite for the two partners, whichever of them asks

template <class Tag> FOAM_FUNCTION double coincident_sign(Tag i, Tag j)
{
  return i < j ? 1.0 : -1.0;
}

// Gas that i takes from j through the film between them, per permeability K:
// A_ij (1/R_j - 1/R_i) [G00]; changes sign exactly when i and j are swapped

FOAM_FUNCTION double film_exchange(double area, double Ri, double Rj)
{
  return area * ((Ri - Rj) / (Ri * Rj));
}

// Overdamped motion: mu0 (v_i - u_i) = F_i, where u_i is the velocity of the liquid around
// bubble i: 0, or the mean of the velocities of the bubbles in contact (0 without any) [D95, L20]

FOAM_FUNCTION double drag_velocity(double F, double mu0, double u)
{
  return F / mu0 + u;
}

// With drag between bubbles in contact, too, mu0 (v_i - u_i) + mu_c sum_j (v_i - v_j) = F_i [Tighe et al., Phys. Rev. Lett.
// 105, 088303 (2010)]: the left side for u_i = 0, from the sum of v_j - v_i

FOAM_FUNCTION double contact_drag_force(double mu0, double mu_c, double v, double sum)
{
  return mu0 * v - mu_c * sum;
}

FOAM_FUNCTION double mean_of_neighbors(double sum, double contacts)
{
  return contacts > 0.0 ? sum / contacts : 0.0;
}

// A box that deforms takes a liquid along in which nothing else moves: at x = lo + H s, s the box
// coordinates, u = lo' + H' s.  Indices as LAMMPS has them: xx, yy, zz, yz, xz, xy.

struct AffineFlow {
  double lo[3], inverse[6], rate[6], rate_lo[3];    // lo, H^-1, H', lo'

  FOAM_FUNCTION void along(const double *s, double *u) const    // H' s
  {
    u[0] = rate[0] * s[0] + rate[5] * s[1] + rate[4] * s[2];
    u[1] = rate[1] * s[1] + rate[3] * s[2];
    u[2] = rate[2] * s[2];
  }
  FOAM_FUNCTION void operator()(const double *x, double *u) const
  {
    const double d[3] = {x[0] - lo[0], x[1] - lo[1], x[2] - lo[2]};
    const double s[3] = {inverse[0] * d[0] + inverse[5] * d[1] + inverse[4] * d[2],
                         inverse[1] * d[1] + inverse[3] * d[2], inverse[2] * d[2]};
    along(s, u);
    for (int k = 0; k < 3; k++) u[k] += rate_lo[k];
  }
};

// where a box that has deformed has taken a place to, if nothing else moved it

struct AffineMap {
  double from[3], to[3], m[6];    // to + M (x - from)

  FOAM_FUNCTION double operator()(const double *x, int k) const
  {
    const double d[3] = {x[0] - from[0], x[1] - from[1], x[2] - from[2]};
    if (k == 0) return to[0] + m[0] * d[0] + m[5] * d[1] + m[4] * d[2];
    return k == 1 ? to[1] + m[1] * d[1] + m[3] * d[2] : to[2] + m[2] * d[2];
  }

  // the most by which a distance has changed, per its length: at most the norm of M - 1

  double strain(int dimension) const
  {
    double square = m[5] * m[5];
    if (dimension == 3) square += m[3] * m[3] + m[4] * m[4];
    for (int k = 0; k < dimension; k++) square += (m[k] - 1.0) * (m[k] - 1.0);
    return std::sqrt(square);
  }
};

// what drag takes from a bubble that does not move with its liquid, per time and direction

FOAM_FUNCTION double dissipated(double mu0, double v, double u)
{
  return mu0 * (v - u) * (v - u);
}

// The neighbors' velocities are taken from what is known already, l, which makes the equation
// an iteration, v = F / mu0 + A l, A the averaging.  With l the velocities of the last state
// it never settles: for two bubbles in contact A has the eigenvalue -1, and v alternates
// between 0 and twice its due.  The mean of them and of what they were computed with maps
// an eigenvalue m of A to (1 + m) / 2, within [0, 1].

FOAM_FUNCTION double lagged_velocity(double v, double l)
{
  return 0.5 * (v + l);
}

// ---------------------------------------------------------------------- a bubble and a plane wall

// s is the distance of the centre from the wall, negative beyond it.  They touch where s < R; the force is that of
// the contact law (foam_law.h) for a partner that does not deform, of radius 0 at distance s.

FOAM_FUNCTION double wall_overlap(double s, double R)
{
  return R - s;
}

// the part of the wall that the bubble covers, a disc of radius^2 = R^2 - s^2 with an area (a length in 2D) like that
// of a contact; once the centre is beyond the wall, that of the full cross-section

template <int D> FOAM_FUNCTION double wall_area(double s, double R)
{
  if (!(s < R)) return 0.0;
  const double h2 = s > 0.0 ? (R - s) * (R + s) : R * R;
  return D == 2 ? 2.0 * std::sqrt(h2) : PI * h2;
}

// a wall holds the bubbles that touch it: what it leaves of their velocity along it; wall_drag = 0 slips, 1 sticks

FOAM_FUNCTION double velocity_along_wall(double v, double wall_drag)
{
  return (1.0 - wall_drag) * v;
}

// ---------------------------------------------------------------------- gas through the liquid

// Both laws exchange gas in proportion to a weight of the free surface,
//   Vdot_i = c w_i (1/rho - 1/R_i),   rho = (sum w) / (sum w / R),
// where rho, the radius that neither grows nor shrinks, conserves the gas:
//   AREA [K18, L20]  w = Af_i        c = kappa K <A_in> / <A>
//   LSW              w = Af_i / R_i  c = kappa K <R_in>
// The second has a diffusion layer as thick as the bubble; for free bubbles in
// 3D it is the law of Lifshitz, Slyozov and Wagner, with rho = <R>.

enum class LiquidLaw { AREA, LSW };

// Af_i = A_i - sum_j A_ij; a small bubble squeezed by many has none left

FOAM_FUNCTION double free_area(double surface, double contact_area_sum)
{
  const double free = surface - contact_area_sum;
  return free > 0.0 ? free : 0.0;
}

FOAM_FUNCTION double liquid_weight(LiquidLaw law, double free_area, double R)
{
  return law == LiquidLaw::AREA ? free_area : free_area / R;
}

FOAM_FUNCTION double liquid_coefficient(LiquidLaw law, double kappa, double K, double Rin,
                                        double Ain, double Amean)
{
  return kappa * K * (law == LiquidLaw::AREA ? Ain / Amean : Rin);
}

// 1/rho from the sums over all bubbles; without any free surface there is no exchange,
// and every weight that multiplies the result is zero

FOAM_FUNCTION double inverse_critical_radius(double weight_sum, double weight_over_R_sum)
{
  return weight_sum > 0.0 ? weight_over_R_sum / weight_sum : 0.0;
}

FOAM_FUNCTION double liquid_exchange(double coefficient, double weight, double inverse_rho,
                                     double R)
{
  return coefficient * weight * (inverse_rho - 1.0 / R);
}

// ---------------------------------------------------------------------- rates and removal

// rate of q = R^D and of R itself for a rate of gas content Vdot:
// V = CONTENT<D> q, and Rdot = Vdot / A

template <int D> FOAM_FUNCTION double power_rate(double Vdot)
{
  return Vdot / CONTENT<D>;
}

template <int D> FOAM_FUNCTION double radius_rate(double Vdot, double R)
{
  return Vdot / surface<D>(R);
}

// A bubble is removed when smaller than allowed, or used up; or was used up within a step (R = 0), whatever
// is left of its gas at the end.
// Survivors of a removal take the removed gas in proportion to their own,
// V -> V (1 + Vexcess / sum V): the factor of V, and of q = R^D

FOAM_FUNCTION bool vanished(double R, double q, double smallest)
{
  return R < smallest || !(R > 0.0) || !(q > 0.0);
}

FOAM_FUNCTION double redistribution_factor(double Vexcess, double Vsurvivors)
{
  return 1.0 + Vexcess / Vsurvivors;
}

// gas fraction; above 1 it counts overlaps twice

FOAM_FUNCTION double gas_fraction(double Vsum, double Vbox)
{
  return Vsum / Vbox;
}

// scaled time tau = K t / <R_in>^2

FOAM_FUNCTION double scaled_time(double K, double t, double Rin)
{
  return K * t / (Rin * Rin);
}

FOAM_FUNCTION double time_of_scaled(double K, double tau, double Rin)
{
  return tau * Rin * Rin / K;
}

}    // namespace Foam

#endif
