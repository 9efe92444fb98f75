/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/rkc,FixFoamRKC);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_RKC_H
#define LMP_FIX_FOAM_RKC_H

#include "fix_foam_integrate.h"
#include "foam_rkc.h"

namespace LAMMPS_NS {

// Stabilised Runge-Kutta-Chebyshev steps of order 2, see foam_chebyshev.h: springs relax much
// faster than the foam changes, and stages make a step stable for less than steps would.

class FixFoamRKC : public FixFoamIntegrate {
 public:
  FixFoamRKC(class LAMMPS *, int, char **);
  double compute_vector(int) override;

 protected:
  Foam::RungeKuttaChebyshev scheme;

  Foam::Judgement candidate(double, bool) override;
  bool has_history() const override { return false; }
  bool uses_work() const override { return true; }
  double stable_step() const override { return scheme.stable_step(); }
  double displacement() const override
  {
    return scheme.spectral.given > 0.0 ? INFINITY : scheme.spectral.displaced;
  }
  bool suffers_from_drift() const override { return true; }    // which grows from stage to stage
  std::vector<double *> progress() override;

  template <int D, class Space> Foam::Judgement candidate_in(Space &space, double h, bool first)
  {
    System<D, Space> system(*this, space);
    return scheme.attempt(system, driver, h, first);
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
