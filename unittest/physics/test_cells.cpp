// Pairs found by sizes are those that come near, each once: compared with a look at all pairs.

#include "foam_cells.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace Foam;

namespace {

constexpr double NAN_ = std::numeric_limits<double>::quiet_NaN();
constexpr double INF = std::numeric_limits<double>::infinity();

struct Some {    // bubbles; those from nlocal on are ghosts
  std::vector<std::array<double, 3>> places;
  std::vector<double> radii;
  std::vector<int> tags;
  int nlocal = 0;

  double x(int i, int k) const { return places[i][k]; }
  double radius(int i) const { return radii[i]; }
  int tag(int i) const { return tags[i]; }
  int size() const { return static_cast<int>(radii.size()); }

  void add(const std::array<double, 3> &place, double R, int tag)
  {
    places.push_back(place);
    radii.push_back(R);
    tags.push_back(tag);
  }
};

using Pair = std::array<int, 2>;

template <int D> bool comes_near(const Some &b, int i, int j, const Cells::Near &near)
{
  double square = 0.0;
  for (int k = 0; k < D; k++) square += (b.x(j, k) - b.x(i, k)) * (b.x(j, k) - b.x(i, k));
  const double reach = near.range * (b.radius(i) + b.radius(j)) + near.skin;
  return square < reach * reach;
}

enum class Rows { ONCE, OWN };    // each pair of the foam once, or each of the owned bubbles

template <int D> std::vector<Pair> found(const Some &b, const Cells::Near &near, Rows rows)
{
  Cells cells;
  std::vector<Pair> pairs;
  std::vector<int> room;
  cells.sort<D>(b, b.nlocal, b.size(), near);
  for (int i = 0; i < (rows == Rows::OWN ? b.size() : b.nlocal); i++) {
    const int many = cells.find<D>(b, i, near, room);
    for (int m = 0; m < many; m++) {
      const int j = room[m];
      if (rows == Rows::OWN ? is_in_own_row(b, i, j, b.nlocal) : is_in_row<D>(b, i, j, b.nlocal))
        pairs.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// all pairs with at least one owned bubble

template <int D> std::vector<Pair> all(const Some &b, const Cells::Near &near)
{
  std::vector<Pair> pairs;
  for (int i = 0; i < b.nlocal; i++)
    for (int j = i + 1; j < b.size(); j++)
      if (comes_near<D>(b, i, j, near)) pairs.push_back({i, j});
  return pairs;
}

// bubbles of a periodic box, with ghosts within what the largest two reach

template <int D> Some periodic(int n, double side, double spread, unsigned seed, bool alike = false)
{
  Samples samples(seed);
  Some b;
  double largest = 0.0;
  for (int i = 0; i < n; i++) {
    std::array<double, 3> place{};
    for (int k = 0; k < D; k++) place[k] = samples.uniform(0.0, side);
    b.add(place, alike ? 1.0 : samples.decades(1.0 / spread, spread), i + 1);
    largest = std::max(largest, b.radii.back());
  }
  b.nlocal = n;
  const double reach = 2.0 * largest + 0.3;
  const int images = static_cast<int>(std::ceil(reach / side));
  for (int i = 0; i < n; i++)
    for (int a = -images; a <= images; a++)
      for (int c = -images; c <= images; c++)
        for (int e = D == 3 ? -images : 0; e <= (D == 3 ? images : 0); e++) {
          if (a == 0 && c == 0 && e == 0) continue;
          const std::array<double, 3> shift{a * side, c * side, e * side};
          std::array<double, 3> place = b.places[i];
          bool within = true;
          for (int k = 0; k < D; k++) {
            place[k] += shift[k];
            within &= place[k] > -reach && place[k] < side + reach;
          }
          if (within) b.add(place, b.radii[i], b.tags[i]);
        }
  return b;
}

const Cells::Near CONTACT{1.0, 0.3}, BEYOND{1.15, 0.1}, TOUCH{1.0, 0.0};

template <int D> void each_pair_once_per_owner(const Some &b)
{
  for (const Cells::Near &near : {CONTACT, BEYOND, TOUCH})
    EXPECT_EQ(found<D>(b, near, Rows::OWN), all<D>(b, near));
}

// A pair of a bubble and a ghost is seen twice in a periodic box, from both sides: half of those are in rows

template <int D> void each_pair_once(const Some &b)
{
  const auto rows = found<D>(b, CONTACT, Rows::ONCE), every = all<D>(b, CONTACT);
  const auto owned = [&](const Pair &pair) {
    return pair[1] < b.nlocal;
  };
  std::vector<Pair> own_rows, own_every;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(own_rows), owned);
  std::copy_if(every.begin(), every.end(), std::back_inserter(own_every), owned);
  EXPECT_EQ(own_rows, own_every);
  EXPECT_EQ(2 * (rows.size() - own_rows.size()), every.size() - own_every.size());

  // and of the two sides of a pair only one: the same pair is that of the same IDs with opposite shifts
  struct Seen {
    int low, high;
    double d[3];
  };
  std::vector<Seen> seen;
  for (const Pair &pair : rows) {
    if (owned(pair)) continue;
    const bool turn = b.tag(pair[0]) > b.tag(pair[1]);
    const int i = pair[turn], j = pair[1 - turn];
    Seen now{b.tag(i), b.tag(j), {}};
    for (int k = 0; k < D; k++) now.d[k] = b.x(j, k) - b.x(i, k);
    for (const Seen &one : seen) {
      if (one.low != now.low || one.high != now.high) continue;
      double same = 0.0, opposite = 0.0;
      for (int k = 0; k < D; k++) {
        same = std::max(same, std::abs(one.d[k] - now.d[k]));
        opposite = std::max(opposite, std::abs(one.d[k] + now.d[k]));
      }
      EXPECT_GT(same, 1.0e-6);
      if (now.low == now.high) {
        EXPECT_GT(opposite, 1.0e-6);
      }
    }
    seen.push_back(now);
  }
}

template <int D> Some in_a_row(int n, double step, double R)
{
  Some b;
  for (int i = 0; i < n; i++) b.add({i * step, 0.0, 0.0}, R, i + 1);
  b.nlocal = n;
  return b;
}

}    // namespace

TEST(Cells, FindAllPairsOfOwnedBubbles)
{
  for (unsigned seed = 1; seed <= 5; seed++) {
    each_pair_once_per_owner<2>(periodic<2>(200, 25.0, 3.0, seed));
    each_pair_once_per_owner<3>(periodic<3>(200, 10.0, 3.0, seed));
    each_pair_once_per_owner<3>(periodic<3>(30, 8.0, 10.0, seed));
    each_pair_once_per_owner<2>(periodic<2>(200, 25.0, 1.0, seed, true));
  }
}

TEST(Cells, FindEachPairOfAPeriodicBoxOnce)
{
  for (unsigned seed = 1; seed <= 5; seed++) {
    each_pair_once<2>(periodic<2>(200, 25.0, 3.0, seed));
    each_pair_once<3>(periodic<3>(200, 10.0, 3.0, seed));
    each_pair_once<2>(periodic<2>(200, 25.0, 1.0, seed, true));    // of a size: IDs decide
  }
}

TEST(Cells, FindImagesOfABubbleItself)
{
  for (int n : {1, 2, 5}) {    // wider than the box
    each_pair_once<2>(periodic<2>(n, 1.5, 1.0, 7, true));
    each_pair_once<3>(periodic<3>(n, 1.5, 1.0, 7, true));
    each_pair_once_per_owner<3>(periodic<3>(n, 1.5, 1.0, 7, true));
  }
}

TEST(Cells, OppositeImagesOfATiltedBoxDifferByRounding)
{
  Some b;    // along (1, 1e-17): y says nothing there
  b.add({0.0, 0.0, 0.0}, 1.0, 1);
  b.add({1.0, 1.0e-17, 0.0}, 1.0, 1);
  b.add({-1.0, 1.0e-17, 0.0}, 1.0, 1);
  b.nlocal = 1;
  EXPECT_EQ(found<2>(b, CONTACT, Rows::ONCE).size(), 1u);
}

TEST(Cells, NoneOneAndAllInOnePlace)
{
  for (const Cells::Near &near : {CONTACT, TOUCH}) {
    EXPECT_TRUE(found<3>(Some(), near, Rows::OWN).empty());
    EXPECT_TRUE(found<3>(in_a_row<3>(1, 0.0, 1.0), near, Rows::OWN).empty());
    EXPECT_EQ(found<3>(in_a_row<3>(50, 0.0, 1.0), near, Rows::OWN).size(), 50u * 49u / 2u);
  }
  EXPECT_TRUE(found<2>(in_a_row<2>(50, 0.0, 0.0), TOUCH, Rows::ONCE).empty());    // points
  EXPECT_EQ(found<2>(in_a_row<2>(50, 0.0, 0.0), CONTACT, Rows::ONCE).size(), 50u * 49u / 2u);
}

TEST(Cells, PlacesThatAreNoNumbers)    // others are found as ever
{
  for (double bad : {NAN_, INF, -INF})
    for (int which : {0, 50, 99}) {
      Some b = in_a_row<2>(100, 1.5, 1.0);
      b.places[which][0] = b.places[which][1] = bad;
      EXPECT_EQ(found<2>(b, CONTACT, Rows::OWN), all<2>(b, CONTACT));
    }
}

TEST(Cells, GhostsAlone)    // of a rank without bubbles
{
  Some b = in_a_row<3>(50, 1.5, 1.0);
  b.nlocal = 0;
  EXPECT_TRUE(found<3>(b, CONTACT, Rows::OWN).empty());
}

TEST(Cells, SizesAndDistancesOfAllMagnitudes)
{
  for (double unit : {1.0e-150, 1.0e-9, 1.0, 1.0e9, 1.0e150}) {
    const Cells::Near near{1.0, 0.1 * unit};
    Some b = in_a_row<3>(1000, 1.5 * unit, unit);
    EXPECT_EQ(found<3>(b, near, Rows::OWN).size(), 999u);
    b.radii[500] = 400.0 * unit;    // it touches 2 * 267 others, the last of them by 0.6
    EXPECT_EQ(found<3>(b, near, Rows::OWN), all<3>(b, near));
    b.places[0][0] = -1.0e12 * unit;    // far away
    EXPECT_EQ(found<3>(b, near, Rows::OWN), all<3>(b, near));
  }
}

TEST(Cells, RadiiThatAreNoNumbersTouchNobody)
{
  Some b = in_a_row<2>(100, 1.5, 1.0);
  b.radii[10] = NAN_;
  b.radii[20] = NAN_;
  EXPECT_EQ(found<2>(b, CONTACT, Rows::OWN), all<2>(b, CONTACT));
  EXPECT_EQ(found<2>(b, CONTACT, Rows::OWN).size(), 99u - 4u);
  b.radii[10] = b.radii[20] = 1.0;
  b.radii[30] = INF;    // it touches all
  EXPECT_EQ(found<2>(b, CONTACT, Rows::OWN), all<2>(b, CONTACT));
  for (double &R : b.radii) R = NAN_;
  EXPECT_TRUE(found<2>(b, CONTACT, Rows::OWN).empty());
}
