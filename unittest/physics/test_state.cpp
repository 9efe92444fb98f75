// What a step of a foam is judged by: errors of gas as lengths.

#include "foam_state.h"
#include "samples.h"

#include <gtest/gtest.h>

using namespace Foam;

namespace {

// one bubble that had the radius R_start and the gas of R_start at the start of a step, and has q now

template <int D> struct OneBubble {
  static constexpr double MEAN = 1.3;
  double radius, q, radius_start;
  Fields<D, HostBubbles> fields{};

  OneBubble(Variable variable, double R_start, double q) : q(q), radius_start(R_start)
  {
    radius = radius_of<D>(variable, q);
    fields.b.radius = {&radius};
    fields.q = &this->q;
    fields.radius_start = &radius_start;
    fields.variable = variable;
    fields.q_unit = slope_of_q<D>(variable, MEAN);
  }
  double measure(double change) const
  {
    return typename Fields<D, HostBubbles>::Gas{fields}.measure(0, change);
  }
};

template <int D> void small_errors_are_those_of_the_radius()
{
  Samples samples(3);
  for (int n = 0; n < 1000; n++) {
    const double R = samples.decades(1.0e-3, 1.0e3), change = 1.0e-6 * power_of_radius<D>(R);
    const OneBubble<D> bubble(Variable::VOLUME, R, power_of_radius<D>(R));
    const double exact = radius_of_power<D>(bubble.q + change) - R;
    // the next term of the series is (D-1)/2 of 1e-6/D, and a difference of radii has lost six digits
    EXPECT_NEAR(bubble.measure(change), exact, 1.0e-6 * exact);
  }
}

}    // namespace

TEST(ErrorOfGas, SmallOnesAreThoseOfTheRadius)
{
  small_errors_are_those_of_the_radius<2>();
  small_errors_are_those_of_the_radius<3>();
}

TEST(ErrorOfGas, ABubbleThatShrinksCountsAsAtTheStart)
{
  const double q = 1.0e-6, change = 1.0e-3;    // its radius would be off by thirty times itself
  EXPECT_DOUBLE_EQ(OneBubble<2>(Variable::VOLUME, 0.5, q).measure(change), change / (2 * 0.5));
  EXPECT_DOUBLE_EQ(OneBubble<3>(Variable::VOLUME, 0.5, q).measure(change), change / (3 * 0.25));
}

TEST(ErrorOfGas, OneThatIsUsedUpCountsAsOneOfTheMeanRadius)
{
  const double change = 1.0e-3, mean = OneBubble<2>::MEAN;
  for (double q : {0.0, -1.0e-3}) {
    EXPECT_DOUBLE_EQ(OneBubble<2>(Variable::VOLUME, 0.5, q).measure(change), change / (2 * mean));
    EXPECT_DOUBLE_EQ(OneBubble<3>(Variable::VOLUME, 0.5, q).measure(change),
                     change / (3 * mean * mean));
    EXPECT_DOUBLE_EQ(OneBubble<2>(Variable::VOLUME, 2.0, q).measure(change), change / (2 * 2.0));
  }
  // dead since before, where nothing changes
  EXPECT_EQ(OneBubble<2>(Variable::VOLUME, 0.0, 0.0).measure(0.0), 0.0);
}

TEST(ErrorOfGas, VariableRadiusHasNoneWhereNothingIsLeft)
{
  EXPECT_DOUBLE_EQ(OneBubble<3>(Variable::RADIUS, 0.5, 0.25).measure(-0.125), -0.125);
  EXPECT_DOUBLE_EQ(OneBubble<3>(Variable::RADIUS, 0.5, 0.25).measure(-0.5), -0.25);
  EXPECT_EQ(OneBubble<3>(Variable::RADIUS, 0.5, -0.125).measure(0.0625), 0.0);
}

TEST(ErrorOfGas, NaNStaysNaN)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (Variable variable : {Variable::VOLUME, Variable::RADIUS}) {
    EXPECT_TRUE(std::isnan(OneBubble<2>(variable, 1.0, nan).measure(1.0e-3)));
    EXPECT_TRUE(std::isnan(OneBubble<2>(variable, 1.0, 1.0).measure(nan)));
  }
}
