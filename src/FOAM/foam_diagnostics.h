/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_DIAGNOSTICS_H
#define LMP_FOAM_DIAGNOSTICS_H

#include "foam_gas.h"

#include <iterator>

// Per-bubble diagnostics: what compute foam/bubble shows

namespace Foam {

// a name for users behind each

enum class Quantity { CONTACTS, AREA, FREE, VFILM, VLIQUID, RDOT, ESPRING, EDURIAN };

inline constexpr const char *QUANTITIES[] = {"contacts", "area", "free",    "vfilm",
                                             "vliquid",  "rdot", "espring", "edurian"};

struct Quantities {
  static constexpr int MOST = std::size(QUANTITIES);
  int count = 0;
  Quantity name[MOST];
};

template <int D, class B, class Masks> struct FillDiagnostics {
  static constexpr const char *NAME = "foam: diagnostics";
  B b;
  Masks mask;
  int groupbits;    // of the compute, and of the bubbles
  double *out;      // [n][wanted.count]
  Quantities wanted;
  Exchange<D> gas;    // with walls, even if there is no exchange
  ContactSums sums;

  FOAM_FUNCTION void operator()(int i) const
  {
    const double R = b.radius(i);
    const bool counts = (mask(i) & groupbits) == groupbits;
    const typename Exchange<D>::Split V = gas(b, i);
    for (int c = 0; c < wanted.count; c++)
      out[static_cast<size_t>(i) * wanted.count + c] =
          counts && R > 0.0 ? value(i, R, V, wanted.name[c]) : 0.0;
  }

 private:
  FOAM_FUNCTION double value(int i, double R, const typename Exchange<D>::Split &V,
                             Quantity name) const
  {
    switch (name) {
      case Quantity::CONTACTS:
        return sums.contacts[i];
      case Quantity::AREA:
        return sums.area[i];
      case Quantity::FREE:
        return open_area<D>(b, i, sums.area, gas.walls);
      case Quantity::VFILM:
        return V.film;
      case Quantity::VLIQUID:
        return V.liquid;
      case Quantity::RDOT:
        return radius_rate<D>(V.film + V.liquid, R);
      case Quantity::ESPRING:
        return sums.espring[i];
      case Quantity::EDURIAN:
        return sums.edurian[i];
    }
    return 0.0;
  }
};

}    // namespace Foam

#endif
