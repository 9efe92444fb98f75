// The driver of steps and both schemes with equations that are not those of a foam: bubbles with inertia on
// springs, in a liquid with drag,
//
//   dx/dt = v,   m dv/dt = -k x - c v
//
// so y has the fields x and v.  Nothing here knows of LAMMPS, and nothing in the schemes of this system.

#include "foam_abm.h"
#include "foam_rkc.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace Foam;

namespace {

struct Bubble {
  double mass, spring, drag;
  double x, v;
};

using Column = std::vector<double>;

struct Numbers {    // of one field
  Column value, start, rate, before;
  double unit;
};

struct TwoFields {
  static constexpr int MOST = 2;
  Numbers *numbers;    // [MOST]
  struct Calls {
    int keep_start = 0, rewind = 0, after_stage = 0;
  } * calls;    // of the first bubble

  struct Field {
    Numbers &own;
    int number;
    double value(int i) const { return own.value[i]; }
    void put(int i, double y) const { own.value[i] = y; }
    double &start(int i) const { return own.start[i]; }
    double rate(int i) const { return own.rate[i]; }
    void put_rate(int i, double f) const { own.rate[i] = f; }
    double &before(int i) const { return own.before[i]; }
    double measure(int, double change) const { return change / own.unit; }
    double move(int i, double y) const
    {
      const double before = own.value[i];
      own.value[i] = y;
      return measure(i, y - before);
    }
    double unit() const { return own.unit; }
  };

  template <class Visit> void each(Visit &&visit) const
  {
    for (int n = 0; n < MOST; n++) visit(Field{numbers[n], n});
  }
  void keep_start(int i) const
  {
    each([&](const auto &field) { field.start(i) = field.value(i); });
    if (i == 0) calls->keep_start++;
  }
  void rewind(int i) const
  {
    if (i == 0) calls->rewind++;
  }
  void after_stage(int i, const double *) const
  {
    if (i == 0) calls->after_stage++;
  }
  void after_start(int) const {}
  double reach(int i) const { return std::fabs(numbers[0].value[i]); }
  bool alive(int) const { return true; }
  bool used_up(int) const { return false; }
  void keep_used_up(int) const {}
  double seed(int i) const { return i + 1; }
};

struct ErrorsOfStep {
  FoamMax largest, reach;
  FoamSum squares;
  void join(const ErrorsOfStep &) {}    // there is one rank
};

struct AddErrors {
  using Totals = ErrorsOfStep;
  struct Look {};
  Look look(int) const { return {}; }
  void operator()(int, const Moved<Look> &moved, ErrorsOfStep &all) const
  {
    all.largest.raise(moved.error.largest);
    all.squares += moved.error.squares;
    all.reach.raise(moved.reach);
  }
};

struct GivenRates {
  const double *f;    // [bubble][field]
  void operator()(int i, double *of_bubble) const
  {
    for (int n = 0; n < 2; n++) of_bubble[n] = f[2 * i + n];
  }
};

class Springs {
 public:
  using Fields = TwoFields;
  using Totals = ErrorsOfStep;

  Driver driver;
  const bool use_rkc;    // else abm
  RungeKuttaChebyshev rkc;
  int evaluations = 0;
  double margin = INFINITY;    // evaluations are good for |x| up to this
  int extended = 0;
  double shake = 0.0;    // acceleration of all: shake sin(t)
  TwoFields::Calls calls;

  Springs(std::vector<Bubble> all, bool use_rkc, double tolerance) : use_rkc(use_rkc), bubbles(all)
  {
    const size_t n = bubbles.size();
    for (Numbers &one : numbers) one = {Column(n), Column(n), Column(n), Column(n), 1.0};
    for (Column &one : scratch) one = Column(n);
    for (size_t i = 0; i < n; i++) {
      numbers[0].value[i] = bubbles[i].x;
      numbers[1].value[i] = bubbles[i].v;
    }
    driver.control.tolerance = tolerance;
    driver.h = 1.0e-3;
    take_rates();
  }

  // ---- foam_scheme.h: a System

