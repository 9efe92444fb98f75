/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/abm,FixFoamABM);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_ABM_H
#define LMP_FIX_FOAM_ABM_H

#include "fix_foam_integrate.h"
#include "foam_abm.h"

#include "atom.h"

namespace LAMMPS_NS {

// Adams-Bashforth-Moulton predictor-corrector of order 2, see foam_stepper.h

class FixFoamABM : public FixFoamIntegrate {
 public:
  FixFoamABM(class LAMMPS *, int, char **);

 protected:
  FoamTotals attempt(double, bool) override;
  bool evaluates_again() const override;
  bool works() const override { return !evaluates_again(); }

  template <int D, class Space> FoamTotals attempt_in(Space &here, double step, bool first)
  {
    using B = typename Space::Bubbles;
    const int nlocal = atom->nlocal;
    const Foam::Predictor p = Foam::predictor(control.scheme, step, h_before);
    here.for_each(nlocal, Foam::Predict<D, B>{state(here), p, first});
    evaluate(step);
    const auto s = state(here);
    return here.totals(nlocal, Foam::Correct<D, B>{s, rates<D>(here), judge_of<D>(s), step});
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
