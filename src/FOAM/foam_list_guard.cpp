/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "foam_list_guard.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

FoamListGuard::~FoamListGuard()
{
  if (neighbor && skin_given > 0.0 && neighbor->skin == skin_now) neighbor->skin = skin_given;
}

void FoamListGuard::built()
{
  if (domain->box_change) find_corners(corners_listed);
  box_listed = FoamBoxShape(domain);
  list_is_new = true;
  steps = 0;
}

/* ----------------------------------------------------------------------
   the width of the skin
------------------------------------------------------------------------- */

void FoamListGuard::begin_run(double skin_before)
{
  if (skin_now == 0.0) skin_now = skin_before;
  if (skin_given == 0.0 || neighbor->skin != skin_now)
    skin_given = neighbor->skin;    // by a command
  if (!follows || comm->style == Comm::TILED || skin_now < skin_given) skin_now = skin_given;
  neighbor->skin = skin_wanted = skin_then = skin_now;
}

void FoamListGuard::end_run(const char *style)
{
  if (skin_now > skin_then && comm->me == 0)
    utils::logmesg(lmp,
                   "Fix {}: steps have widened the skin of neighbor lists from {:.4g} to {:.4g}\n",
                   style, skin_then, skin_now);
  neighbor->skin = skin_given;
}

// Half of a skin, less what a moving box takes of it, is good for the way that a bubble goes in one step; more than
// that, so that it is not spent by what the next step goes further.  Ghosts of comm_style tiled reach no further than
// the box, so that a skin cannot be widened there.

bool FoamListGuard::widen(double way, double widest)
{
  constexpr double MARGIN = 1.5;
  if (!follows || comm->style == Comm::TILED) return false;
  const double least = skin_now + 2.0 * (way - margin());
  if (!(least > skin_now && least < widest)) return false;
  skin_wanted = MIN(MARGIN * least, widest);
  return true;
}

bool FoamListGuard::skin_is_due()
{
  constexpr bigint LONG = 20;    // steps that a list lasts
  constexpr double NARROWER = 0.8;
  if (skin_wanted == skin_now && steps >= LONG) skin_wanted = MAX(skin_given, NARROWER * skin_now);
  const bool due = skin_wanted != skin_now;
  neighbor->skin = skin_now = skin_wanted;
  return due;
}

/* ---------------------------------------------------------------------- */

Foam::AffineMap FoamListGuard::moved_by_box(double later) const
{
  FoamBoxShape then(domain);
  then.move(domain, later);
  return foam_affine_map(box_listed, then);
}

// half of the skin, less what a moving box takes away (the two corners that moved most)

double FoamListGuard::margin() const
{
  if (!domain->box_change) return 0.5 * skin_now;
  if (goes_with_box) {    // what counts is how bubbles move in it, and how near it brings them to each other
    const double strain = moved_by_box(0.0).strain(domain->dimension);
    return MAX(0.0, 0.5 * (skin_now - strain * neighbor->cutneighmax));
  }
  double corners[8][3], first = 0.0, second = 0.0;
  find_corners(corners);
  for (int c = 0; c < 8; c++) {
    double square = 0.0;
    for (int k = 0; k < domain->dimension; k++)
      square += (corners[c][k] - corners_listed[c][k]) * (corners[c][k] - corners_listed[c][k]);
    const double d = std::sqrt(square);
    if (d > first) {
      second = first;
      first = d;
    } else
      second = MAX(second, d);
  }
  return MAX(0.0, 0.5 * (skin_now - (first + second)));
}

void FoamListGuard::find_corners(double (*corners)[3]) const
{
  const double yz = domain->yz, xz = domain->xz, xy = domain->xy;    // 0 in an orthogonal box
  for (int c = 0; c < 8; c++) {
    const double a = c & 1, b = (c >> 1) & 1, d = (c >> 2) & 1;
    corners[c][0] = domain->boxlo[0] + a * domain->xprd + b * xy + d * xz;
    corners[c][1] = domain->boxlo[1] + b * domain->yprd + d * yz;
    corners[c][2] = domain->boxlo[2] + d * domain->zprd;
  }
}

// out of turn, as Verlet::run() does it in turn

void FoamListGuard::rebuild()
{
  timer->stamp(Timer::MODIFY);
  modify->pre_exchange();
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  if (domain->box_change) {
    domain->reset_box();
    comm->setup();
    if (neighbor->style) neighbor->setup_bins();
  }
  comm->exchange();
  if (atom->sortfreq > 0 && update->ntimestep >= atom->nextsort) atom->sort();
  comm->borders();
  if (domain->triclinic) domain->lamda2x(atom->nlocal + atom->nghost);
  if (modify->n_pre_neighbor) modify->pre_neighbor();
  timer->stamp(Timer::COMM);
  neighbor->build(1);
  modify->post_neighbor();
  timer->stamp(Timer::NEIGH);
}

void FoamListGuard::spare_checks()
{
  if (delay_given >= 0 || !neighbor->dist_check) return;
  delay_given = neighbor->delay;
  neighbor->delay = MAXSMALLINT / neighbor->every * neighbor->every;
}

void FoamListGuard::give_checks_back()
{
  swap_delay();
  delay_given = -1;
}

void FoamListGuard::swap_delay()
{
  if (delay_given >= 0) std::swap(neighbor->delay, delay_given);
}

void FoamListGuard::warn(const char *style, double steps) const
{
  if (outlisted > 0.1 * steps && steps >= 10.0 && comm->me == 0)
    error->warning(FLERR,
                   "Fix {}: {} of {:.0f} steps were tried in vain, since bubbles went further than "
                   "half the skin of {:.4g}: a larger skin saves them, see the neighbor command",
                   style, outlisted, steps, skin_now);
}
