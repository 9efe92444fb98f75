// Coefficients of the predictor-corrector and the control of its step.

#include "foam_stepper.h"
#include "samples.h"

#include <gtest/gtest.h>

using namespace Foam;

// ---------------------------------------------------------------------- coefficients

TEST(Predictor, FirstStepIsEuler)
{
  for (const Scheme scheme : {Scheme::STANDARD, Scheme::SOURCE}) {
    const Predictor p = predictor(scheme, 0.3, 0.0);
    EXPECT_EQ(p.now, 0.3);
    EXPECT_EQ(p.before, 0.0);
  }
}

TEST(Predictor, EqualStepsGiveTheTextbookCoefficients)
{
  for (const Scheme scheme : {Scheme::STANDARD, Scheme::SOURCE}) {
    const Predictor p = predictor(scheme, 0.5, 0.5);
    EXPECT_DOUBLE_EQ(p.now, 0.75);
    EXPECT_DOUBLE_EQ(p.before, -0.25);
  }
}

TEST(Predictor, ConstantRateIsExact)
{
  Samples samples(1);
  for (int n = 0; n < 100; n++) {
    const double h = samples.decades(1.0e-3, 1.0), before = samples.decades(1.0e-3, 1.0);
    for (const Scheme scheme : {Scheme::STANDARD, Scheme::SOURCE}) {
      const Predictor p = predictor(scheme, h, before);
      // the two coefficients may be larger than their sum by the ratio of steps, up to 1000
      EXPECT_NEAR(p.now + p.before, h, 1.0e3 * EPS * h);
    }
  }
}

TEST(Predictor, LinearRateIsExactForAnyRatioOfSteps)
{
  // y = t + t^2, f = 1 + 2 t
  Samples samples(2);
  auto y = [](double t) {
    return t + t * t;
  };
  auto f = [](double t) {
    return 1.0 + 2.0 * t;
  };
  for (int n = 0; n < 100; n++) {
    const double t = samples.uniform(0.0, 1.0), before = samples.uniform(0.1, 1.0);
    const double h = before * samples.decades(0.2, 1.9);    // ratios that step control makes
    const Predictor p = predictor(Scheme::STANDARD, h, before);
    EXPECT_NEAR(predict(y(t), f(t), f(t - before), p), y(t + h), 100.0 * EPS);

    // the source's constant coefficients miss by (h/2) (1 - h/h_before) times the step back in f
    const Predictor q = predictor(Scheme::SOURCE, h, before);
    EXPECT_NEAR(predict(y(t), f(t), f(t - before), q) - y(t + h), h * (before - h), 100.0 * EPS);
  }
}

TEST(Predictor, ErrorConstant)
{
  // y = t^3 from t = 0: y* - y(h) = -h^3 (1 + 3 / (2 w)), that is -y''' h^3 (1/6 + 1/(4 w))
  for (const double w : {0.5, 1.0, 1.9}) {
    const double h = 0.25, back = -h / w;
    const Predictor p = predictor(Scheme::STANDARD, h, h / w);
    EXPECT_NEAR(predict(0.0, 0.0, 3.0 * back * back, p) - h * h * h, -h * h * h * (1.0 + 1.5 / w),
                10.0 * EPS);
  }
}

TEST(Corrector, LinearRateIsExact)
{
  // y = t + t^2 from t = 0.3
  const double t = 0.3, h = 0.7;
  const double end = t + h;
  EXPECT_NEAR(correct(t + t * t, 1.0 + 2.0 * t, 1.0 + 2.0 * end, h), end + end * end, 4.0 * EPS);
}

