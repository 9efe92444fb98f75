/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_INPUT_H
#define LMP_FOAM_INPUT_H

#include "error.h"
#include "utils.h"

#include <cmath>
#include <string>

namespace LAMMPS_NS {

// A number of an input command, or an error that names the style, the argument and what is
// allowed: a number COMPARE limit.

class FoamInput {
 public:
  enum Compare { ABOVE, AT_LEAST };

  FoamInput(class LAMMPS *lmp, Error *error, const std::string &style)
      : lmp(lmp), error(error), style(style)
  {
  }

  double number(const std::string &name, const std::string &text, Compare compare,
                double limit) const
  {
    if (utils::is_double(text)) {
      const double value = utils::numeric(FLERR, text, false, lmp);
      if (std::isfinite(value) && (compare == ABOVE ? value > limit : value >= limit)) return value;
    }
    error->all(FLERR, "{}: {} must be a number {} {}, not {}", style, name,
               compare == ABOVE ? ">" : ">=", limit, text);
  }

  bigint count(const std::string &name, const std::string &text) const
  {
    if (utils::is_integer(text)) {
      const bigint value = utils::bnumeric(FLERR, text, false, lmp);
      if (value >= 0) return value;
    }
    error->all(FLERR, "{}: {} must be an integer >= 0, not {}", style, name, text);
  }

 private:
  class LAMMPS *lmp;
  Error *error;
  std::string style;
};

}    // namespace LAMMPS_NS

#endif
