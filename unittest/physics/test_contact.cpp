// Geometry of one bubble and of a contact, and the spring that acts in it.

#include "foam_law_spring.h"
#include "foam_physics.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <limits>

using namespace Foam;

namespace {

const SpringLaw SPRING(nullptr);    // it has no parameters

// h^2 = R_j^2 - a^2 with a = (r^2 + R_j^2 - R_i^2) / (2 r), in more digits

long double textbook_lens(double r, double Ri, double Rj)
{
  const long double lr = r, li = Ri, lj = Rj;
  const long double a = (lr * lr + lj * lj - li * li) / (2.0L * lr);
  return lj * lj - a * a;
}

// distance at which the lens plane passes the centre of the smaller bubble

double clamp_distance(double Ri, double Rj)
{
  return std::sqrt(std::fabs((Ri - Rj) * (Ri + Rj)));
}

// Each factor of Heron's product is rounded by at most an EPS of R_i + R_j; what that makes of
// h^2 is largest where the bubbles touch, 2 EPS R_i R_j. Four factors and some to spare:

double rounding(double Ri, double Rj)
{
  return 16.0 * EPS * Ri * Rj;
}

}    // namespace

// ---------------------------------------------------------------------- one bubble

TEST(Bubble, SurfaceIsDerivativeOfContent)
{
  const double R = 1.7;
  EXPECT_DOUBLE_EQ(surface<2>(R), 2.0 * CONTENT<2> * R);
  EXPECT_DOUBLE_EQ(surface<3>(R), 3.0 * CONTENT<3> * R * R);
  EXPECT_DOUBLE_EQ(surface<2>(R), 10.681415022205297);
  EXPECT_DOUBLE_EQ(surface<3>(R), 36.316811075498011);
}

TEST(Bubble, RadiusOfPowerInvertsPowerOfRadius)
{
  Samples samples(1);
  for (int n = 0; n < 1000; n++) {
    const double R = samples.decades(1.0e-6, 1.0e6);
    // two or three roundings, halved or less by the root
    EXPECT_NEAR(radius_of_power<2>(power_of_radius<2>(R)), R, 2.0 * EPS * R);
    EXPECT_NEAR(radius_of_power<3>(power_of_radius<3>(R)), R, 2.0 * EPS * R);
  }
}

TEST(Bubble, CubeRootIsGoodToRounding)
{
  const auto error = [](double q) {    // relative, in more digits
    const long double root = std::cbrt(static_cast<long double>(q));
    return static_cast<double>(std::fabs((cube_root(q) - root) / root));
  };
  Samples samples(3);
  for (int n = 0; n < 100000; n++) {
    const double q = samples.decades(1.0e-307, 1.0e308), usual = samples.decades(1.0, 8.0);
    ASSERT_LT(error(q), EPS) << q;
    ASSERT_LT(error(usual), EPS) << usual;
  }
  const double least = std::numeric_limits<double>::denorm_min(),
               most = std::numeric_limits<double>::max();
  for (double q : {least, 1.0e5 * least, 1.0e-310, 0x1p-900, 0x1p900, 1.0, most})
    EXPECT_LT(error(q), EPS) << q;
  EXPECT_EQ(cube_root(0.0), 0.0);
  EXPECT_EQ(cube_root(27.0), 3.0);
  EXPECT_TRUE(std::isinf(cube_root(INFINITY)));
  EXPECT_TRUE(std::isnan(cube_root(NAN)));
}

TEST(Bubble, UsedUpBubbleHasNoRadiusAndNaNStaysVisible)
{
  EXPECT_EQ(radius_of_power<2>(0.0), 0.0);
  EXPECT_EQ(radius_of_power<2>(-1.0e-3), 0.0);
  EXPECT_EQ(radius_of_power<3>(-1.0e-3), 0.0);
  EXPECT_TRUE(std::isnan(radius_of_power<2>(NAN)));
  EXPECT_TRUE(std::isnan(radius_of_power<3>(NAN)));
  EXPECT_TRUE(std::isinf(radius_of_power<2>(INFINITY)));
}

TEST(Bubble, RatesOfPowerAndOfRadiusAgree)
{
  // d(R^D)/dt = D R^(D-1) dR/dt
  const double R = 0.8, Vdot = -0.3;
  EXPECT_DOUBLE_EQ(power_rate<2>(Vdot), 2.0 * R * radius_rate<2>(Vdot, R));
  EXPECT_DOUBLE_EQ(power_rate<3>(Vdot), 3.0 * R * R * radius_rate<3>(Vdot, R));
  EXPECT_DOUBLE_EQ(radius_rate<2>(Vdot, R), Vdot / surface<2>(R));
}

// ---------------------------------------------------------------------- lens

