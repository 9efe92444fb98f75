/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_rkc.h"

#include "utils.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixFoamRKC::FixFoamRKC(LAMMPS *lmp, int narg, char **arg) : FixFoamIntegrate(lmp, narg, arg)
{
  using Foam::Chebyshev;
  using Value = FoamInput::Value;
  settings(narg, arg,
           {{"stages",
             [&](const Value &v) {
               stages_given = v.is("auto") ? 0 : v.integer(Chebyshev::FEWEST, Chebyshev::MOST);
             }},
            {"spectral", [&](const Value &v) {
               spectral_given = v.is("auto") ? 0.0 : v.number(FoamInput::ABOVE, 0.0);
             }}});
  add_callbacks();
  size_vector = 9;
}

FoamTotals FixFoamRKC::attempt(double step, bool first)
{
  FoamHost here(lmp, groupbit);
  return Foam::with_dimension(dim, [&]<int D>() { return attempt_in<D>(here, step, first); });
}

// fix enforce2d, which 2D scenes often have, sets to 0 what is 0

bool FixFoamRKC::others_act() const
{
  if (!modify->n_pre_force && !modify->n_post_force_any) return false;
  for (int m = 0; m < modify->nfix; m++)
    if ((modify->fmask[m] & (PRE_FORCE | POST_FORCE)) &&
        !utils::strmatch(modify->fix[m]->style, "^enforce2d"))
      return true;
  return false;
}

double FixFoamRKC::stable_step() const
{
  const double largest = spectral_radius();
  const int most = stages_given ? stages_given : Foam::Chebyshev::MOST;
  return largest > 0.0 ? Foam::Chebyshev::stable(most) / largest : INFINITY;
}

std::vector<double *> FixFoamRKC::progress()
{
  auto all = FixFoamIntegrate::progress();
  for (double *one : {&spectral, &spectral_step, &changed_step, &direction_size, &direction_most,
                      &stages_last, &rejected_then, &others_change})
    all.push_back(one);
  return all;
}

double FixFoamRKC::compute_vector(int n)
{
  if (n == 7) return stages_last;
  if (n == 8) return spectral_given > 0.0 ? spectral_given : spectral;
  return FixFoamIntegrate::compute_vector(n);
}
