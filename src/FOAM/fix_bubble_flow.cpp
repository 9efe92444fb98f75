/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_flow.h"

#include "fix_liquid_flow.h"
#include "foam_host.h"
#include "foam_input.h"

#include "error.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;

/* ----------------------------------------------------------------------
   fix ID group-ID bubble/flow WE BETA keyword value ...
------------------------------------------------------------------------- */

FixBubbleFlow::FixBubbleFlow(LAMMPS *lmp, int narg, char **arg) : FixFoamTravelling(lmp, narg, arg)
{
  using Value = FoamInput::Value;
  FoamInput input(error, "Fix bubble/flow", narg - 3, arg + 3);
  We = input.argument("WE").number(FoamInput::ABOVE, 0.0);
  set.beta = input.argument("BETA").number(FoamInput::ABOVE, 1.0);
  auto yes_or_no = [](const Value &v) {
    return v.one_of({"no", "yes"}) == 1;
  };
  input.keywords({{"drag",
                   [&](const Value &v) {
                     set.drag = yes_or_no(v);
                   }},
                  {"lift",
                   [&](const Value &v) {
                     set.lift = yes_or_no(v);
                   }},
                  {"virtual",
                   [&](const Value &v) {
                     set.virtual_mass = yes_or_no(v);
                   }},
                  {"substep", [&](const Value &v) {
                     set.substeps = yes_or_no(v);
                   }}});
  time_integrate = 1;
  vector_flag = 1;
  size_vector = 2;
  extvector = 0;
  global_freq = 1;
  comm_forward = Liquid::AT_BUBBLES - Liquid::REACTION;
  add_callbacks();
}

FixBubbleFlow *FixBubbleFlow::of(LAMMPS *lmp)
{
  for (auto &fix : lmp->modify->get_fix_list())
    if (auto *its = dynamic_cast<FixBubbleFlow *>(fix)) return its;
  return nullptr;
}

int FixBubbleFlow::setmask()
{
  return INITIAL_INTEGRATE;
}

void FixBubbleFlow::init()
{
  if (of(lmp) != this) error->all(FLERR, "Fix bubble/flow: there can be one only");
  if (!FixLiquidFlow::of(lmp)) error->all(FLERR, "Fix bubble/flow needs fix liquid/flow");
}

void FixBubbleFlow::initial_integrate(int)
{
  FoamHost space(lmp, groupbit);
  space.for_each(atom->nlocal, Liquid::Advance<FoamHost::Bubbles>{
                                   space.bubbles(), FixLiquidFlow::of(lmp)->walls, update->dt});
}

/* ----------------------------------------------------------------------
   what ghosts have
------------------------------------------------------------------------- */

int FixBubbleFlow::pack_forward_comm(int n, int *list, double *buf, int, int *)
{
  int m = 0;
  for (int k = Liquid::REACTION; k < Liquid::AT_BUBBLES; k++) {
    const double *const column = work[k];
    for (int i = 0; i < n; i++) buf[m++] = column[list[i]];
  }
  return m;
}

void FixBubbleFlow::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int k = Liquid::REACTION; k < Liquid::AT_BUBBLES; k++) {
    double *const column = work[k];
    for (int i = first; i < first + n; i++) column[i] = buf[m++];
  }
}

// number and volume of the bubbles

double FixBubbleFlow::compute_vector(int n)
{
  double mine = 0.0, all;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) mine += n == 0 ? 1.0 : Liquid::bubble_volume(atom->radius[i]);
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}