TEST(Lens, TextbookFormula)
{
  Samples samples(2);
  for (int n = 0; n < 10000; n++) {
    const double Ri = samples.decades(0.1, 10.0), Rj = samples.decades(0.1, 10.0);
    const double r = samples.uniform(clamp_distance(Ri, Rj), Ri + Rj);
    EXPECT_NEAR(lens_radius_squared(r, Ri, Rj), textbook_lens(r, Ri, Rj), rounding(Ri, Rj))
        << r << " " << Ri << " " << Rj;
  }
}

TEST(Lens, EqualBubbles)
{
  for (const double r : {0.1, 0.5, 1.0, 1.5, 1.99})
    EXPECT_NEAR(lens_radius_squared(r, 1.0, 1.0), 1.0 - 0.25 * r * r, 4.0 * EPS);
}

TEST(Lens, RightAngle)
{
  // spheres of radii 3 and 4 at distance 5 cross at right angles: h = 3 * 4 / 5
  EXPECT_DOUBLE_EQ(lens_radius_squared(5.0, 3.0, 4.0), 2.4 * 2.4);
  EXPECT_DOUBLE_EQ(contact_area<2>(5.0, 3.0, 4.0), 4.8);
  EXPECT_DOUBLE_EQ(contact_area<3>(5.0, 3.0, 4.0), PI * 2.4 * 2.4);
}

TEST(Lens, JustTouching)
{
  EXPECT_EQ(lens_radius_squared(3.0, 1.0, 2.0), 0.0);
  EXPECT_EQ(contact_area<2>(3.0, 1.0, 2.0), 0.0);

  // h^2 = 2 overlap R_i R_j / (R_i + R_j) at first order; at 2^-40 the second is 1e-12 of it
  const double overlap = std::ldexp(1.0, -40);
  EXPECT_NEAR(lens_radius_squared(3.0 - overlap, 1.0, 2.0) / (overlap * 4.0 / 3.0), 1.0, 1.0e-11);

  // beyond touching the product is negative: never a root of that
  EXPECT_EQ(lens_radius_squared(3.0 + 1.0e-15, 1.0, 2.0), 0.0);
  EXPECT_EQ(contact_area<2>(3.1, 1.0, 2.0), 0.0);
}

TEST(Lens, ContinuousWhereItsPlanePassesTheCentre)
{
  // h is largest there, so a distance d away h^2 is less by d^2 only
  Samples samples(3);
  for (int n = 0; n < 1000; n++) {
    const double Ri = samples.decades(0.1, 10.0), Rj = samples.decades(0.1, 10.0);
    const double r = clamp_distance(Ri, Rj), smaller = std::fmin(Ri, Rj);
    const double d = 1.0e-9 * r;
    const double inside = lens_radius_squared(r - d, Ri, Rj);
    const double outside = lens_radius_squared(r + d, Ri, Rj);
    EXPECT_EQ(inside, smaller * smaller);
    // a = r d / r at first order: (R_max/R_min) of rounding is no more than 100 here
    EXPECT_NEAR(outside, smaller * smaller, 2.0 * d * d + rounding(Ri, Rj));
  }
}

TEST(Lens, AreaNeverGrowsWithDistance)
{
  Samples samples(4);
  for (int n = 0; n < 50; n++) {
    const double Ri = samples.decades(0.1, 10.0), Rj = samples.decades(0.1, 10.0);
    double before = contact_area<3>(0.0, Ri, Rj);
    for (int m = 1; m <= 2000; m++) {
      const double now = contact_area<3>(m / 2000.0 * (Ri + Rj), Ri, Rj);
      EXPECT_LE(now, before + PI * rounding(Ri, Rj));
      EXPECT_LE(now, PI * std::fmin(Ri * Ri, Rj * Rj) + PI * rounding(Ri, Rj));
      before = now;
    }
    EXPECT_NEAR(before, 0.0, PI * rounding(Ri, Rj));
  }
}

TEST(Lens, SwallowedBubbleShowsItsCrossSection)
{
  for (const double r : {0.0, 1.0e-300, 1.0e-20, 0.1, 0.5})
    for (const double Rj : {0.3, 1.0e-6}) {
      EXPECT_EQ(contact_area<2>(r, 2.0, Rj), 2.0 * Rj);
      EXPECT_EQ(contact_area<3>(r, 2.0, Rj), PI * (Rj * Rj));
    }
}

TEST(Lens, EqualBubblesGrowingCoincident)
{
  // no clamp helps equal bubbles until r = 0, and R - R has to cancel before r is added to it
  EXPECT_EQ(contact_area<2>(0.0, 1.3, 1.3), 2.6);
  for (double r = 1.0; r > 1.0e-100; r *= 0.1)
    EXPECT_NEAR(lens_radius_squared(r, 1.3, 1.3), 1.69 - 0.25 * r * r, rounding(1.3, 1.3)) << r;
  for (double r = 1.0e-100; r > 0.0; r *= 0.1) {    // r^2 underflows on the way
    EXPECT_TRUE(std::isfinite(lens_radius_squared(r, 1.3, 1.3))) << r;
    EXPECT_LE(lens_radius_squared(r, 1.3, 1.3), 1.69 * (1.0 + 8.0 * EPS)) << r;
  }
}