TEST(Stepper, LinearInvariantIsKept)
{
  // Rates of two components that cancel keep the sum, whatever the steps: so it is with gas
  Samples samples(3);
  double y[2] = {0.7, 0.3}, before[2] = {}, h_before = 0.0;
  for (int n = 0; n < 1000; n++) {
    const double f[2] = {std::sin(9.0 * y[0]), -std::sin(9.0 * y[0])};
    const double h = samples.decades(1.0e-3, 0.1);
    const Predictor p = predictor(Scheme::STANDARD, h, h_before);
    const double y0 = predict(y[0], f[0], before[0], p), y1 = predict(y[1], f[1], before[1], p);
    EXPECT_NEAR(y0 + y1, 1.0, (n + 4) * EPS);
    const double rate = std::sin(9.0 * y0);
    y[0] = correct(y[0], f[0], rate, h);
    y[1] = correct(y[1], f[1], -rate, h);
    for (int k = 0; k < 2; k++) before[k] = f[k];
    h_before = h;
  }
  EXPECT_NEAR(y[0] + y[1], 1.0, 1000.0 * EPS);
}

// ---------------------------------------------------------------------- order of convergence

namespace {

// y' = -y^2 cos(t)  with y = 1 / (2 + sin t), from t = 0 to 2

double rate(double t, double y)
{
  return -y * y * std::cos(t);
}
double solution(double t)
{
  return 1.0 / (2.0 + std::sin(t));
}

struct Errors {
  double end;         // at the end of the path
  double estimate;    // largest distance of corrector and predictor, after the first step
};

// Steps alternate between 2 h and h. With correction, as fix foam/abm does it: predict, evaluate,
// correct, evaluate. Without: the predictor on its own.

Errors integrate(Scheme scheme, int cycles, bool corrected)
{
  const double h = 2.0 / (3.0 * cycles);
  double t = 0.0, y = solution(0.0), before = 0.0, h_before = 0.0;
  Errors errors{0.0, 0.0};
  for (int n = 0; n < 2 * cycles; n++) {
    const double step = n % 2 == 0 ? 2.0 * h : h, now = rate(t, y);
    const double ahead = predict(y, now, before, predictor(scheme, step, h_before));
    t += step;
    const double next = correct(y, now, rate(t, ahead), step);
    if (n > 0) errors.estimate = std::fmax(errors.estimate, std::fabs(next - ahead));
    y = corrected ? next : ahead;
    before = now;
    h_before = step;
  }
  errors.end = std::fabs(y - solution(t));
  return errors;
}

// order in h of both, from 256 against 512 cycles. The next term of the error makes the ratio
// differ from a power of two by some h, 1e-2: a tolerance of 0.1 tells orders well apart.

constexpr double SAME_ORDER = 0.1;

Errors order(Scheme scheme, bool corrected)
{
  const Errors coarse = integrate(scheme, 256, corrected), fine = integrate(scheme, 512, corrected);
  return {std::log2(coarse.end / fine.end), std::log2(coarse.estimate / fine.estimate)};
}

}    // namespace

TEST(Order, TrueRatioOfStepsGivesTwo)
{
  EXPECT_NEAR(order(Scheme::STANDARD, true).end, 2.0, SAME_ORDER);
  EXPECT_NEAR(order(Scheme::STANDARD, false).end, 2.0, SAME_ORDER);
}

TEST(Order, ConstantCoefficientsCostThePredictorAnOrder)
{
  EXPECT_NEAR(order(Scheme::SOURCE, false).end, 1.0, SAME_ORDER);
}

TEST(Order, ErrorEstimateIsOfOrderThreeWhichStepControlCountsOn)
{
  EXPECT_NEAR(order(Scheme::STANDARD, true).estimate, 3.0, SAME_ORDER);
  EXPECT_NEAR(order(Scheme::SOURCE, true).estimate, 2.0, SAME_ORDER);
}

// ---------------------------------------------------------------------- error of a step

// A try that went beyond the neighbor list is repeated with as much of the step as stays within, but for a
// margin, and at least a fifth

TEST(StepControl, WithinTheList)
{
  const StepControl control;
  EXPECT_DOUBLE_EQ(control.within(2.0, 0.5), 2.0 * 0.9 * 0.5);
  EXPECT_LT(control.within(2.0, 0.999), 2.0);
  EXPECT_DOUBLE_EQ(control.within(2.0, 1.0e-9), 2.0 * 0.2);
  EXPECT_DOUBLE_EQ(control.within(2.0, 0.0), 2.0 * 0.2);
}

