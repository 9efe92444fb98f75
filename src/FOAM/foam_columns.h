/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_COLUMNS_H
#define LMP_FOAM_COLUMNS_H

#include <vector>

namespace LAMMPS_NS {

// Per-bubble numbers that travel with the bubbles, one contiguous column for each
// quantity: what a fix needs for grow_arrays(), copy_arrays(), exchange and restart.
// Columns that are not in use take no memory and do not travel.

class FoamColumns {
 public:
  explicit FoamColumns(int n) : ncolumns(n) {}

  bool in_use() const { return !columns.empty(); }
  void use(int nmax)
  {
    columns.resize(ncolumns);
    grow(nmax);
  }

  int active() const { return columns.size(); }
  int capacity() const { return ncolumns; }
  double *operator[](int c) { return columns[c].data(); }
  const double *operator[](int c) const { return columns[c].data(); }

  void grow(int nmax)
  {
    for (auto &column : columns)
      if (nmax > static_cast<int>(column.size())) column.resize(nmax, 0.0);
  }
  void copy(int from, int to)
  {
    for (auto &column : columns) column[to] = column[from];
  }
  void clear(int i)
  {
    for (auto &column : columns) column[i] = 0.0;
  }
  int pack(int i, double *buf) const
  {
    for (const auto &column : columns) *buf++ = column[i];
    return active();
  }
  int unpack(int i, const double *buf)
  {
    for (auto &column : columns) column[i] = *buf++;
    return active();
  }
  double bytes() const
  {
    return in_use() ? sizeof(double) * active() * double(columns[0].size()) : 0;
  }

 private:
  int ncolumns;
  std::vector<std::vector<double>> columns;
};

}    // namespace LAMMPS_NS

#endif