TEST(Lens, NearlyEqualBubblesNearlyCoincident)
{
  Samples samples(5);
  for (int n = 0; n < 1000; n++) {
    const double Ri = samples.uniform(1.0, 2.0), Rj = Ri * (1.0 + samples.decades(1.0e-15, 0.1));
    const double r = clamp_distance(Ri, Rj) * samples.uniform(1.0, 2.0);
    EXPECT_NEAR(lens_radius_squared(r, Ri, Rj), textbook_lens(r, Ri, Rj), rounding(Ri, Rj))
        << r << " " << Ri << " " << Rj;
  }
}

TEST(Lens, VeryUnequalBubbles)
{
  // the lens on a bubble that is next to flat: h^2 = R^2 - (R - overlap)^2, but for R / 1e6
  const double big = 1.0e6, small = 1.0;
  for (const double overlap : {0.1, 0.5, 0.9}) {
    const double h2 = lens_radius_squared(big + small - overlap, big, small);
    EXPECT_NEAR(h2, 2.0 * overlap - overlap * overlap, 2.0 / big);
    EXPECT_NEAR(h2, textbook_lens(big + small - overlap, big, small), rounding(big, small));
  }
  EXPECT_EQ(contact_area<2>(big - 0.5, big, small), 2.0);
  EXPECT_EQ(contact_area<3>(big - 0.5, small, big), PI);
}

TEST(Lens, SameForBothPartners)
{
  Samples samples(6);
  for (int n = 0; n < 10000; n++) {
    const double Ri = samples.decades(1.0e-3, 1.0e3), Rj = samples.decades(1.0e-3, 1.0e3);
    const double r = samples.uniform(0.0, Ri + Rj);
    EXPECT_EQ(contact_area<2>(r, Ri, Rj), contact_area<2>(r, Rj, Ri));
    EXPECT_EQ(contact_area<3>(r, Ri, Rj), contact_area<3>(r, Rj, Ri));
  }
}

// ---------------------------------------------------------------------- spring

TEST(Spring, ClosedForm)
{
  // sigma0 <R_in> = 2, R_i + R_j = 3, overlap 0.6
  EXPECT_DOUBLE_EQ(SPRING.force(2.0, 0.6, 1.0, 2.0), 0.4);
  EXPECT_DOUBLE_EQ(SPRING.energy(2.0, 0.6, 1.0, 2.0), 0.12);
  EXPECT_DOUBLE_EQ(durian_energy(2.0, 0.6), 0.36);    // for each of the two
}

TEST(Spring, ForceIsMinusDerivativeOfEnergy)
{
  // U is a parabola, whose central difference is exact but for rounding, EPS U / step
  Samples samples(7);
  for (int n = 0; n < 1000; n++) {
    const double Rsum = samples.uniform(0.5, 3.0), r = samples.uniform(0.0, 0.99 * Rsum);
    const double step = std::ldexp(1.0, -10);
    const double Ri = 0.3 * Rsum, Rj = Rsum - Ri;
    const double slope = (SPRING.energy(1.5, Rsum - (r + step), Ri, Rj) -
                          SPRING.energy(1.5, Rsum - (r - step), Ri, Rj)) /
                         (2.0 * step);
    EXPECT_NEAR(SPRING.force(1.5, Rsum - r, Ri, Rj), -slope, 1.0e-11);
  }
}

TEST(Spring, LimitsAreFinite)
{
  EXPECT_EQ(SPRING.force(1.0, 0.0, 1.0, 1.0), 0.0);    // just touching
  EXPECT_EQ(SPRING.energy(1.0, 0.0, 1.0, 1.0), 0.0);
  EXPECT_EQ(SPRING.force(1.0, 2.0, 1.0, 1.0), 1.0);    // coincident: sigma0 <R_in>
  EXPECT_EQ(SPRING.energy(1.0, 2.0, 1.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(SPRING.force(1.0, 1.0e6 + 1.0, 1.0e6, 1.0), 1.0);
}

TEST(Spring, CoincidentBubblesPartInOppositeDirections)
{
  for (int i = 1; i < 5; i++)
    for (int j = 1; j < 5; j++) {
      if (i == j) continue;
      EXPECT_EQ(coincident_sign(i, j), -coincident_sign(j, i));
    }
}

// ---------------------------------------------------------------------- drag

TEST(Drag, VelocityOfTheLiquidAddsToThatOfTheForce)
{
  EXPECT_DOUBLE_EQ(drag_velocity(3.0, 2.0, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(mean_of_neighbors(6.0, 4.0), 1.5);
  EXPECT_EQ(mean_of_neighbors(0.0, 0.0), 0.0);    // no contact, no liquid velocity
}
