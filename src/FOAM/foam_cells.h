/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_CELLS_H
#define LMP_FOAM_CELLS_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

// Who comes near whom, by sizes. A pair is looked for by the larger of its bubbles, i, among those no larger than itself:
// no farther than range 2 R_i + skin. Where most bubbles are small and few are large, most look close by; a list by the
// largest reach of all looks at several times as many.

// Bubbles are sorted into cells about as wide as they look. Those of a cell lie side by side in memory, and so do those
// of cells in a row along x: a bubble looks through a few of such rows.

namespace Foam {

class Cells {
 public:
  struct Near {    // closer than range (R_i + R_j) + skin
    double range, skin;
    double operator()(double sum) const { return range * sum + skin; }
    double farthest(double R) const { return (*this)(2.0 * R); }
  };

  // b: places x(i, k), finite numbers, and radii of n bubbles in D dimensions, the first nlocal of which are no ghosts

  template <int D, class B> void sort(const B &b, int nlocal, int n, const Near &near);

  // Puts those near bubble i that are no larger than it into found, and perhaps itself; returns how many. In the order of
  // cells, and of their numbers in each. Ghosts look where owned bubbles are. Others may look at the same time.

  template <int D, class B>
  int find(const B &b, int i, const Near &near, std::vector<int> &found) const;

  double bytes() const
  {
    return sizeof(int) * double(first.capacity() + cell.capacity() + index.capacity()) +
           sizeof(double) * 4.0 * radius.capacity();
  }

 private:
  double lowest[3], per_width[3];        // corner, cells per length
  double owned_low[3], owned_high[3];    // where those are that are no ghosts
  int count[3];                          // of cells along x, y, z
  int nlocal = 0;                        // of the bubbles
  std::vector<int> first;                // of a cell, [cells + 1]
  std::vector<int> cell;                 // of a bubble
  std::vector<int> index;                // of the bubbles in the order of cells, and their numbers
  std::vector<double> x[3], radius;

  template <int D, class B> void choose_cells(const B &b, int n, const Near &near);
  int along(int k, double place) const    // clamped, also where place is far away or no number
  {
    const double c = (place - lowest[k]) * per_width[k];
    return c > 0.0 ? (c < count[k] ? static_cast<int>(c) : count[k] - 1) : 0;
  }
};

// Cells are as wide as the harmonic mean of what bubbles look: few large ones do not make them wide. Where few bubbles are
// spread far there are not many more cells than bubbles.

template <int D, class B> void Cells::choose_cells(const B &b, int n, const Near &near)
{
  constexpr double CELLS = 8.0;    // per bubble, at most
  constexpr double FINER = 4.0;    // along x: a row begins and ends where it is of use
  double highest[3], narrow = 0.0, longest = 0.0;
  for (int k = 0; k < 3; k++) {
    lowest[k] = highest[k] = k < D && n > 0 ? b.x(0, k) : 0.0;
    owned_low[k] = INFINITY;    // nowhere
    owned_high[k] = -INFINITY;
  }
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < D; k++) {
      const double place = b.x(i, k);
      lowest[k] = std::min(lowest[k], place);
      highest[k] = std::max(highest[k], place);
      if (i + 1 == nlocal) {
        owned_low[k] = lowest[k];
        owned_high[k] = highest[k];
      }
    }
    const double far = near.farthest(b.radius(i));
    if (far > 0.0) narrow += 1.0 / far;
  }
  for (int k = 0; k < D; k++) longest = std::max(longest, highest[k] - lowest[k]);

  double width = std::max(n / narrow, longest / (CELLS * n)), cells;
  if (!(width > 0.0)) width = 1.0;    // all in one place, and nobody looks further
  do {
    cells = 1.0;
    for (int k = 0; k < 3; k++) {
      per_width[k] = (k == 0 ? FINER : 1.0) / width;
      const double whole = std::floor((highest[k] - lowest[k]) * per_width[k]) + 1.0;
      count[k] = whole > 1.0 ? static_cast<int>(std::min(whole, CELLS * n + 1.0)) : 1;
      cells *= count[k];
    }
    width *= 1.5;
  } while (cells > CELLS * n + 1.0);
}