  TwoFields fields() { return {numbers, &calls}; }
  GivenRates rates() { return {rates_there.data()}; }
  AddErrors judge() { return {}; }
  Work<TwoFields> work() { return {{scratch[0].data(), scratch[1].data()}, scratch[2].data()}; }
  void evaluate(double later)
  {
    evaluations++;
    rates_there.resize(2 * bubbles.size());
    for (size_t i = 0; i < bubbles.size(); i++) {
      const Bubble &b = bubbles[i];
      const double x = numbers[0].value[i], v = numbers[1].value[i];
      rates_there[2 * i] = v;
      rates_there[2 * i + 1] =
          -(b.spring * x + b.drag * v) / b.mass + shake * std::sin(driver.time + later);
    }
  }
  template <class Functor> void for_each(const Functor &functor)
  {
    for (int i = 0; i < int(bubbles.size()); i++) functor(i);
  }
  template <class T, class Functor> T totals(const Functor &functor)
  {
    T all;
    for (int i = 0; i < int(bubbles.size()); i++) functor(i, all);
    return all;
  }
  template <class T> T reduce(const T &mine) { return mine; }
  double length() const { return 1.0; }
  bool moves_by_itself() const { return false; }
  bool others_act() const { return false; }
  bool lags() const { return false; }

  // ---- foam_driver.h: a Problem

  double largest_step() const { return rkc.stable_step(); }
  double shortest() const { return 1.0e-12; }
  ErrorsOfStep errors_of(double h, bool first = true)
  {
    return use_rkc ? rkc.attempt(*this, driver, h, first) : attempt_abm(*this, driver, h, first);
  }
  Trial attempt(double h, bool first)
  {
    const ErrorsOfStep errors = errors_of(h, first);
    const double components = 2.0 * bubbles.size();
    return {step_error(Norm::RMS, errors.largest, errors.squares, components, 1.0), errors.reach,
            margin};
  }
  bool extend_reach()    // as a list that is built anew reaches further, but not without end
  {
    if (just_extended) return false;
    just_extended = true;
    extended++;
    margin *= 2.0;
    for (Numbers &one : numbers) {    // the start is to be kept anew
      one.value = one.start;
      one.start.assign(one.start.size(), NAN);
    }
    return true;
  }
  void accept(double)
  {
    just_extended = false;
    for (Numbers &one : numbers) one.before = one.rate;
  }
  [[noreturn]] void too_short(double, bool refused)
  {
    throw std::runtime_error(refused ? "fell" : "too short");
  }

  void run_to(double end)
  {
    for (int n = 0; driver.time < end; n++) {
      if (n == 100000) throw std::runtime_error("no end");
      driver.h = std::min(driver.h, end - driver.time);
      driver.step(*this);
      take_rates();
      if (end - driver.time < 1.0e-9) break;
    }
  }
  void set_unit_of_v(double unit) { numbers[1].unit = unit; }
  double x(int i) const { return numbers[0].value[i]; }
  double v(int i) const { return numbers[1].value[i]; }

  void renew_rates() { take_rates(); }

 private:
  std::vector<Bubble> bubbles;
  Numbers numbers[2];
  Column scratch[3];
  std::vector<double> rates_there;
  bool just_extended = false;

  void take_rates()    // of a new state: FixFoamIntegrate::final_integrate()
  {
    evaluate(0.0);
    for (size_t i = 0; i < bubbles.size(); i++)
      for (int n = 0; n < 2; n++) numbers[n].rate[i] = rates_there[2 * i + n];
  }
};

// the solution: x = (A e^{a t} + B e^{b t}) where the drag is strong, else a damped oscillation

struct Exact {
  double x, v;
};
Exact exact(const Bubble &b, double t)
{
  const double g = 0.5 * b.drag / b.mass, w2 = b.spring / b.mass, d = g * g - w2;
  if (d > 0.0) {
    const double s = std::sqrt(d), r1 = -g + s, r2 = -g - s;
    const double B = (b.v - r1 * b.x) / (r2 - r1), A = b.x - B;
    return {A * std::exp(r1 * t) + B * std::exp(r2 * t),
            r1 * A * std::exp(r1 * t) + r2 * B * std::exp(r2 * t)};
  }
  const double w = std::sqrt(-d), S = (b.v + g * b.x) / w;
  const double c = std::cos(w * t), s = std::sin(w * t), e = std::exp(-g * t);
  return {e * (b.x * c + S * s), e * ((-g * b.x + w * S) * c + (-g * S - w * b.x) * s)};
}

const std::vector<Bubble> SOFT{{1.0, 1.0, 0.5, 1.0, 0.0}, {2.0, 1.0, 3.0, -0.5, 0.7}};

double worst(const Springs &springs, const std::vector<Bubble> &all, double t)
{
  double most = 0.0;
  for (size_t i = 0; i < all.size(); i++) {
    const Exact e = exact(all[i], t);
    most = std::max({most, std::fabs(springs.x(i) - e.x), std::fabs(springs.v(i) - e.v)});
  }
  return most;
}

class Schemes : public testing::TestWithParam<bool> {};

}    // namespace

