/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_films.h"

using namespace LAMMPS_NS;
using namespace FixConst;

FixBubbleFilms::FixBubbleFilms(LAMMPS *lmp, int narg, char **arg)
    : FixFoamRecords(lmp, narg, arg, 1)
{
  keep_records();
}

FixBubbleFilms::FixBubbleFilms(LAMMPS *lmp, int narg, char **arg, Derived)
    : FixFoamRecords(lmp, narg, arg, 1)
{
}

int FixBubbleFilms::setmask()
{
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE;
}
