// A bubble at a plane wall: what it covers, what the wall leaves of its velocity, and the contact laws there.

#include "foam_laws.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;

TEST(Wall, CoveredAreaIsThatOfTheDisc)
{
  Samples samples(1);
  for (int n = 0; n < 1000; n++) {
    const double R = samples.decades(1.0e-3, 1.0e3), s = samples.decades(1.0e-3, 1.0) * R;
    if (!(s < R)) continue;
    const long double h2 = ((long double) R - s) * ((long double) R + s);
    // a difference, a sum, two products and a root
    EXPECT_NEAR(wall_area<2>(s, R), 2.0L * std::sqrt(h2), 6.0 * EPS * R);
    EXPECT_NEAR(wall_area<3>(s, R), PI * h2, 6.0 * EPS * PI * R * R);
  }
}

TEST(Wall, CoveredAreaAtItsEnds)
{
  for (double R : {0.3, 1.0, 70.0}) {
    for (double s : {R, 1.5 * R, double(INFINITY), double(NAN)}) {
      EXPECT_EQ(wall_area<2>(s, R), 0.0);
      EXPECT_EQ(wall_area<3>(s, R), 0.0);
    }
    for (double s : {0.0, -0.1 * R, -R, -3.0 * R}) {    // beyond the wall: the full cross-section
      EXPECT_DOUBLE_EQ(wall_area<2>(s, R), 2.0 * R);
      EXPECT_DOUBLE_EQ(wall_area<3>(s, R), PI * R * R);
    }
  }
  EXPECT_EQ(wall_area<2>(-0.1, 0.0), 0.0);    // a dead bubble
  EXPECT_EQ(wall_area<3>(-0.1, 0.0), 0.0);
}

// the contact area with a bubble of the same place and the limit of infinite radius

TEST(Wall, CoveredAreaIsTheLimitOfAContactArea)
{
  for (double s : {0.1, 0.5, 0.9}) {
    const double Rj = 1.0e7;
    // the surface of the large one departs from the plane by R^2 / (2 Rj) = 5e-8, and d area / ds is of order 10
    EXPECT_NEAR(wall_area<2>(s, 1.0), contact_area<2>(Rj + s, 1.0, Rj), 1.0e-6);
    EXPECT_NEAR(wall_area<3>(s, 1.0), contact_area<3>(Rj + s, 1.0, Rj), 1.0e-6);
  }
}

TEST(Wall, LeavesOfAVelocityWhatItsDragSays)
{
  EXPECT_EQ(velocity_along_wall(1.7, 0.0), 1.7);
  EXPECT_EQ(velocity_along_wall(1.7, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(velocity_along_wall(-1.7, 0.25), -1.7 * 0.75);
}

// the law of the thesis: F = sigma0 <R_in> (1 - s / R)

TEST(Wall, SpringPushesLikeTheThesis)
{
  const SpringLaw law(nullptr);
  for (double R : {0.4, 1.0, 3.0})
    for (double s : {1.0, 0.5, 0.01, 0.0, -0.5, -2.0}) {
      const double F = law.force(1.7, wall_overlap(s * R, R), R, 0.0);
      EXPECT_NEAR(F, 1.7 * (1.0 - s), 1e-15 * (2.0 + std::fabs(s)));
    }
}

// a centre that has come through the wall is pushed back, the harder the farther it is

TEST(Wall, LawsGoOnBeyondTheWall)
{
  for (const LawChoice &choice : {LawChoice{0, {}}, LawChoice{1, {1.5}}, LawChoice{1, {2.5}},
                                  LawChoice{2, {0.7}}, LawChoice{3, {0.1}}})
    with_law(choice, [](const auto &law) {
      double last = 0.0;
      for (double s = 0.5; s > -10.0; s -= 0.5) {
        const double F = law.force(1.3, wall_overlap(s, 0.8), 0.8, 0.0);
        const double U = law.energy(1.3, wall_overlap(s, 0.8), 0.8, 0.0);
        EXPECT_GT(F, last) << law.NAME;
        EXPECT_TRUE(std::isfinite(F) && std::isfinite(U)) << law.NAME;
        last = F;
      }
    });
}
