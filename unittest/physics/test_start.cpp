// The start of a foam: numbers of each bubble, radii, sites and displacements.

#include "foam_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

using namespace Foam;

namespace {

constexpr std::uint64_t MANY = 200000;

struct Moments {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double x)
  {
    n++;
    sum += x;
    squares += x * x;
  }
  double mean() const { return sum / n; }
  double variance() const { return squares / n - mean() * mean(); }
};

Moments moments_of(const Sizes &sizes)
{
  Moments m;
  for (std::uint64_t n = 0; n < MANY; n++) m.add(sizes.radius(Draws(7, n), n, MANY));
  return m;
}

}    // namespace

// five standard errors of a mean, sigma / sqrt(n): one in a million draws of the seed fails

TEST(Start, UniformNumbers)
{
  for (unsigned k : {0u, 1u, 11u}) {
    Moments m;
    double least = 1.0, most = 0.0;
    for (std::uint64_t n = 0; n < MANY; n++) {
      const double u = Draws(1, n).uniform(k);
      least = std::min(least, u);
      most = std::max(most, u);
      m.add(u);
    }
    EXPECT_GT(least, 0.0);
    EXPECT_LT(most, 1.0);
    EXPECT_NEAR(m.mean(), 0.5, 5.0 * std::sqrt(1.0 / 12.0 / MANY));
    EXPECT_NEAR(m.variance(), 1.0 / 12.0, 5.0 * std::sqrt(1.0 / 180.0 / MANY));
  }
}

// of other seeds, bubbles, numbers: no correlation above five standard errors, none the same

TEST(Start, NumbersOfTheirOwn)
{
  auto correlation = [](auto one, auto other) {
    double sum = 0.0;
    for (std::uint64_t n = 0; n < MANY; n++) sum += (one(n) - 0.5) * (other(n) - 0.5);
    return 12.0 * sum / MANY;
  };
  auto plain = [](std::uint64_t n) {
    return Draws(1, n).uniform(0);
  };
  EXPECT_NEAR(correlation(plain, plain), 1.0, 0.02);
  const double limit = 5.0 / std::sqrt(double(MANY));
  EXPECT_NEAR(correlation(plain, [](auto n) { return Draws(2, n).uniform(0); }), 0.0, limit);
  EXPECT_NEAR(correlation(plain, [](auto n) { return Draws(1, n + 1).uniform(0); }), 0.0, limit);
  EXPECT_NEAR(correlation(plain, [](auto n) { return Draws(1, n).uniform(1); }), 0.0, limit);

  std::set<double> all;
  for (std::uint64_t seed : {1, 2})
    for (std::uint64_t n = 0; n < 1000; n++)
      for (unsigned k = 0; k < 12; k++) all.insert(Draws(seed, n).uniform(k));
  EXPECT_EQ(all.size(), 24000u);
}

TEST(Start, NormalNumbers)
{
  Moments m, fourth;
  for (std::uint64_t n = 0; n < MANY; n++) {
    const double g = Draws(3, n).normal(SIZE);
    m.add(g);
    fourth.add(g * g * g * g);
  }
  EXPECT_NEAR(m.mean(), 0.0, 5.0 / std::sqrt(double(MANY)));
  EXPECT_NEAR(m.variance(), 1.0, 5.0 * std::sqrt(2.0 / MANY));
  EXPECT_NEAR(fourth.mean(), 3.0, 5.0 * std::sqrt(96.0 / MANY));
}

// means and variances as the command promises; rmin so small that it lifts none

TEST(Start, DistributionsOfRadii)
{
  const double few = 5.0 / std::sqrt(double(MANY));
  Sizes sizes;
  sizes.rmin = 1.0e-9;
  sizes.mean = 2.0;
  sizes.kind = Sizes::EQUAL;
  EXPECT_EQ(moments_of(sizes).mean(), 2.0);

  sizes.kind = Sizes::NORMAL;
  sizes.std = 0.3;
  EXPECT_NEAR(moments_of(sizes).mean(), 2.0, few * 0.3);
  EXPECT_NEAR(moments_of(sizes).variance(), 0.09, few * 0.09 * std::sqrt(2.0));

  sizes.kind = Sizes::LOGNORMAL;
  sizes.std = 1.0;
  EXPECT_NEAR(moments_of(sizes).mean(), 2.0, few * 1.0);
  EXPECT_NEAR(moments_of(sizes).variance(), 1.0, few * 4.0);    // its kurtosis is 8.9

  sizes.kind = Sizes::BIDISPERSE;
  sizes.ratio = 3.0;
  sizes.share = 0.25;
  const Moments m = moments_of(sizes);
  EXPECT_NEAR(m.mean(), 2.0, few * std::sqrt(m.variance()));
  EXPECT_NEAR(m.variance(), 0.25 * 0.75 * std::pow(2.0 / 1.5 * 2.0, 2), few * 4.0);

  sizes.rmin = 0.9;    // the small ones, of 4/3, are lifted to 1.8
  EXPECT_NEAR(moments_of(sizes).mean(), 0.75 * 1.8 + 0.25 * 4.0, few * 2.0);
}

