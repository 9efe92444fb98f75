/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_VARIABLE_H
#define LMP_FOAM_VARIABLE_H

#include "foam_input.h"

#include "atom.h"
#include "error.h"
#include "group.h"
#include "lammps.h"
#include "library.h"

#include <cmath>
#include <string>

// Variables of style atom, which say the velocity of a liquid at each bubble.  By LAMMPS' library: an installed
// LAMMPS lacks a header that variable.h includes.

namespace LAMMPS_NS {

inline void check_atom_variable(LAMMPS *lmp, const char *fix, const std::string &name)
{
  const int type = lammps_extract_variable_datatype(lmp, name.c_str());
  if (type != LMP_VAR_ATOM)
    lmp->error->all(FLERR, "Fix {}: v_{} must be an atom-style variable: {}", fix,
                    FoamInput::shown(name),
                    type < 0 ? "there is none of this name" : "this is one of another style");
}

// into the column of this rank's atoms that are in the group

inline void take_atom_variable(LAMMPS *lmp, const char *fix, const std::string &name, int igroup,
                               double *column)
{
  const Atom *const atom = lmp->atom;
  const int n = atom->nlocal, groupbit = lmp->group->bitmask[igroup];
  auto *const values =
      static_cast<double *>(lammps_extract_variable(lmp, name.c_str(), lmp->group->names[igroup]));
  if (!values && n > 0) {
    char why[256] = "";
    if (lammps_has_error(lmp)) lammps_get_last_error_message(lmp, why, sizeof(why));
    lmp->error->one(FLERR, "Fix {}: v_{} has no values: {}", fix, name, why);
  }
  for (int i = 0; i < n; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (!std::isfinite(values[i]))
      lmp->error->one(FLERR, "Fix {}: v_{} is no finite number at bubble {}, x = {} {} {}", fix,
                      name, atom->tag[i], atom->x[i][0], atom->x[i][1], atom->x[i][2]);
    column[i] = values[i];
  }
  lammps_free(values);
}

}    // namespace LAMMPS_NS

#endif
