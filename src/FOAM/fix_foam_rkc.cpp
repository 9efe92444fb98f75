/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_rkc.h"

using namespace LAMMPS_NS;

FixFoamRKC::FixFoamRKC(LAMMPS *lmp, int narg, char **arg) : FixFoamIntegrate(lmp, narg, arg)
{
  using Foam::Chebyshev;
  using Value = FoamInput::Value;
  driver.control.growth_at_start = 1000.0;    // a scheme without history takes any ratio of steps
  settings(narg, arg, 1.0e-2,
           {{"stages",
             [&](const Value &v) {
               scheme.stages_given =
                   v.is("auto") ? 0 : v.integer(Chebyshev::FEWEST, Chebyshev::MOST);
             }},
            {"spectral", [&](const Value &v) {
               scheme.spectral.given = v.is("auto") ? 0.0 : v.number(FoamInput::ABOVE, 0.0);
             }}});
  add_callbacks();
  size_vector = 9;
}

Foam::Judgement FixFoamRKC::candidate(double step, bool first)
{
  FoamHost space(lmp, groupbit);
  return Foam::with_dimension(dim, [&]<int D>() { return candidate_in<D>(space, step, first); });
}

std::vector<double *> FixFoamRKC::progress()
{
  auto all = FixFoamIntegrate::progress();
  Foam::SpectralRadius &r = scheme.spectral;
  for (double *one : {&r.estimated, &r.estimate_step, &r.changed_step, &r.direction_size,
                      &r.direction_most, &scheme.stages_last, &r.rejected_then, &r.others_change})
    all.push_back(one);
  return all;
}

double FixFoamRKC::compute_vector(int n)
{
  if (n == 7) return scheme.stages_last;
  if (n == 8) return scheme.spectral.value();
  return FixFoamIntegrate::compute_vector(n);
}
