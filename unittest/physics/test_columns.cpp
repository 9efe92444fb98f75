// Per-bubble numbers on their way between bubbles, ranks and restart files.

#include "foam_columns.h"

#include <gtest/gtest.h>

using LAMMPS_NS::FoamColumns;

TEST(Columns, UnusedOnesTakeNothing)
{
  FoamColumns columns(3);
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
  FoamColumns columns(3);
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
  FoamColumns columns(2);
  columns.use(2);
  columns[0][1] = 5.0;
  columns.grow(100);
  EXPECT_EQ(columns[0][1], 5.0);
  EXPECT_EQ(columns[1][99], 0.0);
  columns.grow(10);    // never shrinks
  EXPECT_EQ(columns[0][99], 0.0);
  EXPECT_EQ(columns.bytes(), 2.0 * 100.0 * sizeof(double));
}

TEST(Columns, CopyAndClear)
{
  FoamColumns columns(2);
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
