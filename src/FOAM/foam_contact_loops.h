/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_CONTACT_LOOPS_H
#define LMP_FOAM_CONTACT_LOOPS_H

#include "foam_contacts.h"
#include "foam_laws.h"

#include <stdexcept>
#include <string>
#include <type_traits>

// Which loop over contacts it is: each law, dimension and combination of what is gathered has one of its own

namespace Foam {

// Every combination that occurs is a loop of its own, so what is off costs nothing: calls run<WHAT>() for the given
// one.  Where energy and virial are wanted, too, one loop does for all but the plain forces.

template <class Run> void with_gathered(unsigned what, bool tallied, Run &&run)
{
  const bool drag = (what & DRAG) == DRAG;
  const unsigned beside = what & ~DRAG;
  auto either = [&]<unsigned WHAT>() {
    if (drag)
      run.template operator()<WHAT | DRAG>();
    else
      run.template operator()<WHAT>();
  };
  if (what == DIAGNOSTICS && !tallied) return run.template operator()<DIAGNOSTICS>();
  const bool known =
      (drag || !(what & DRAG)) && (beside & FORCE) && !(beside & ~(FORCE | FILM | AREA));
  if (!known) throw std::logic_error("Foam package: no loop gathers " + std::to_string(what));
  if (what == FORCE && tallied) return run.template operator()<FORCE | TALLY>();
  if (tallied) return run.template operator()<ANY | TALLY>();
  switch (beside) {
    case FORCE:
      return either.template operator()<FORCE>();
    case FORCE | AREA:
      return either.template operator()<FORCE | AREA>();
    case FORCE | FILM:
      return either.template operator()<FORCE | FILM>();
    default:
      return either.template operator()<FORCE | FILM | AREA>();
  }
}

// Calls run<D, WHAT>(law).  Sums of what is given know no law, and laws of 3D have no loops in 2D.

template <class Run>
void with_loop(const LawChoice &choice, unsigned what, bool tallied, int dimension, Run &&run)
{
  if (what == (DRAG | GIVEN))
    return with_dimension(dimension, [&]<int D>() {
      run.template operator()<D, (DRAG | GIVEN)>(SpringLaw(nullptr));
    });
  with_law(choice, [&](const auto &law) {
    with_gathered(what, tallied, [&]<unsigned WHAT>() {
      with_dimension(dimension, [&]<int D>() {
        if constexpr (D == 3 || !std::decay_t<decltype(law)>::ONLY_3D)
          run.template operator()<D, WHAT>(law);
      });
    });
  });
}

}    // namespace Foam

#endif
