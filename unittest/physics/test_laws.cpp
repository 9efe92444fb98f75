// Contact laws: each is the gradient of its potential, nothing where it ends, and what its page says.

#include "foam_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace Foam;

namespace {

// each law, with values of its parameters

std::vector<LawChoice> samples()
{
  return {{0, {}},    {1, {1.5}}, {1, {2.0}}, {1, {2.5}}, {1, {4.0}},
          {2, {0.7}}, {3, {0.0}}, {3, {0.1}}, {3, {0.6}}};
}

struct Radii {
  double i, j;
};
const std::vector<Radii> PAIRS{
    {1.0, 1.0}, {0.1, 0.2}, {3.0, 8.0}, {1.0, 100.0}, {2.0, 0.0}};    // last: a wall

}    // namespace

TEST(Laws, EachHasASampleAndANameOfItsOwn)
{
  std::set<int> sampled;
  for (const LawChoice &choice : samples()) sampled.insert(choice.index);
  EXPECT_EQ(static_cast<int>(sampled.size()), NLAWS);
  const auto names = names_of_laws();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(Laws, ForceIsTheGradientOfTheEnergy)
{
  for (const LawChoice &choice : samples())
    with_law(choice, [](const auto &law) {
      for (const auto &[Ri, Rj] : PAIRS)
        for (double delta : {-1.1, -0.15, -0.05, 0.01, 0.2, 0.7, 1.0}) {
          if (delta < 0.0 && !law.BEYOND) continue;
          const double Rsum = Ri + Rj, overlap = delta * Rsum, d = 1e-5 * std::fabs(overlap);
          const double stiffness = 1.7;
          const double slope = (law.energy(stiffness, overlap + d, Ri, Rj) -
                                law.energy(stiffness, overlap - d, Ri, Rj)) /
                               (2.0 * d);
          const double F = law.force(stiffness, overlap, Ri, Rj);
          // central differences: error of second order, (d / overlap)^2 = 1e-10, and rounding of energies,
          // 1e-16 of them / 1e-5
          EXPECT_NEAR(
              F, slope,
              1e-9 * (std::fabs(F) + std::fabs(law.energy(stiffness, overlap, Ri, Rj) / overlap)))
              << law.NAME << " " << Ri << " " << Rj << " " << delta;
        }
    });
}

TEST(Laws, NothingWhereTheyEndAndRepulsionThatGrows)
{
  for (const LawChoice &choice : samples())
    with_law(choice, [](const auto &law) {
      for (const auto &[Ri, Rj] : PAIRS) {
        const double Rsum = Ri + Rj, end = (1.0 - law.range()) * Rsum;
        // rounding of the range leaves 1e-16 of the length at the end, squared in the energy
        EXPECT_NEAR(law.force(1.0, end, Ri, Rj), 0.0, 1e-15) << law.NAME;
        EXPECT_NEAR(law.energy(1.0, end, Ri, Rj), 0.0, 1e-29 * Rsum) << law.NAME;
        EXPECT_EQ(law.force(1.0, 1.01 * end, Ri, Rj), 0.0) << law.NAME;
        double last = 0.0;
        for (double delta = 0.05; delta <= 1.0; delta += 0.05) {
          const double F = law.force(1.0, delta * Rsum, Ri, Rj);
          EXPECT_GT(F, last) << law.NAME;
          last = F;
        }
        EXPECT_EQ(law.force(0.0, 0.5 * Rsum, Ri, Rj), 0.0) << law.NAME;
        EXPECT_EQ(law.energy(0.0, 0.5 * Rsum, Ri, Rj), 0.0) << law.NAME;
      }
    });
}

TEST(Laws, SameForBothPartners)    // bit by bit: each computes its own
{
  for (const LawChoice &choice : samples())
    with_law(choice, [](const auto &law) {
      for (const auto &[Ri, Rj] : PAIRS)
        for (double delta : {-0.3, 0.1, 0.9}) {
          if (Rj == 0.0 || (delta < 0.0 && !law.BEYOND)) continue;
          const double overlap = delta * (Ri + Rj);
          EXPECT_EQ(law.force(1.3, overlap, Ri, Rj), law.force(1.3, overlap, Rj, Ri)) << law.NAME;
          EXPECT_EQ(law.energy(1.3, overlap, Ri, Rj), law.energy(1.3, overlap, Rj, Ri)) << law.NAME;
        }
    });
}

TEST(Laws, PowerTwoIsTheSpringAndSoIsStickyWithoutShell)
{
  const SpringLaw spring(nullptr);
  const double two = 2.0, none = 0.0;
  const PowerLaw power(&two);
  const StickyLaw sticky(&none);
  for (double overlap : {1e-12, 0.1, 1.9}) {    // products in another order: two roundings
    EXPECT_NEAR(power.force(3.0, overlap, 0.8, 1.2) / spring.force(3.0, overlap, 0.8, 1.2), 1.0,
                4e-16);
    EXPECT_NEAR(power.energy(3.0, overlap, 0.8, 1.2) / spring.energy(3.0, overlap, 0.8, 1.2), 1.0,
                6e-16);
    EXPECT_NEAR(sticky.force(3.0, overlap, 0.8, 1.2) / spring.force(3.0, overlap, 0.8, 1.2), 1.0,
                4e-16);
    EXPECT_NEAR(sticky.energy(3.0, overlap, 0.8, 1.2) / spring.energy(3.0, overlap, 0.8, 1.2), 1.0,
                6e-16);
  }
  EXPECT_EQ(sticky.range(), 1.0);
}

TEST(Laws, PowerInClosedForm)
{
  const double hertz = 2.5;
  const PowerLaw law(&hertz);
  // delta = 1/4: F = 2 (1/4)^(3/2) = 1/4, U = 2 * 4 * (1/4)^(5/2) / 2.5 = 0.1
  EXPECT_DOUBLE_EQ(law.force(2.0, 1.0, 1.0, 3.0), 0.25);
  EXPECT_DOUBLE_EQ(law.energy(2.0, 1.0, 1.0, 3.0), 0.1);
}

TEST(Laws, StickyInClosedForm)
{
  const double A = 0.125;
  const StickyLaw law(&A);
  // R_i + R_j = 4, stiffness 2; delta = 1/4, then the most attractive one, -A, then the middle of the shell, -3 A / 2
  EXPECT_DOUBLE_EQ(law.force(2.0, 1.0, 1.0, 3.0), 0.5);
  EXPECT_DOUBLE_EQ(law.energy(2.0, 1.0, 1.0, 3.0), 2.0 * 4.0 * (1.0 / 32.0 - 1.0 / 64.0));
  EXPECT_DOUBLE_EQ(law.force(2.0, -0.5, 1.0, 3.0), -0.25);
  EXPECT_DOUBLE_EQ(law.energy(2.0, -0.5, 1.0, 3.0), -2.0 * 4.0 / 128.0);
  EXPECT_DOUBLE_EQ(law.force(2.0, -0.75, 1.0, 3.0), -0.125);
  EXPECT_DOUBLE_EQ(law.energy(2.0, -0.75, 1.0, 3.0), -2.0 * 4.0 / 512.0);
  EXPECT_EQ(law.force(2.0, -1.0, 1.0, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(law.range(), 1.25);
}

TEST(Laws, SurfaceInClosedForm)
{
  const double SIGMA = 0.5;
  const SurfaceLaw law(&SIGMA);
  // like bubbles, Delta = 0.1 each, x = 0.05 for R = 2: F = 0.5 * 2 * (18.5 / 400 + 0.1)
  EXPECT_DOUBLE_EQ(law.force(1.0, 0.2, 2.0, 2.0), 18.5 / 400.0 + 0.1);
  EXPECT_DOUBLE_EQ(law.energy(1.0, 0.2, 2.0, 2.0),
                   2.0 * 0.5 * 4.0 * (18.5 / 3.0 / 8000.0 + 1.0 / 400.0));
  // a wall takes none of the overlap: x = 0.1
  EXPECT_DOUBLE_EQ(law.force(1.0, 0.2, 2.0, 0.0), 18.5 / 100.0 + 0.2);
  EXPECT_DOUBLE_EQ(law.energy(1.0, 0.2, 2.0, 0.0), 0.5 * 4.0 * (18.5 / 3.0 / 1000.0 + 1.0 / 100.0));
}

TEST(Laws, SurfaceDividesTheOverlapAmongBoth)
{
  const double SIGMA = 1.0;
  const SurfaceLaw law(&SIGMA);
  auto deformed = [](double f, double R) {
    return R * (std::sqrt(4.0 + 74.0 * f / R) - 2.0) /
           37.0;    // the root of f = R (18.5 x^2 + 2 x), times R
  };
  for (double ratio : {1.0, 1.1, 3.0, 30.0, 100.0})
    for (double delta : {1e-3, 0.01, 0.1, 0.5, 1.0}) {
      const double overlap = delta * (1.0 + ratio), f = law.force(1.0, overlap, 1.0, ratio);
      // what Newton's four steps leave, and the cancellation in `deformed`, EPS / (f / R)
      EXPECT_NEAR((deformed(f, 1.0) + deformed(f, ratio)) / overlap, 1.0, 1e-14 + 4e-16 / delta)
          << ratio << " " << delta;
    }
}
