/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "compute_liquid_particle.h"

#include "fix_liquid_flow.h"

#include "error.h"

using namespace LAMMPS_NS;

enum { OF_EVALUATION, OF_STATE };

static std::vector<ComputeLiquidColumns::Quantity> quantities()
{
  using namespace Liquid;
  std::vector<ComputeLiquidColumns::Quantity> all{{"c", GAS},
                                                  {"alpha", ALPHA},
                                                  {"h", H},
                                                  {"cover", COVER},
                                                  {"surface", SURFACE},
                                                  {"s", STRAIN},
                                                  {"k", UNRESOLVED},
                                                  {"eps", EPSILON},
                                                  {"nus", NU_S},
                                                  {"nub", NU_B},
                                                  {"divstar", DIV_STAR},
                                                  {"pnew", SOLUTION},
                                                  {"p", FixLiquidFlow::PRESSURE, OF_STATE}};
  auto vectors = [&](const std::string &name, int column, int place = OF_EVALUATION) {
    ComputeLiquidColumns::add_vector(all, name, column, place);
  };
  vectors("n", NORMAL);
  vectors("shift", SHIFT);
  vectors("curl", VORTEX);
  vectors("m", BY_BUBBLES);
  vectors("viscous", VISCOUS);
  vectors("ustar", STAR);
  vectors("p", GRAD_P);
  vectors("dudt", FixLiquidFlow::ACCELERATION, OF_STATE);
  for (int a = 0; a < 3; a++) vectors(std::string("gradu") + "xyz"[a], GRADIENT + 3 * a);
  return all;
}

/* ----------------------------------------------------------------------
   compute ID group-ID liquid/particle KEY ...
------------------------------------------------------------------------- */

ComputeLiquidParticle::ComputeLiquidParticle(LAMMPS *lmp, int narg, char **arg)
    : ComputeLiquidColumns(lmp, narg, arg, "liquid/particle", quantities())
{
}

void ComputeLiquidParticle::init()
{
  flow = FixLiquidFlow::of(lmp);
  if (!flow) error->all(FLERR, "Compute liquid/particle needs fix liquid/flow");
}

FoamColumns &ComputeLiquidParticle::columns(int place)
{
  return place == OF_STATE ? flow->state : flow->work;
}

int ComputeLiquidParticle::members() const
{
  return flow->groupbit;
}