INSTANTIATE_TEST_SUITE_P(Driver, Schemes, testing::Values(false, true),
                         [](const auto &info) { return info.param ? "rkc" : "abm"; });

// A step is judged by its own error.  Those of a run add up to a multiple of the tolerance that is not larger than
// their number, and drag makes them forget.

TEST_P(Schemes, BubblesWithInertiaFollowTheSolution)
{
  for (const double tolerance : {1.0e-4, 1.0e-6}) {
    Springs springs(SOFT, GetParam(), tolerance);
    springs.run_to(3.0);
    EXPECT_NEAR(springs.driver.time, 3.0, 1.0e-12);
    EXPECT_LT(worst(springs, SOFT, 3.0), springs.driver.accepted * tolerance);
    EXPECT_GT(springs.driver.accepted, 10);
  }
}

// Both are of order 2: with steps of one length, errors fall by 4 where steps are halved

TEST_P(Schemes, HaveOrderTwo)
{
  double before = 0.0;
  for (const double h : {0.04, 0.02, 0.01, 0.005}) {
    Springs springs(SOFT, GetParam(), 1.0);
    springs.driver.control.growth = 1.0;
    if (!GetParam()) {    // without history the first step is of order 1: a short one
      springs.driver.h = 1.0e-5;
      springs.driver.step(springs);
    }
    springs.driver.h = h;
    springs.run_to(2.0);
    const double error = worst(springs, SOFT, springs.driver.time);
    // the next order adds a share of about h to the ratio
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 10.0 * h);
    }
    before = error;
  }
}

// Forces of time are evaluated at the time of the stage: free bubbles that are shaken go x = t - sin t, v = 1 - cos t

TEST_P(Schemes, HaveOrderTwoWithForcesOfTime)
{
  double before = 0.0;
  for (const double h : {0.04, 0.02, 0.01}) {
    Springs springs({{1.0, 0.0, 0.0, 0.0, 0.0}}, GetParam(), 1.0);
    springs.shake = 1.0;
    springs.driver.control.growth = 1.0;
    springs.rkc.spectral.given = 1.0;
    springs.driver.h = 1.0e-5;    // the first step of abm has no history
    springs.driver.step(springs);
    springs.driver.h = h;
    springs.renew_rates();
    springs.run_to(2.0);
    const double t = springs.driver.time;
    const double error = std::max(std::fabs(springs.x(0) - (t - std::sin(t))),
                                  std::fabs(springs.v(0) - (1.0 - std::cos(t))));
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 10.0 * h);
    }
    before = error;
  }
}

// The error is a length: with another unit of v its share is another. It is that of v here, which a strong
// drag changes most

TEST_P(Schemes, ErrorsAreMeasuredInUnitsOfLength)
{
  double largest[2];
  for (const int n : {0, 1}) {
    Springs springs({{1.0, 0.0, 100.0, 0.0, 1.0}}, GetParam(), 1.0);
    springs.rkc.spectral.given = 100.0;
    if (n == 1) springs.set_unit_of_v(10.0);
    largest[n] = springs.errors_of(1.0e-3).largest;
  }
  EXPECT_NEAR(largest[0] / largest[1], 10.0, 1.0e-12);
}

// Predictor and corrector differ by a term of order 3, so that steps go with the cube root of the tolerance: a
// thousandth takes ten times as many. Without history it would be order 2, and 30 times

TEST(Schemes, HistoryGivesThePredictorItsOrder)
{
  double steps[2];
  for (const int n : {0, 1}) {
    Springs springs(SOFT, false, n == 0 ? 1.0e-5 : 1.0e-8);
    springs.run_to(3.0);
    steps[n] = springs.driver.accepted;
  }
  EXPECT_NEAR(steps[1] / steps[0], 10.0, 2.0);    // the first steps and the last do not scale
}

// A first step that is far too long is refused, and what was tried leaves no trace