TEST(Start, NoRadiusBelowTheSmallest)
{
  Sizes sizes;
  sizes.std = 5.0;
  for (std::uint64_t n = 0; n < 10000; n++)
    EXPECT_GE(sizes.radius(Draws(1, n), n, 10000), 0.1) << n;
}

TEST(Start, ListedRadii)
{
  Sizes sizes;
  sizes.kind = Sizes::LISTED;
  sizes.listed = {1.0, 2.0, 3.0};
  sizes.mean = 2.0;
  for (std::uint64_t n = 0; n < 3; n++) EXPECT_EQ(sizes.radius(Draws(1, n), n, 3), n + 1.0);
  int times[4] = {};
  for (std::uint64_t n = 0; n < 30000; n++)
    times[static_cast<int>(sizes.radius(Draws(1, n), n, 30000))]++;
  for (int k : {1, 2, 3}) EXPECT_NEAR(times[k], 10000, 5.0 * std::sqrt(30000.0 * 2.0 / 9.0));
}

// room for all, in whole rows, and no row or layer more than that

TEST(Start, Grid)
{
  for (int dim : {2, 3})
    for (std::int64_t n : {1ll, 2ll, 7ll, 100ll, 1000ll, 12345ll, 100000000ll})
      for (const auto &relative :
           {std::array<double, 3>{1, 1, 1}, {4, 1, 1}, {1, 9, 1}, {0.01, 1, 5}}) {
        const double lengths[3] = {relative[0], relative[1], relative[2]};
        const Grid grid(dim, n, lengths);
        const std::int64_t last = grid.sites[dim - 1],
                           layer = grid.sites[0] * (dim == 3 ? grid.sites[1] : 1);
        EXPECT_GE(layer * last, n);
        EXPECT_LT(layer * (last - 1), n);
        if (dim == 2) EXPECT_EQ(grid.sites[2], 1);
      }
  const double square[3] = {1.0, 1.0, 1.0}, flat[3] = {2.0, 2.0, 1.0};
  const Grid a(2, 10000, square), b(3, 4000, flat);
  EXPECT_EQ(a.sites[0], 100);
  EXPECT_EQ(a.sites[1], 100);
  EXPECT_EQ(b.sites[0], 20);
  EXPECT_EQ(b.sites[1], 20);
  EXPECT_EQ(b.sites[2], 10);

  std::set<std::array<double, 3>> places;    // each site once
  for (std::int64_t n = 0; n < 4000; n++)
    places.insert({b.centre(0, n), b.centre(1, n), b.centre(2, n)});
  EXPECT_EQ(places.size(), 4000u);
  EXPECT_EQ((*places.begin()), (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_EQ((*places.rbegin()), (std::array<double, 3>{19.5, 19.5, 9.5}));

  // 13 sites of 16 in use: each once, and no two in succession stay empty
  const Grid loose(2, 13, square);
  EXPECT_EQ(loose.all, 16);
  std::int64_t last_site = -1;
  for (std::int64_t n = 0; n < 13; n++) {
    const auto site =
        static_cast<std::int64_t>(loose.centre(0, n) + 4.0 * (loose.centre(1, n) - 0.5));
    EXPECT_GT(site, last_site);
    EXPECT_LE(site, last_site + 2);
    last_site = site;
  }
}

// uniform in length, and in direction: no mean, and as much in each

TEST(Start, Displacements)
{
  for (int dim : {2, 3}) {
    Moments length, each[3];
    for (std::uint64_t n = 0; n < MANY; n++) {
      double by[3];
      displacement(dim, Draws(5, n), by);
      length.add(std::hypot(by[0], by[1], by[2]));
      for (int k = 0; k < 3; k++) each[k].add(by[k]);
    }
    EXPECT_NEAR(length.mean(), 0.5, 5.0 * std::sqrt(1.0 / 12.0 / MANY));
    EXPECT_NEAR(length.variance(), 1.0 / 12.0, 5.0 * std::sqrt(1.0 / 180.0 / MANY));
    for (int k = 0; k < dim; k++) {    // <l^2> = 1/3, shared by dim directions
      EXPECT_NEAR(each[k].mean(), 0.0, 5.0 * std::sqrt(1.0 / 3.0 / dim / MANY));
      EXPECT_NEAR(each[k].variance(), 1.0 / 3.0 / dim, 5.0 / std::sqrt(double(MANY)));
    }
    if (dim == 2) EXPECT_EQ(each[2].squares, 0.0);
  }
}
