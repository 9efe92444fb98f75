/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "foam_hub.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

void FoamHub::take_means()
{
  const double *const radius = atom->radius;
  double mine[3] = {0.0, 0.0, 0.0}, all[3];    // bubbles, their radii and surfaces
  for (int i = 0; i < atom->nlocal; i++)
    if (radius[i] > 0.0 && (atom->mask[i] & groupbit)) {
      mine[0] += 1.0;
      mine[1] += radius[i];
      mine[2] += Foam::with_dimension(domain->dimension,
                                      [&]<int D>() { return Foam::surface<D>(radius[i]); });
    }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_SUM, world);
  if (!rin_fixed) record.rin = all[0] > 0.0 ? all[1] / all[0] : 0.0;
  if (!ain_fixed) record.ain = all[0] > 0.0 ? all[2] / all[0] : 0.0;
}

void FoamHub::fix_means()
{
  if (!(record.rin > 0.0))
    error->all(FLERR,
               "Pair style {}: the mean radius <R_in> is {}, so there is no bubble "
               "with a radius > 0: create bubbles, set their diameters or give keyword rin",
               style, record.rin);
  if (rin_fixed && ain_fixed) return;
  tell_means(rin_fixed ? "the former as given" : "means of the present bubbles");

  // IDs are not used twice: gaps are left by bubbles that have vanished

  tagint mine = 0, largest;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, atom->tag[i]);
  MPI_Allreduce(&mine, &largest, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (!rin_fixed && largest > atom->natoms && comm->me == 0)
    error->warning(FLERR,
                   "Pair style {}: the IDs of {} bubbles go up to {}, as in a foam that has "
                   "coarsened already: then give its first mean radius by keyword rin, else use "
                   "reset_atoms id",
                   style, atom->natoms, largest);
  rin_fixed = ain_fixed = true;
}

// a new pair style in the middle of a simulation takes over what is not given anew

void FoamHub::go_on_from(const Record &before)
{
  if (ain_fixed) return;    // it is not new
  if (!rin_fixed) record.rin = before.rin;
  record.ain = before.ain;
  rin_fixed = ain_fixed = true;
  record.tau = before.tau;
  record.removed_bubbles = before.removed_bubbles;
  record.removed_gas = before.removed_gas;
  tell_means("as before");
}

void FoamHub::tell_means(const char *whence) const
{
  if (comm->me == 0)
    utils::logmesg(lmp, "Pair style {}: <R_in> = {:.8}, <A_in> = {:.8}, {}\n", style, record.rin,
                   record.ain, whence);
}

bool FoamHub::integrates(const Fix *fix)
{
  return fix->time_integrate && utils::strmatch(fix->style, "^foam/");
}

double FoamHub::place_of(int face) const
{
  return (face % 2 ? domain->boxhi : domain->boxlo)[face / 2];
}

Foam::Walls FoamHub::walls_now(WallsThat act, int &group) const
{
  Foam::Walls found;
  for (const Wall &wall : walls) {
    if (act == HOLD ? wall.drag == 0.0 : !wall.covers) continue;
    found.add(wall.face, place_of(wall.face), wall.drag, wall.of->groupbit);
    if (wall.of->groupbit != Foam::GROUP_ALL) group = wall.of->groupbit;
  }
  return found;
}

void FoamHub::take_away(const Fix *fix)
{
  auto its = [=](const Wall &wall) {
    return wall.of == fix;
  };
  walls.erase(std::remove_if(walls.begin(), walls.end(), its), walls.end());
}

// they have the same: FixFoamIntegrate::check_companions()

void FoamHub::find_group()
{
  groupbit = Foam::GROUP_ALL;
  for (auto &ifix : modify->get_fix_list())
    if (integrates(ifix) || utils::strmatch(ifix->style, "^foam/coarsen"))
      groupbit = ifix->groupbit;
}