TEST(StepError, MaxIsTheLargestComponent)
{
  EXPECT_DOUBLE_EQ(step_error(Norm::MAX, 3.0e-4, 1.0e-4, 1000.0, 2.0), 1.5e-4);
}

TEST(StepError, RmsIsTheMeanOverComponents)
{
  EXPECT_DOUBLE_EQ(step_error(Norm::RMS, 3.0e-4, 9.0e-8 * 1000.0, 1000.0, 2.0),
                   1.5e-4);    // all equal
  // one in OUTLIER^2 has it all: the largest is just OUTLIER times the mean
  const double n = OUTLIER * OUTLIER;
  EXPECT_DOUBLE_EQ(step_error(Norm::RMS, 3.0e-4, 9.0e-8, n, 2.0), 1.5e-4 / OUTLIER);
}

TEST(StepError, RmsAllowsNoComponentMoreThanOutlierTimesTheTolerance)
{
  StepControl c;
  c.tolerance = 1.0e-4;
  const double Rin = 2.0, most = OUTLIER * c.tolerance * Rin, many = 1.0e9;
  for (const double share : {0.9, 0.999}) {
    const double one = share * most;
    EXPECT_TRUE(c.accepts(step_error(Norm::RMS, one, one * one, many, Rin)));
  }
  for (const double share : {1.001, 1.1, 1.0e3}) {
    const double one = share * most;    // among so many the mean is far below the tolerance
    ASSERT_LT(std::sqrt(one * one / many), 0.1 * c.tolerance * Rin * share);
    EXPECT_FALSE(c.accepts(step_error(Norm::RMS, one, one * one, many, Rin)));
    EXPECT_DOUBLE_EQ(step_error(Norm::RMS, one, one * one, many, Rin), share * c.tolerance);
  }
}

TEST(StepError, NoBubbles)
{
  for (const Norm norm : {Norm::MAX, Norm::RMS})
    EXPECT_EQ(step_error(norm, 0.0, 0.0, 0.0, 2.0), 0.0);
}

TEST(StepError, WhatIsNoNumberIsNotAccepted)
{
  // the square of a component is in the sum, whatever becomes of it in the maximum
  StepControl c;
  for (const double bad : {double(NAN), double(INFINITY)}) {
    EXPECT_FALSE(c.accepts(step_error(Norm::MAX, bad, bad, 1000.0, 2.0)));
    for (const double largest : {0.0, bad})
      EXPECT_FALSE(c.accepts(step_error(Norm::RMS, largest, bad, 1000.0, 2.0)));
  }
}

// ---------------------------------------------------------------------- step control

namespace {
StepControl control(Scheme scheme = Scheme::STANDARD)
{
  StepControl c;
  c.scheme = scheme;
  c.tolerance = 1.0e-4;
  return c;
}
}    // namespace

TEST(StepControl, AcceptsUpToTheTolerance)
{
  const StepControl c = control();
  EXPECT_TRUE(c.accepts(0.0));
  EXPECT_TRUE(c.accepts(1.0e-4));
  EXPECT_FALSE(c.accepts(1.0001e-4));
  EXPECT_FALSE(c.accepts(INFINITY));
  EXPECT_FALSE(c.accepts(NAN));
}

TEST(StepControl, FollowsTheThirdRootOfTheError)
{
  const StepControl c = control();
  EXPECT_DOUBLE_EQ(c.next(2.0, 1.0e-4, false), 0.9 * 2.0);
  EXPECT_DOUBLE_EQ(c.next(2.0, 8.0e-4, false), 0.45 * 2.0);
  EXPECT_DOUBLE_EQ(c.next(2.0, 1.0e-4 / 3.375, false), 1.35 * 2.0);
}

TEST(StepControl, FactorIsBounded)
{
  const StepControl c = control();
  EXPECT_DOUBLE_EQ(c.next(1.0, 0.0, false), c.growth);
  EXPECT_DOUBLE_EQ(c.next(1.0, 1.0e-30, false), c.growth);
  EXPECT_DOUBLE_EQ(c.next(1.0, 1.0e+30, false), StepControl::SHRINK);
}

