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

namespace LAMMPS_NS {

// Adams-Bashforth-Moulton predictor-corrector of order 2, see foam_stepper.h

class FixFoamABM : public FixFoamIntegrate {
 public:
  FixFoamABM(class LAMMPS *, int, char **);

 protected:
  Foam::Judgement candidate(double, bool) override;
  bool evaluates_again() const override;
  bool uses_work() const override { return !evaluates_again(); }

  template <int D, class Space> Foam::Judgement candidate_in(Space &space, double h, bool first)
  {
    System<D, Space> system(*this, space);
    return Foam::attempt_abm(system, driver, h, first);
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
