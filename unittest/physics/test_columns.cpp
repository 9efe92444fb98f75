// Per-bubble numbers on their way between bubbles, ranks and restart files.

#include "foam_columns.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

using LAMMPS_NS::FoamColumnList;
using LAMMPS_NS::FoamColumns;
using LAMMPS_NS::FoamHostStorage;
using LAMMPS_NS::FoamStorage;

static FoamColumnList shelf;    // where nobody looks at it

TEST(Columns, UnusedOnesTakeNothing)
{
  FoamColumns columns(shelf, "columns", 3);
  double buf[3] = {1.0, 2.0, 3.0};
  EXPECT_FALSE(columns.in_use());
  EXPECT_EQ(columns.active(), 0);
  EXPECT_EQ(columns.capacity(), 3);
  EXPECT_EQ(columns.pack(0, buf), 0);
  EXPECT_EQ(columns.unpack(0, buf), 0);
  EXPECT_EQ(columns.bytes(), 0.0);
  columns.grow(10);    // all of these are no-ops
  columns.copy(1, 0);
  columns.clear(0);
}

TEST(Columns, PackAndUnpackAreInverse)
{
  FoamColumns columns(shelf, "columns", 3);
  columns.use(4);
  ASSERT_TRUE(columns.in_use());
  for (int c = 0; c < 3; c++) columns[c][1] = 10.0 + c;
  double buf[3];
  EXPECT_EQ(columns.pack(1, buf), 3);
  EXPECT_EQ(columns.unpack(3, buf), 3);
  for (int c = 0; c < 3; c++) EXPECT_EQ(columns[c][3], 10.0 + c);
}

TEST(Columns, GrowingKeepsValuesAndFillsWithZero)
{
  FoamColumns columns(shelf, "columns", 2);
  columns.use(2);
  columns[0][1] = 5.0;
  columns.grow(100);
  EXPECT_EQ(columns[0][1], 5.0);
  EXPECT_EQ(columns[1][99], 0.0);
  columns.grow(10);    // never shrinks
  EXPECT_EQ(columns[0][99], 0.0);
  EXPECT_EQ(columns.bytes(), 2.0 * 100.0 * sizeof(double));
}

TEST(Columns, GrowingAgainAndAgain)
{
  FoamColumns columns(shelf, "columns", 3);
  columns.use(0);    // a rank without bubbles
  EXPECT_TRUE(columns.in_use());
  EXPECT_EQ(columns.rows(), 1);
  int before = 0;
  for (int rows : {1, 2, 7, 64, 1000, 16384}) {
    columns.use(rows);
    ASSERT_EQ(columns.rows(), rows);
    for (int c = 0; c < 3; c++) {
      EXPECT_EQ(columns[c] - columns[0], c * rows);    // one after the other
      for (int i = 0; i < rows; i++) {
        ASSERT_EQ(columns[c][i], i < before ? 1000.0 * i + c : 0.0);
        columns[c][i] = 1000.0 * i + c;
      }
    }
    before = rows;
  }
  columns.use(10);    // enough room: nothing moves
  EXPECT_EQ(columns.rows(), 16384);
  EXPECT_EQ(columns[2][16383], 1000.0 * 16383 + 2);
}

// Memory in two places, as on a device: the copy that is not up to date is spoilt

namespace {

class TwoSides : public FoamStorage {
 public:
  struct Log {
    std::vector<std::pair<int, int>> sizes;
    int copies = 0;
  };
  explicit TwoSides(Log &l) : log(l) {}

  void resize(int columns, int length) override
  {
    log.sizes.emplace_back(columns, length);
    on_host();
    here.resize(columns, length);
    there.assign(columns * length, -1.0);
  }
  double *on_host() override
  {
    if (device_has_it) bring(here.on_host(), there.data());
    device_has_it = false;
    return here.on_host();
  }
  double *on_device() override
  {
    if (!device_has_it) bring(there.data(), here.on_host());
    device_has_it = true;
    return there.data();
  }

