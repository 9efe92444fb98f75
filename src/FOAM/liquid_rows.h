/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_ROWS_H
#define LMP_LIQUID_ROWS_H

#include "foam_totals.h"
#include "liquid_physics.h"
#include "liquid_walls.h"

#include <cmath>
#include <cstddef>
#include <type_traits>

// Neighbors of a particle: those within 2 h of it in this step.  LAMMPS' lists reach further, by the skin and, where there are
// bubbles, by what h may grow: they have twice as many, or more.  So each step looks through them once, and what is found
// is what five loops and all iterations of the pressure go through.

namespace Liquid {

// A row for each particle: its partners one after the other on a host, those of one place in all rows on a device.  Rows that lie
// close together are read faster: a width that most rows leave empty takes the caches twice.  So it is found by trying: a
// row that is longer than there is room says so by its size.

template <bool BY_ROWS> struct CloseRows {
  int *partner, *size;
  size_t rows, width;    // room for so many

  FOAM_FUNCTION size_t at(int i, int m) const { return BY_ROWS ? i * width + m : m * rows + i; }
  FOAM_FUNCTION void put(int i, int m, int j) const
  {
    if (static_cast<size_t>(m) < width) partner[at(i, m)] = j;
  }
};

struct LongestRow {
  static constexpr const char *NAME = "liquid: longest row";
  const int *size;
  FOAM_FUNCTION void operator()(int i, LAMMPS_NS::FoamMax &all) const { all.raise(size[i]); }
};

// Close rows, as loops go through the rows of a list

template <class List, bool BY_ROWS> struct CloseList {
  List list;
  CloseRows<BY_ROWS> close;

  struct Row {
    int i, size;
    CloseRows<BY_ROWS> close;
    template <class Visit> FOAM_ALWAYS_INLINE void for_each(const Visit &visit) const
    {
      for (int m = 0; m < size; m++) visit(close.partner[close.at(i, m)], std::true_type());
    }
  };
  FOAM_FUNCTION Row row(int n) const
  {
    const int i = list.row(n).i;
    return {i, close.size[i], close};
  }
};

template <class B, class Which>
FOAM_FUNCTION double separation(const B &b, const double *x, int j, const Which &image, double *r)
{
  double square = 0.0;
  for (int k = 0; k < 3; k++) {
    r[k] = x[k] - image.coordinate(b.x(j, k), k);
    square += r[k] * r[k];
  }
  return square;
}

// All of a list are written, and one that is not a neighbor is written over by the next: a branch, which no processor foresees
// here, would cost more than all else.  Between walls no image is nearer than its particle: whose image is a neighbor, is one.

template <class B, class List, bool BY_ROWS> struct FindClose {
  static constexpr const char *NAME = "liquid: find neighbors";
  B b;
  List list;
  const double *h;
  CloseRows<BY_ROWS> close;
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = list.row(n);
    const int i = row.i;
    const double x[3] = {b.x(i, 0), b.x(i, 1), b.x(i, 2)}, reach = SUPPORT * h[i];
    int size = 0;
    row.for_each([&](int j, auto) {
      double r[3];
      close.put(i, size, j);
      size += separation(b, x, j, Itself(), r) < reach * reach;
    });
    close.size[i] = size;
  }
};

// Neighbors of a particle, and images of them and, if the row is one of close ones, of itself: visit(j, r_i - r_j, distance,
// image).  All of a close row are visited, so that entries of the matrix have the places of their neighbors.

template <bool CLOSE, class Row, class B, class Visit>
FOAM_ALWAYS_INLINE void neighbors(const Row &row, const B &b, const Walls &walls, double h,
                                  const Visit &visit)
{
  const int i = row.i;
  const double x[3] = {b.x(i, 0), b.x(i, 1), b.x(i, 2)}, reach = SUPPORT * h;
  const NearWalls near(walls, x, reach);
  auto look = [&](int j, const auto &image) {
    double r[3];
    const double square = separation(b, x, j, image, r);
    if ((CLOSE && image.axes == 0) || square < reach * reach) visit(j, r, std::sqrt(square), image);
  };
  auto images = [&](int j) {
    for (int axes = 1; axes < 8; axes++)
      if ((axes & near.axes) == axes) look(j, image_across(near, axes));
  };
  row.for_each([&](int j, auto) {
    look(j, Itself());
    if (near.axes) images(j);
  });
  if (CLOSE && near.axes) images(i);
}

}    // namespace Liquid

#endif
