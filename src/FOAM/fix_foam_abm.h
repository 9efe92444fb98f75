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

namespace LAMMPS_NS {

// Adams-Bashforth-Moulton predictor-corrector of order 2, see foam_stepper.h

class FixFoamABM : public FixFoamIntegrate {
 public:
  FixFoamABM(class LAMMPS *, int, char **);

 protected:
  Trial attempt(double) override;
  void keep_history() override;
  bool evaluates_again() const override;

 private:
  template <int D> Trial attempt_in(double);
};

}    // namespace LAMMPS_NS

#endif
#endif
