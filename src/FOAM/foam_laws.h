/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAWS_H
#define LMP_FOAM_LAWS_H

#include "foam_law_power.h"
#include "foam_law_spring.h"
#include "foam_law_sticky.h"
#include "foam_law_surface.h"

#include <string>
#include <tuple>
#include <vector>

namespace Foam {

// All laws, the first is the default.  Restart files have its place in the list: new ones come last.

using Laws = std::tuple<SpringLaw, PowerLaw, SurfaceLaw, StickyLaw>;
inline constexpr int NLAWS = std::tuple_size_v<Laws>;

// visit(law) with the law that was chosen

template <int N = 0, class Visit> void with_law(const LawChoice &choice, Visit &&visit)
{
  if constexpr (N < NLAWS) {
    using Law = std::tuple_element_t<N, Laws>;
    static_assert(Law::PARAMETERS.size() <= LawChoice::MOST);
    if (choice.index == N)
      visit(Law(choice.parameters.data()));
    else
      with_law<N + 1>(choice, visit);
  }
}

inline std::vector<std::string> names_of_laws()
{
  std::vector<std::string> names;
  for (int n = 0; n < NLAWS; n++)
    with_law({n, {}}, [&](const auto &law) { names.push_back(law.NAME); });
  return names;
}

}    // namespace Foam

#endif
