/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_liquid_flow.h"

#include "fix_bubble_flow.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

// What fix liquid/flow needs, and what would give a wrong flow without a word

void FixLiquidFlow::init()
{
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "Fix liquid/flow needs atom_style sphere");
  if (!atom->tag_enable)
    error->all(FLERR, "Fix liquid/flow needs IDs of atoms: atom_modify id yes");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix liquid/flow needs run_style verlet");
  pair = PairLiquidSPH::of(lmp);
  if (!pair) error->all(FLERR, "Fix liquid/flow needs pair_style liquid/sph");
  if (of(lmp) != this) error->all(FLERR, "Fix liquid/flow: there can be one only");
  gas = FixBubbleFlow::of(lmp);
  pair->check_place("Fix liquid/flow", kokkosable, execution_space);
  if (gas) pair->check_place("Fix bubble/flow", gas->kokkosable, gas->execution_space);
  pair->liquidbit = groupbit;
  pair->gasbit = gas ? gas->groupbit : 0;
  set.dr = pair->dr;
  set.h0 = pair->h0();
  check_particles();
  for (int k = 0; k < 3; k++)
    for (int end = 0; end < 2; end++) {
      walls.place[k][end] = end ? domain->boxhi[k] : domain->boxlo[k];
      if (walls.kind[k][end] && domain->boundary[k][end] != 1)
        error->all(
            FLERR,
            "Fix liquid/flow: face {} is no place for a wall: its boundary must be f, not {}",
            FACES[2 * k + end], "pfsm"[domain->boundary[k][end]]);
      if (domain->prd[k] < 2.0 * pair->reach())
        error->all(FLERR, "Fix liquid/flow: the box is {} wide along {}: it must be {} at least",
                   domain->prd[k], "xyz"[k], 2.0 * pair -> reach());
    }
  check_others();
  given_dt = update->dt;
}

void FixLiquidFlow::check_others() const
{
  for (auto &fix : modify->get_fix_list()) {
    if (utils::strmatch(fix->style, "^gravity"))
      for (int i = 0; i < atom->nlocal; i++)
        if ((atom->mask[i] & groupbit) && (atom->mask[i] & fix->groupbit))
          error->one(FLERR, "Fix liquid/flow: walls do not hold what fix {} pulls: gravity is FR",
                     fix->id);
    if (fix->box_change & ~BOX_CHANGE_DOMAIN)
      error->all(FLERR, "Fix liquid/flow: fix {} changes the box, whose walls do not move",
                 fix->id);
  }
}

// when the lists are made

void FixLiquidFlow::check_lists() const
{
  if (comm->me != 0) return;
  if (neighbor->every != 1 || neighbor->delay != 0 || !neighbor->dist_check)
    error->warning(FLERR, "Fix liquid/flow: lists may be too old: it needs neigh_modify every 1 "
                          "delay 0 check yes");
  if (neighbor->exclude)
    error->warning(FLERR, "Fix liquid/flow: particles do not see those that neigh_modify excludes");
}

// Lists that were made in a step are those of where it would have led.  If it is done again, shorter by dt, particles come back
// from there.

void FixLiquidFlow::check_way_back(double dt)
{
  if (told_of_lists || neighbor->ago > 0) return;
  double mine[] = {speeds.speed, gas ? gas->fastest() : 0.0, totals.gas}, all[3];
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_MAX, world);
  const double fastest = std::sqrt(all[0]), other = std::sqrt(std::fmax(all[0], all[1]));
  const double apart = dt * (fastest + other);
  const double room_for_gas =
      pair->reach() -
      Liquid::SUPPORT * Liquid::smoothing_length(set.h0, Liquid::liquid_fraction(all[2]));
  if (apart <= neighbor->skin + room_for_gas) return;
  told_of_lists = true;
  if (comm->me == 0)
    error->warning(FLERR,
                   "Fix liquid/flow: step {} is done again with a timestep of {}: particles that "
                   "come apart by {} on the way back may miss each other, the skin is {}",
                   update->ntimestep, update->dt, apart, neighbor->skin);
}

// The operators take each particle for dr^3 of liquid; a bubble is none.

void FixLiquidFlow::check_particles() const
{
  constexpr double DIGITS = 1.0e-4;    // of a data file
  const double mass = set.volume_of_liquid();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (gas && (atom->mask[i] & gas->groupbit))
      error->one(FLERR, "Fix liquid/flow: particle {} is in the group of fix bubble/flow, too",
                 atom->tag[i]);
    if (!(std::fabs(atom->rmass[i] / mass - 1.0) <= DIGITS))
      error->one(FLERR,
                 "Fix liquid/flow: particle {} has mass {}: it must be that of the spacing, DR^3 = "
                 "{} (set group ID diameter DR density $(6/PI))",
                 atom->tag[i], atom->rmass[i], mass);
  }
}
