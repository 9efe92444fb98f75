/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_TOTALS_H
#define LMP_FOAM_TOTALS_H

#include "foam_physics.h"

namespace LAMMPS_NS {

// What is summed up over bubbles, and what is the largest: members of structs that have nothing else, and
// whose join() makes one of two.  They are joined on the host, on a device, and over all ranks.

struct FoamSum {
  double value = 0.0;
  FOAM_FUNCTION operator double() const { return value; }
  FOAM_FUNCTION void operator+=(double more) { value += more; }
  FOAM_FUNCTION void join(const FoamSum &other) { value += other.value; }
};

struct FoamMax {    // of numbers >= 0; NaN is none
  double value = 0.0;
  FOAM_FUNCTION operator double() const { return value; }
  FOAM_FUNCTION void raise(double other)
  {
    if (other > value) value = other;
  }
  FOAM_FUNCTION void join(const FoamMax &other) { raise(other.value); }
};

}    // namespace LAMMPS_NS

#endif