TEST_P(Schemes, ARejectedStepLeavesNoTrace)
{
  Springs springs(SOFT, GetParam(), 1.0e-6), same(SOFT, GetParam(), 1.0e-6);
  if (GetParam()) {    // the estimate belongs to the state, and is taken once
    springs.rkc.spectral.given = same.rkc.spectral.given = 4.0;
  }
  springs.driver.h = 2.0;
  springs.driver.step(springs);
  EXPECT_GT(springs.driver.rejected, 0);
  EXPECT_EQ(springs.calls.keep_start, 1);
  EXPECT_EQ(springs.calls.rewind, springs.driver.rejected);
  same.driver.h = springs.driver.h_last;
  same.driver.step(same);
  EXPECT_EQ(same.driver.rejected, 0);
  EXPECT_EQ(same.calls.after_stage, GetParam() ? same.rkc.stages_last - 1 : 0);
  EXPECT_EQ(same.driver.h_last, springs.driver.h_last);
  for (int i = 0; i < 2; i++) {
    EXPECT_EQ(springs.x(i), same.x(i));
    EXPECT_EQ(springs.v(i), same.v(i));
  }
}

// Evaluations are good for a part of space only: where a candidate went beyond it they are prepared for more
// from the start of the step, and the step begins anew

TEST_P(Schemes, EvaluationsAreAskedForWhereTheyAreGood)
{
  const std::vector<Bubble> away{{1.0, 0.1, 0.1, 0.1, 1.0}};
  Springs free(away, GetParam(), 1.0e-5), fenced(away, GetParam(), 1.0e-5);
  fenced.margin = 0.11;
  free.run_to(1.0);
  fenced.run_to(1.0);
  EXPECT_GE(fenced.extended, 3);    // 0.11, 0.22, 0.44, 0.88
  EXPECT_GT(fenced.margin, fenced.x(0));
  EXPECT_LT(worst(fenced, away, 1.0), fenced.driver.accepted * 1.0e-5);
}

TEST_P(Schemes, StepsThatFallToNothingAreReported)
{
  Springs springs({{1.0, 1.0, 1.0, NAN, 0.0}}, GetParam(), 1.0e-4);
  springs.rkc.spectral.given = 1.0;
  try {
    springs.driver.step(springs);
    FAIL() << "a step of no number was accepted";
  } catch (const std::runtime_error &said) {
    EXPECT_EQ(std::string(said.what()), "fell");
  }
}

// Where drag is strong, the Jacobian has real eigenvalues, and the largest is what the power iteration finds:
// here c/m (1 + sqrt(1 - 4 k m / c^2)) / 2

TEST(Schemes, TheSpectralRadiusIsThatOfTheStiffestBubble)
{
  const std::vector<Bubble> stiff{{1.0, 1.0, 50.0, 1.0, 0.0}, {1.0, 1.0, 300.0, 0.5, 0.0}};
  Springs springs(stiff, true, 1.0e-4);
  springs.driver.step(springs);
  const double most = 150.0 * (1.0 + std::sqrt(1.0 - 4.0 / 9.0e4));
  // iterations end when they change it by 2 %
  EXPECT_NEAR(springs.rkc.spectral.estimated, most, 0.02 * most);
}

// and stages make steps stable for which Euler's would have to be below 2 / 300

TEST(Schemes, StagesTakeLongStepsOfStiffEquations)
{
  const std::vector<Bubble> stiff{{1.0, 1.0, 50.0, 1.0, 0.0}, {1.0, 1.0, 300.0, 0.5, 0.0}};
  Springs springs(stiff, true, 1.0e-4);
  springs.run_to(20.0);
  EXPECT_LT(worst(springs, stiff, 20.0), springs.driver.accepted * 1.0e-4);
  EXPECT_GT(springs.driver.h_last, 10.0 * 2.0 / 300.0);
  EXPECT_LT(springs.evaluations, 20.0 * 300.0 / 2.0 / 4.0);
}

// ---------------------------------------------------------------------- the largest length

// with roots of the few that may be it, and of all: the same number, whatever comes first

TEST(Totals, LargestLengthIsThatOfAllRoots)
{
  const double squares[] = {0.0, 1.0, 2.0, 2.0 + 4e-16, 1e-300, 3.0, 0.25, 1e300};
  const double more[] = {0.0, 0.5, 1e-17, 2.0};
  FoamMax few, all;
  for (double m : more)
    for (double s : squares) {
      few.raise(LAMMPS_NS::FoamLength{s, m});
      all.raise(std::sqrt(s) + m);
      EXPECT_EQ(few.value, all.value) << s << " " << m;
    }
  few.raise(LAMMPS_NS::FoamLength{std::nan(""), 1.0});
  EXPECT_EQ(few.value, all.value);
  EXPECT_FALSE((LAMMPS_NS::FoamLength{std::nan(""), 1.0}.finite()));
}