TEST(StepControl, FirstStepsMayGrowMore)
{
  // dt0 is a guess: what the error allows counts from there on, up to a limit of its own
  StepControl c = control();
  const double tiny = 1.0e-4 * 1.0e-6;    // allows 100 times the step
  EXPECT_DOUBLE_EQ(c.next(1.0, tiny, false, 0), c.growth);
  c.growth_at_start = 1000.0;
  for (int before = 0; before < StepControl::STARTS; before++)
    EXPECT_NEAR(c.next(1.0, tiny, false, before), 0.9 * 100.0, 100.0 * EPS);
  EXPECT_DOUBLE_EQ(c.next(1.0, tiny, false, StepControl::STARTS), c.growth);
  EXPECT_DOUBLE_EQ(c.next(1.0, 1.0e-4 * 1.0e-15, false, 0), c.growth_at_start);
  EXPECT_DOUBLE_EQ(c.next(1.0, 0.0, false, 0), c.growth);    // no error says nothing
  EXPECT_DOUBLE_EQ(c.next(1.0, tiny, true, 0), 1.0);
  EXPECT_DOUBLE_EQ(c.next(1.0, INFINITY, false, 0), StepControl::SHRINK);
}

TEST(StepControl, ErrorThatIsNoNumberShrinksTheStep)
{
  const StepControl c = control();
  for (const bool again : {false, true}) {
    EXPECT_DOUBLE_EQ(c.next(1.0, INFINITY, again), StepControl::SHRINK);
    EXPECT_DOUBLE_EQ(c.next(1.0, NAN, again), StepControl::SHRINK);
  }
}

TEST(StepControl, ContinuousAndMonotoneInTheError)
{
  const StepControl c = control();
  double before = c.next(1.0, 1.0e-12, false);
  for (double error = 1.0e-12; error < 1.0; error *= 1.01) {
    const double now = c.next(1.0, error, false);
    EXPECT_LE(now, before);
    EXPECT_GE(now, 0.99 * before);    // cbrt(1.01) = 1.0033
    before = now;
  }
}

TEST(StepControl, RejectedStepAlwaysShrinks)
{
  const StepControl c = control();
  for (double error = 1.0e-4 * (1.0 + EPS); error < 1.0; error *= 1.5) {
    EXPECT_LE(c.next(1.0, error, false), c.safety);
    EXPECT_LE(c.next(1.0, error, true), c.safety);
  }
}

TEST(StepControl, StepAfterARejectionDoesNotGrow)
{
  const StepControl c = control();
  EXPECT_EQ(c.next(1.0, 0.0, true), 1.0);
  EXPECT_EQ(c.next(1.0, 1.0e-6, true), 1.0);
  EXPECT_DOUBLE_EQ(c.next(1.0, 0.95e-4, true), 0.9 * std::cbrt(1.0 / 0.95));    // but may shrink
}

TEST(StepControl, SettlesJustBelowTheTolerance)
{
  // an error of C h^3 settles at SAFETY^3 of the tolerance and never is rejected again
  const StepControl c = control();
  double h = 1.0e-3;
  for (int n = 0; n < 50; n++) h = c.next(h, 7.0 * h * h * h, false);
  EXPECT_NEAR(7.0 * h * h * h, 0.9 * 0.9 * 0.9 * 1.0e-4, 1.0e-15);
}

TEST(StepControl, SourceHalvesOrGrowsByAConstant)
{
  const StepControl c = control(Scheme::SOURCE);
  EXPECT_DOUBLE_EQ(c.next(1.0, 0.99e-4, false), 1.9);
  EXPECT_DOUBLE_EQ(c.next(1.0, 0.99e-4, true), 1.9);
  EXPECT_DOUBLE_EQ(c.next(1.0, 1.01e-4, false), 0.5);
  EXPECT_DOUBLE_EQ(c.next(1.0, NAN, false), 0.5);
}
