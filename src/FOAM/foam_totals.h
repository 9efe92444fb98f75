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

#include <cmath>

namespace LAMMPS_NS {

// What is summed up over bubbles, and what is the largest: members of structs that have nothing else, and
// whose join() makes one of two.  They are joined on the host, on a device, and over all ranks.

struct FoamSum {
  double value = 0.0;
  FOAM_FUNCTION operator double() const { return value; }
  FOAM_FUNCTION void operator+=(double more) { value += more; }
  FOAM_FUNCTION void join(const FoamSum &other) { value += other.value; }
};

// sqrt(square) + more.  Of many lengths few are the largest so far, and only these need their root.

struct FoamLength {
  double square, more;
  FOAM_FUNCTION operator double() const { return std::sqrt(square) + more; }
  FOAM_FUNCTION bool finite() const { return std::isfinite(square + more); }
  FOAM_FUNCTION bool surely_below(double other) const    // whatever rounding does
  {
    const double rest = other - more;
    return rest > 0.0 && square < (1.0 - 1.0e-15) * rest * rest;
  }
};

struct FoamMax {    // of numbers >= 0; NaN is none
  double value = 0.0;
  FOAM_FUNCTION operator double() const { return value; }
  FOAM_FUNCTION void raise(double other)
  {
    if (other > value) value = other;
  }
  FOAM_FUNCTION void raise(const FoamLength &other)
  {
    if (!other.surely_below(value)) raise(static_cast<double>(other));
  }
  FOAM_FUNCTION void join(const FoamMax &other) { raise(other.value); }
};

}    // namespace LAMMPS_NS

#endif
