// Contact laws: each is the gradient of its potential, nothing at contact, and what its page says.

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
  return {{0, {}}, {1, {1.5}}, {1, {2.0}}, {1, {2.5}}, {1, {4.0}}};
}

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
      for (double Rsum : {0.3, 2.0, 11.0})
        for (double delta : {0.01, 0.2, 0.7, 1.0}) {
          const double overlap = delta * Rsum, d = 1e-5 * overlap, stiffness = 1.7;
          // central differences: error of second order, (d / overlap)^2 = 1e-10, and rounding 1e-16 / 1e-5
          const double slope = (law.energy(stiffness, overlap + d, Rsum) -
                                law.energy(stiffness, overlap - d, Rsum)) /
                               (2.0 * d);
          EXPECT_NEAR(law.force(stiffness, overlap, Rsum) / slope, 1.0, 1e-9)
              << law.NAME << " " << Rsum << " " << delta;
        }
    });
}

TEST(Laws, NothingAtContactAndRepulsionBeyond)
{
  for (const LawChoice &choice : samples())
    with_law(choice, [](const auto &law) {
      EXPECT_EQ(law.force(1.0, 0.0, 2.0), 0.0) << law.NAME;
      EXPECT_EQ(law.energy(1.0, 0.0, 2.0), 0.0) << law.NAME;
      double last = 0.0;
      for (double overlap = 0.1; overlap <= 2.0; overlap += 0.1) {
        EXPECT_GT(law.force(1.0, overlap, 2.0), last) << law.NAME;
        last = law.force(1.0, overlap, 2.0);
      }
      EXPECT_EQ(law.force(0.0, 0.5, 2.0), 0.0) << law.NAME;
    });
}

TEST(Laws, PowerTwoIsTheSpring)
{
  const SpringLaw spring(nullptr);
  const double two = 2.0;
  const PowerLaw power(&two);
  for (double overlap : {1e-12, 0.1, 1.9}) {    // products in another order: two roundings
    EXPECT_NEAR(power.force(3.0, overlap, 2.0) / spring.force(3.0, overlap, 2.0), 1.0, 4e-16);
    EXPECT_NEAR(power.energy(3.0, overlap, 2.0) / spring.energy(3.0, overlap, 2.0), 1.0, 6e-16);
  }
}

TEST(Laws, PowerInClosedForm)
{
  const double hertz = 2.5;
  const PowerLaw law(&hertz);
  // delta = 1/4: F = 2 (1/4)^(3/2) = 1/4, U = 2 * 4 * (1/4)^(5/2) / 2.5 = 0.1
  EXPECT_DOUBLE_EQ(law.force(2.0, 1.0, 4.0), 0.25);
  EXPECT_DOUBLE_EQ(law.energy(2.0, 1.0, 4.0), 0.1);
}
