// A resolved liquid and bubbles in it: each formula against an evaluation of its own.  Names and equations: liquid_physics.h.

#include "liquid_bubbles.h"
#include "liquid_solver.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

using namespace Liquid;

namespace {

double integral(const std::function<double(double)> &f, double lo, double hi, int n = 4000)
{
  double sum = 0.0;    // midpoints: error of (range / n)^2
  for (int m = 0; m < n; m++) sum += f(lo + (hi - lo) * (m + 0.5) / n);
  return sum * (hi - lo) / n;
}

TEST(Kernel, IsOneInAll)
{
  const Kernel W(0.37);
  const double all = integral([&](double r) { return 4.0 * PI * r * r * W(r); }, 0.0, W.reach());
  EXPECT_NEAR(all, 1.0, 1.0e-6);    // of the midpoints
  EXPECT_EQ(W(W.reach()), 0.0);
  EXPECT_EQ(W.slope_over_r(W.reach() * 1.01), 0.0);
}

TEST(Kernel, SlopeIsItsDerivative)
{
  const Kernel W(0.37);
  for (double r : {0.01, 0.2, 0.37, 0.5, 0.7}) {
    const double d = 1.0e-5, slope = (W(r + d) - W(r - d)) / (2.0 * d);
    EXPECT_NEAR(W.slope_over_r(r) * r, slope, 1.0e-7 * std::fabs(W.slope_over_r(0.0)));    // d^2
  }
}

TEST(Correction, IsTheInverse)
{
  Samples samples(1);
  for (int n = 0; n < 100; n++) {
    std::array<double, 6> A{}, L{};
    for (int m = 0; m < 8; m++) {
      double r[3];
      for (double &x : r) x = samples.uniform(-1.0, 1.0);
      for (int k = 0; k < 3; k++) A[k] += r[k] * r[k];
      A[3] += r[0] * r[1];
      A[4] += r[0] * r[2];
      A[5] += r[1] * r[2];
    }
    ASSERT_TRUE(correction(A.data(), L.data()));
    double a[3] = {0.3, -1.0, 2.0}, there[3], back[3];
    multiply(A.data(), a, there);
    multiply(L.data(), there, back);
    for (int k = 0; k < 3; k++) EXPECT_NEAR(back[k], a[k], 1.0e-10);    // conditions of up to 10^4
  }
}

TEST(Correction, IsLeftOutWhereParticlesAreFew)
{
  const double flat[6] = {1.0, 1.0, 0.0, 0.0, 0.0, 0.0}, none[6] = {};
  double L[6];
  for (const double *A : {flat, none}) {
    EXPECT_FALSE(correction(A, L));
    for (int k = 0; k < 6; k++) EXPECT_EQ(L[k], k < 3 ? 1.0 : 0.0);
  }
}

// viscosities scale as a length times a velocity: all lengths by 3, all velocities by 2

TEST(Closures, HaveTheDimensionOfAViscosity)
{
  for (const Closure &closure :
       {Closure{Closure::MIXED, 0.06}, Closure{Closure::SMAGORINSKY, 0.1}}) {
    const double nu = eddy_viscosity(closure, 1.0, 0.1, 5.0, 0.02);
    EXPECT_NEAR(eddy_viscosity(closure, 1.0, 0.3, 5.0 * 2.0 / 3.0, 0.02 * 4.0) / nu, 6.0, 1.0e-13);
  }
  EXPECT_EQ(eddy_viscosity({Closure::NONE, 0.0}, 1.0, 0.1, 5.0, 0.02), 0.0);
}

TEST(Walls, KeepWhatComesThrough)
{
  Walls walls;
  walls.kind[2][0] = Walls::SLIP;
  walls.place[2][0] = 1.0;
  double x = 0.9, u = -2.0;
  EXPECT_TRUE(walls.keep(2, x, u));
  EXPECT_NEAR(x, 1.1, 1.0e-15);
  EXPECT_EQ(u, 0.0);
  double inside = 1.5, down = -1.0;
  EXPECT_FALSE(walls.keep(2, inside, down));
  EXPECT_EQ(down, -1.0);
}

TEST(Walls, ReverseVelocities)
{
  Walls walls;
  walls.kind[0][0] = Walls::SLIP;
  walls.kind[1][0] = walls.kind[2][0] = Walls::NOSLIP;
  const double x[3] = {0.1, 0.1, 0.1};
  const NearWalls near(walls, x, 0.2);
  EXPECT_EQ(near.axes, 7);
  const double u[3] = {1.0, 2.0, 3.0};
  const Image slip = image_across(near, 1), stick = image_across(near, 4),
              edge = image_across(near, 6);
  for (int k = 0; k < 3; k++) {
    EXPECT_EQ(slip.velocity(u[k], k), k == 0 ? -u[k] : u[k]);
    EXPECT_EQ(stick.velocity(u[k], k), -u[k]);
    EXPECT_EQ(edge.velocity(u[k], k), u[k]);    // reversed twice
    EXPECT_EQ(edge.vector(u[k], k), k == 0 ? u[k] : -u[k]);
  }
}

// ---------------------------------------------------------------------- solver

TEST(Solver, FindsTheSolution)
{
  constexpr int N = 60;
  Samples samples(3);
  std::vector<double> value(N * N), dense(N * N, 0.0), exact(N);
  std::vector<int> partner(N * N), size(N), used(N);
  const CloseRows<true> close{partner.data(), size.data(), N, N};
  const Matrix<true> A{close, value.data(), used.data()};
  std::vector<std::vector<double>> v(8, std::vector<double>(N, 0.0));
  const Vectors w{v[0].data(), v[1].data(), v[2].data(), v[3].data(),
                  v[4].data(), v[5].data(), v[6].data(), v[7].data()};
  for (int i = 0; i < N; i++) {
    int count = 0;
    exact[i] = samples.uniform(-1.0, 1.0);
    for (int j = 0; j < N; j++)
      if (j != i && samples.uniform(0.0, 1.0) < 0.2) {
        close.put(i, count, j);
        A.put(i, count++, samples.uniform(0.0, 0.16));
      }
    A.end(i, count, -0.5);
  }
  for (int i = 0; i < N; i++) v[1][i] = A.times(i, exact.data());
  auto ghosts = [](const double *) {
  };
  auto all = [&](const auto &functor) {
    Products sum;
    for (int i = 0; i < N; i++) functor(i, sum);
    return sum;
  };
  auto each = [&](const auto &functor) {
    for (int i = 0; i < N; i++) functor(i);
  };
  const Solved solved = solve(A, w, 1.0e-12, 200, Means{ghosts, all, each});
  EXPECT_EQ(solved.end, Solved::CONVERGED);
  EXPECT_GT(solved.iterations, 3);
  for (int i = 0; i < N; i++) EXPECT_NEAR(v[0][i], exact[i], 1.0e-10);    // 1e-12 of the right side
  EXPECT_EQ(solve(A, w, 1.0e-12, 200, Means{ghosts, all, each}).iterations, 0);    // it is there

  std::fill(v[0].begin(), v[0].end(), 0.0);
  EXPECT_EQ(solve(A, w, 1.0e-12, 2, Means{ghosts, all, each}).end, Solved::SLOW);
  v[1][0] = NAN;
  EXPECT_EQ(solve(A, w, 1.0e-12, 200, Means{ghosts, all, each}).end, Solved::BROKEN);
  std::fill(v[1].begin(), v[1].end(), 0.0);
  EXPECT_EQ(solve(A, w, 1.0e-12, 200, Means{ghosts, all, each}).end, Solved::CONVERGED);    // b = 0
}

// ---------------------------------------------------------------------- bubbles

TEST(Bubbles, DragIsContinuous)
{
  const double a = 1.0e-3, Re = 1.0e5;
  EXPECT_NEAR(drag_coefficient(1000.0), 0.44, 0.002);    // as the law has it
  EXPECT_NEAR(drag_factor(a, 1.0e-13, Re, 800.0) / drag_factor(a, 1.0e-9, Re, 800.0), 1.0,
              1.0e-3);    // Stokes: 0.15 Re_b^0.687
  EXPECT_NEAR(drag_factor(a, 0.0, Re, 800.0) * Re / (6.0 * PI * a * 800.0), 1.0, 1.0e-14);
}

// u' in a steady flow: variances along and across the relative velocity stay (2/3) k, within what 10^5 numbers scatter by,
// sigma^2 sqrt(2/N): four times that

TEST(Bubbles, TurbulenceKeepsItsStrength)
{
  constexpr int N = 100000;
  const double k = 0.3, dt = 0.05, expected = 2.0 / 3.0 * k;
  std::vector<double> x(3 * N, 0.0), v(3 * N, 0.0), f(3 * N, 0.0), radius(N, 0.01), mass(N, 1.0);
  std::vector<int> type(N, 2);
  std::vector<LAMMPS_NS::tagint> tag(N);
  std::vector<std::vector<double>> at(AT_BUBBLES, std::vector<double>(N, 0.0)),
      kept(BUBBLE_STATES, std::vector<double>(N, 0.0));
  BubbleColumns columns;
  for (int c = 0; c < AT_BUBBLES; c++) columns.at[c] = at[c].data();
  for (int c = 0; c < BUBBLE_STATES; c++) columns.kept[c] = kept[c].data();
  for (int i = 0; i < N; i++) tag[i] = i + 1;
  const Foam::HostBubbles b{{x.data()},    {v.data()},   {f.data()},   {radius.data()},
                            {type.data()}, {tag.data()}, {mass.data()}};
  Setting set;
  set.h0 = 0.2;
  for (std::uint64_t step = 0; step < 40; step++) {
    for (int i = 0; i < N; i++) {
      at[TURBULENCE][i] = k;
      at[FLOW][i] = at[FLOW + 1][i] = 0.0;
      at[FLOW + 2][i] = 0.7;
    }
    const AddTurbulence<Foam::HostBubbles> add{b, columns, set, 17 + (step << 24), dt};
    for (int i = 0; i < N; i++) add(i);
  }
  for (int d = 0; d < 3; d++) {
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < N; i++) {
      sum += kept[TURBULENT + d][i];
      square += kept[TURBULENT + d][i] * kept[TURBULENT + d][i];
    }
    EXPECT_NEAR(sum / N, 0.0, 4.0 * std::sqrt(expected / N));
    EXPECT_NEAR(square / N, expected, 4.0 * expected * std::sqrt(2.0 / N));
  }
}

