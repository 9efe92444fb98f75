/* ----------------------------------------------------------------------
   Wet foams for LAMMPS: a test of where columns are read and written.
   Distributed under the GNU General Public License, version 2: see LICENSE.
------------------------------------------------------------------------- */

// Columns on a host and a device that are different memory, on a machine that has no device: two blocks,
// of which only the one that was asked for last is good. The other one is filled with NaN, so that a pointer
// that was handed out too early, or to the wrong side, shows in the next number.
//
// Two mistakes can be made on purpose, by environment variables that name columns:
//   FOAM_POISON_FORGET=NAME    these are not put on the device: they stay in memory of the host
//   FOAM_POISON_LEAVE=NAME     these are not copied when the side changes

#ifndef LMP_FOAM_POISONED_STORAGE_H
#define LMP_FOAM_POISONED_STORAGE_H

#include "foam_columns.h"

#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FoamPoisonedStorage : public FoamStorage {
 public:
  explicit FoamPoisonedStorage(bool copies) : copies(copies) {}

  void resize(int columns, int length) override
  {
    FoamHostStorage larger;
    larger.resize(columns_now, length_now);
    std::copy(good().begin(), good().end(), larger.on_host());
    larger.resize(columns, length);
    columns_now = columns;
    length_now = length;
    const size_t size = static_cast<size_t>(columns) * length;
    good().assign(larger.on_host(), larger.on_host() + size);
    stale().assign(size, NAN_);
  }
  double *on_host() override { return side(false); }
  double *on_device() override { return side(true); }

 private:
  static constexpr double NAN_ = std::numeric_limits<double>::quiet_NaN();
  const bool copies;
  std::vector<double> block[2];    // host, device
  bool there = false;              // which is good
  int columns_now = 0, length_now = 0;

  std::vector<double> &good() { return block[there]; }
  std::vector<double> &stale() { return block[!there]; }

  double *side(bool device)
  {
    if (device != there) {
      if (copies) stale() = good();
      good().assign(good().size(), NAN_);
      there = device;
    }
    return good().data();
  }
};

inline std::unique_ptr<FoamStorage> foam_poisoned_storage(const char *name)
{
  auto chosen = [&](const char *variable) {
    const char *const columns = std::getenv(variable);
    return columns && std::string(columns) == name;
  };
  if (chosen("FOAM_POISON_FORGET")) return std::make_unique<FoamHostStorage>();
  return std::make_unique<FoamPoisonedStorage>(!chosen("FOAM_POISON_LEAVE"));
}

}    // namespace LAMMPS_NS

#endif
