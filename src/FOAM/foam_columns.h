/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_COLUMNS_H
#define LMP_FOAM_COLUMNS_H

#include <algorithm>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

// Where columns lie: on the host, or, for a style that runs on a device, on both sides
// (foam_kokkos.h). Who asks for one side gets it up to date, and may write to it.

class FoamStorage {
 public:
  virtual ~FoamStorage() = default;
  virtual void resize(int columns, int length) = 0;    // keeps contents, new numbers are 0
  virtual double *on_host() = 0;
  virtual double *on_device() { return on_host(); }
};

class FoamHostStorage : public FoamStorage {
 public:
  void resize(int columns, int length) override
  {
    std::vector<double> larger(static_cast<size_t>(columns) * length, 0.0);
    const size_t kept = std::min(length, length_before);
    for (int c = 0; c < columns_before; c++)
      std::copy_n(block.begin() + c * static_cast<size_t>(length_before), kept,
                  larger.begin() + c * static_cast<size_t>(length));
    block.swap(larger);
    columns_before = columns;
    length_before = length;
  }
  double *on_host() override { return block.data(); }

 private:
  std::vector<double> block;
  int columns_before = 0, length_before = 0;
};

// Per-bubble numbers that belong together, one contiguous column for each quantity: what a
// fix needs for grow_arrays(), copy_arrays(), exchange and restart. Columns that are not in
// use take no memory and do not travel.

class FoamColumns {
 public:
  explicit FoamColumns(int n) : ncolumns(n), storage(std::make_unique<FoamHostStorage>()) {}

  // elsewhere than on the host alone; to be said before the first use of a number

  void keep_in(std::unique_ptr<FoamStorage> place)
  {
    storage = std::move(place);
    if (in_use()) storage->resize(ncolumns, length);
  }

  bool in_use() const { return length > 0; }
  void use(int nmax)
  {
    if (nmax < 1) nmax = 1;
    if (nmax <= length) return;
    storage->resize(ncolumns, nmax);
    length = nmax;
  }

  int active() const { return in_use() ? ncolumns : 0; }
  int capacity() const { return ncolumns; }
  int rows() const { return length; }
  double *operator[](int c) { return at(storage->on_host(), c); }
  double *on_device(int c) { return in_use() ? at(storage->on_device(), c) : nullptr; }

  void grow(int nmax)
  {
    if (in_use()) use(nmax);
  }
  void copy(int from, int to)
  {
    for (int c = 0; c < active(); c++) (*this)[c][to] = (*this)[c][from];
  }
  void clear(int i)
  {
    for (int c = 0; c < active(); c++) (*this)[c][i] = 0.0;
  }
  int pack(int i, double *buf)
  {
    for (int c = 0; c < active(); c++) *buf++ = (*this)[c][i];
    return active();
  }
  int unpack(int i, const double *buf)
  {
    for (int c = 0; c < active(); c++) (*this)[c][i] = *buf++;
    return active();
  }
  double bytes() const { return sizeof(double) * double(active()) * length; }

 private:
  int ncolumns, length = 0;
  std::unique_ptr<FoamStorage> storage;

  double *at(double *block, int c) const { return block + static_cast<size_t>(c) * length; }
};

}    // namespace LAMMPS_NS

#endif
