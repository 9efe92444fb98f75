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
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

// Where columns lie: on the host, or, for a style that runs on a device, on both sides
// (foam_kokkos.h). Who asks for one side gets it up to date, and may write to it. So what was handed
// out of the other side is outdated from then on.

class FoamStorage {
 public:
  virtual ~FoamStorage() = default;
  virtual void resize(int columns, int length) = 0;    // keeps contents, new numbers are 0
  virtual double *on_host() = 0;
  virtual double *on_device() = 0;
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
  double *on_device() override    // a kernel would read memory of the host
  {
    throw std::logic_error("columns that are kept on the host alone");
  }

 private:
  std::vector<double> block;
  int columns_before = 0, length_before = 0;
};

// All columns of a style, in the order of their declaration. Each announces itself, so that none is
// forgotten where they are put on a device, sent, grown or counted.

class FoamColumns;
using FoamColumnList = std::vector<FoamColumns *>;

// Per-bubble numbers that belong together, one contiguous column for each quantity: what a
// fix needs for grow_arrays(), copy_arrays(), exchange and restart. Columns that are not in
// use take no memory and do not travel.  What the kind means is up to the style: see chosen().

class FoamColumns {
 public:
  FoamColumns(FoamColumnList &all, const char *name, int n, unsigned kind = 0)
      : name(name), kind(kind), ncolumns(n), storage(std::make_unique<FoamHostStorage>())
  {
    all.push_back(this);
  }
  FoamColumns(const FoamColumns &) = delete;
  FoamColumns &operator=(const FoamColumns &) = delete;

  const char *const name;
  const unsigned kind;

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

  void widen(int n)    // to more columns: contents are kept, new numbers are 0
  {
    if (n <= ncolumns) return;
    if (in_use()) storage->resize(n, length);
    ncolumns = n;
  }
  void swap(FoamColumns &other)    // numbers, not names
  {
    storage.swap(other.storage);
    std::swap(ncolumns, other.ncolumns);
    std::swap(length, other.length);
  }

  int active() const { return in_use() ? ncolumns : 0; }
  int capacity() const { return ncolumns; }
  int rows() const { return length; }
  double *operator[](int c) { return at(storage->on_host(), c); }
  double *on_device(int c)
  {
    if (!in_use()) return nullptr;
    try {
      return at(storage->on_device(), c);
    } catch (std::logic_error &wrong) {
      throw std::logic_error(std::string("Foam package: ") + name + " are " + wrong.what());
    }
  }

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

inline FoamColumnList chosen(const FoamColumnList &all, unsigned kinds)
{
  FoamColumnList some;
  for (FoamColumns *columns : all)
    if (columns->kind & kinds) some.push_back(columns);
  return some;
}

inline int capacity(const FoamColumnList &all)    // numbers of a bubble, if all are in use
{
  int n = 0;
  for (const FoamColumns *columns : all) n += columns->capacity();
  return n;
}

inline double bytes(const FoamColumnList &all)
{
  double sum = 0.0;
  for (const FoamColumns *columns : all) sum += columns->bytes();
  return sum;
}

}    // namespace LAMMPS_NS

#endif
