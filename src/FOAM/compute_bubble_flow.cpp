/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_bubble_flow.h"

#include "fix_bubble_flow.h"

#include "error.h"

using namespace LAMMPS_NS;

static std::vector<ComputeLiquidColumns::Quantity> quantities()
{
  using namespace Liquid;
  std::vector<ComputeLiquidColumns::Quantity> all{
      {"vlb", AROUND}, {"k", TURBULENCE}, {"eps", EPS_B}, {"nub", VISCOSITY_B}};
  auto vectors = [&](const std::string &name, int column) {
    ComputeLiquidColumns::add_vector(all, name, column);
  };
  vectors("ul", FLOW);
  vectors("curl", CURL);
  vectors("dul", LIQUID_ACCELERATION);
  vectors("fd", DRAG);
  vectors("fl", LIFT_FORCE);
  vectors("fvm", VIRTUAL);
  vectors("fg", BUOYANCY);
  vectors("a", BUBBLE_ACCELERATION);
  vectors("m", REACTION);
  return all;
}

/* ----------------------------------------------------------------------
   compute ID group-ID bubble/flow KEY ...
------------------------------------------------------------------------- */

ComputeBubbleFlow::ComputeBubbleFlow(LAMMPS *lmp, int narg, char **arg)
    : ComputeLiquidColumns(lmp, narg, arg, "bubble/flow", quantities())
{
}

void ComputeBubbleFlow::init()
{
  gas = FixBubbleFlow::of(lmp);
  if (!gas) error->all(FLERR, "Compute bubble/flow needs fix bubble/flow");
}

FoamColumns &ComputeBubbleFlow::columns(int)
{
  return gas->work;
}

int ComputeBubbleFlow::members() const
{
  return gas->groupbit;
}