template <int D, class B> void Cells::sort(const B &b, int owned, int n, const Near &near)
{
  nlocal = owned;
  choose_cells<D>(b, n, near);
  first.assign(static_cast<size_t>(count[0]) * count[1] * count[2] + 1, 0);
  cell.resize(n);
  index.resize(n);
  radius.resize(n);
  for (int k = 0; k < D; k++) x[k].resize(n);

  for (int i = 0; i < n; i++) {
    int c = 0;
    for (int k = D - 1; k >= 0; k--) c = c * count[k] + along(k, b.x(i, k));
    cell[i] = c;
    first[c]++;
  }
  int before = 0;
  for (int &begin : first) before += std::exchange(begin, before);
  for (int i = 0; i < n; i++) {
    const int place = first[cell[i]]++;    // from begin to end
    index[place] = i;
    radius[place] = b.radius(i);
    for (int k = 0; k < D; k++) x[k][place] = b.x(i, k);
  }
  std::copy_backward(first.begin(), first.end() - 1, first.end());
  first[0] = 0;
}

template <int D, class B>
int Cells::find(const B &b, int i, const Near &near, std::vector<int> &found) const
{
  const double Ri = b.radius(i), far = near.farthest(Ri);
  const double xi[3] = {b.x(i, 0), b.x(i, 1), D == 3 ? b.x(i, 2) : 0.0};
  int low[3] = {}, high[3] = {};
  for (int k = 0; k < D; k++) {
    double from = xi[k] - far, to = xi[k] + far;
    if (i >= nlocal) {
      from = std::max(from, owned_low[k]);
      to = std::min(to, owned_high[k]);
      if (!(from <= to)) return 0;
    }
    low[k] = along(k, from);
    high[k] = along(k, to);
  }
  const double *const X = x[0].data(), *const Y = x[1].data(), *const Z = x[2].data(),
                      *const R = radius.data();
  int n = 0;
  for (int cz = low[2]; cz <= high[2]; cz++)
    for (int cy = low[1]; cy <= high[1]; cy++) {
      const size_t row = (static_cast<size_t>(cz) * count[1] + cy) * count[0];
      const int begin = first[row + low[0]], end = first[row + high[0] + 1];
      if (found.size() < static_cast<size_t>(n + end - begin)) found.resize(2 * (n + end - begin));
      int *const next = found.data();
      for (int m = begin; m < end; m++) {    // without a branch: nobody can guess who is near
        const double dx = X[m] - xi[0], dy = Y[m] - xi[1], dz = D == 3 ? Z[m] - xi[2] : 0.0;
        const double reach = near(Ri + R[m]);
        next[n] = index[m];
        n += (dx * dx + dy * dy + dz * dz < reach * reach) & (R[m] <= Ri);
      }
    }
  return n;
}

// A pair is in the row of one of its bubbles. Of two of a size it is that of either; with a ghost, that of the same on
// both ranks, which is why IDs take turns; and with an image of its own, that of one of the two that are opposite.

template <int D, class B>
bool is_in_row(const B &b, int i, int j, int nlocal)    // of i, which is no smaller than j
{
  if (b.radius(j) < b.radius(i)) return true;
  if (j < nlocal) return j > i;
  if (b.tag(i) != b.tag(j)) return (b.tag(i) > b.tag(j)) == (((b.tag(i) ^ b.tag(j)) & 1) != 0);

  // sides of a tilted box are added and taken off again: what this leaves of nothing

  constexpr double NOTHING = 1.0e-6;
  double d[3], most = 0.0;
  for (int k = 0; k < D; k++) {
    d[k] = b.x(j, k) - b.x(i, k);
    most = std::max(most, std::abs(d[k]));
  }
  for (int k = D - 1; k > 0; k--)
    if (std::abs(d[k]) > NOTHING * most) return d[k] > 0.0;
  return d[0] > 0.0;
}

// The same where each rank has all pairs of its bubbles: with a ghost in the row of the larger one, be it the ghost.

template <class B> bool is_in_own_row(const B &b, int i, int j, int nlocal)
{
  if (i >= nlocal) return j < nlocal && b.radius(j) < b.radius(i);
  return j >= nlocal || b.radius(j) < b.radius(i) || j > i;
}

}    // namespace Foam

#endif
