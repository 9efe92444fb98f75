/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_abm.h"

#include "error.h"

using namespace LAMMPS_NS;

FixFoamABM::FixFoamABM(LAMMPS *lmp, int narg, char **arg) : FixFoamIntegrate(lmp, narg, arg)
{
  settings(narg, arg, 1.0e-5, {{"scheme", [&](const FoamInput::Value &v) {
                                  driver.control.scheme = v.one_of({"standard", "source"}) == 1
                                                              ? Foam::Scheme::SOURCE
                                                              : Foam::Scheme::STANDARD;
                                }}});
  if (drift_removed && driver.control.scheme == Foam::Scheme::SOURCE)
    error->all(FLERR, "Fix {}: drift remove goes with scheme standard, not with scheme source",
               style);
  if (driver.control.scheme == Foam::Scheme::SOURCE && !norm_given)
    norm = Foam::Norm::MAX;    // as in [L20]
  add_callbacks();
}

Foam::Judgement FixFoamABM::candidate(double step, bool first)
{
  FoamHost space(lmp, groupbit);
  return Foam::with_dimension(dim, [&]<int D>() { return candidate_in<D>(space, step, first); });
}

// the source takes the rates at the predicted state for those at the corrected one

bool FixFoamABM::evaluates_again() const
{
  return driver.control.scheme == Foam::Scheme::STANDARD;
}