// parts of a bubble that breaks: mean and mean square of V of the smaller part, against the density by quadrature

TEST(Bubbles, BreakAsTheDensitySays)
{
  constexpr int N = 20000;
  for (double Lambda : {0.05, 0.4, 0.8}) {
    const double least = std::max(1.0e-3, std::pow(Lambda, 7.5));
    const double lo = std::cbrt(least), hi = std::cbrt(0.5);
    double moments[3];
    for (int m = 0; m < 3; m++)
      moments[m] = integral(
          [&](double y) { return splits(Lambda, y * y * y) * std::pow(y, 3 * m); }, lo, hi);
    const double mean = moments[1] / moments[0], variance = moments[2] / moments[0] - mean * mean;
    double sum = 0.0;
    for (int i = 0; i < N; i++) {
      const double V = smaller_part(Lambda, Foam::Draws(5, i));
      EXPECT_GE(V, 0.999 * least);
      EXPECT_LE(V, 0.5);
      sum += V;
    }
    EXPECT_NEAR(sum / N, mean, 4.0 * std::sqrt(variance / N));
  }
  EXPECT_EQ(smaller_part(1.01 * std::pow(2.0, -2.0 / 15.0), Foam::Draws(5, 1)),
            0.0);    // too small
}

TEST(Bubbles, DeformWhereEddiesWin)
{
  const double a = 0.01, We = 2.0e4, balance = std::pow(6.0 / (8.2 * a * We), 1.5) / (2.0 * a);
  EXPECT_NEAR(deformation_speed(balance, a, We), 0.0, 1.0e-7);    // sqrt of rounding
  EXPECT_GT(deformation_speed(1.1 * balance, a, We), 0.0);
  EXPECT_LT(deformation_speed(0.9 * balance, a, We), 0.0);
  EXPECT_NEAR(deformation_speed(0.0, a, We), -std::sqrt(6.0 / (a * We)), 1.0e-14);
}

TEST(Bubbles, AreHeldAtTheSurface)
{
  EXPECT_NEAR(nearness(0.353 * 0.5, 0.5), 1.0, 1.0e-14);
  EXPECT_EQ(nearness(1.0, 0.0), 0.0);
  EXPECT_EQ(held_at_surface(0.0), 0.0);
  EXPECT_NEAR(held_at_surface(0.2), 0.5, 1.0e-14);
  EXPECT_GT(held_at_surface(1.0), 0.99);
}

}    // namespace