 private:
  Log &log;
  FoamHostStorage here;
  std::vector<double> there;
  bool device_has_it = false;

  void bring(double *to, double *from)
  {
    for (size_t i = 0; i < there.size(); i++) to[i] = std::exchange(from[i], -1.0);
    log.copies++;
  }
};

}    // namespace

TEST(Columns, KeptElsewhere)
{
  TwoSides::Log log;
  FoamColumns columns(shelf, "columns", 2);
  columns.keep_in(std::make_unique<TwoSides>(log));
  EXPECT_EQ(columns.on_device(1), nullptr);    // not in use: nothing there, nothing moved
  EXPECT_TRUE(log.sizes.empty());

  columns.use(4);
  ASSERT_EQ(log.sizes.size(), 1u);
  EXPECT_EQ(log.sizes[0], std::pair(2, 4));
  columns[1][3] = 7.0;
  EXPECT_EQ(log.copies, 0);
  EXPECT_EQ(columns.on_device(1)[3], 7.0);
  columns.on_device(1)[3] = 8.0;
  EXPECT_EQ(log.copies, 1);    // all columns at once, and once
  double buf[2];
  EXPECT_EQ(columns.pack(3, buf), 2);    // on the host
  EXPECT_EQ(buf[1], 8.0);
  EXPECT_EQ(log.copies, 2);
  columns.on_device(0)[3] = 9.0;
  columns.use(6);    // what the device has is kept
  EXPECT_EQ(columns[0][3], 9.0);
  EXPECT_EQ(columns[1][3], 8.0);
}

TEST(Columns, InUseBeforeTheyAreKeptElsewhere)
{
  TwoSides::Log log;
  FoamColumns columns(shelf, "columns", 2);
  columns.use(5);
  columns.keep_in(std::make_unique<TwoSides>(log));
  ASSERT_EQ(log.sizes.size(), 1u);
  EXPECT_EQ(log.sizes[0], std::pair(2, 5));
  EXPECT_EQ(columns[1][4], 0.0);
}

TEST(Columns, CopyAndClear)
{
  FoamColumns columns(shelf, "columns", 2);
  columns.use(3);
  columns[0][2] = 1.0;
  columns[1][2] = 2.0;
  columns.copy(2, 0);
  columns.clear(2);
  EXPECT_EQ(columns[0][0], 1.0);
  EXPECT_EQ(columns[1][0], 2.0);
  EXPECT_EQ(columns[0][2], 0.0);
  EXPECT_EQ(columns[1][2], 0.0);
}

TEST(Columns, MoreOfThem)
{
  TwoSides::Log log;
  FoamColumns columns(shelf, "columns", 2);
  columns.keep_in(std::make_unique<TwoSides>(log));
  columns.widen(3);    // not in use: nothing there
  EXPECT_TRUE(log.sizes.empty());
  columns.use(4);
  columns[2][3] = 5.0;
  columns.on_device(0)[1] = 7.0;
  columns.widen(5);
  EXPECT_EQ(log.sizes.back(), std::pair(5, 4));
  EXPECT_EQ(columns.active(), 5);
  EXPECT_EQ(columns[0][1], 7.0);
  EXPECT_EQ(columns[2][3], 5.0);
  EXPECT_EQ(columns[4][3], 0.0);
  columns.widen(2);    // never fewer
  EXPECT_EQ(columns.capacity(), 5);
}

TEST(Columns, Swapped)
{
  FoamColumns one(shelf, "one", 2), other(shelf, "other", 3);
  one.use(4);
  other.use(6);
  one[1][3] = 1.0;
  other[2][5] = 2.0;
  one.swap(other);
  EXPECT_EQ(one.rows(), 6);
  EXPECT_EQ(one.active(), 3);
  EXPECT_EQ(one[2][5], 2.0);
  EXPECT_EQ(other[1][3], 1.0);
  EXPECT_STREQ(one.name, "one");
}
