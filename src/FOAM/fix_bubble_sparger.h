/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/sparger,FixBubbleSparger);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_SPARGER_H
#define LMP_FIX_BUBBLE_SPARGER_H

#include "fix.h"

namespace LAMMPS_NS {

// Gas that flows into a resolved liquid at a constant rate, as bubbles out of a disc

class FixBubbleSparger : public Fix {
 public:
  FixBubbleSparger(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  double compute_vector(int) override;
  void *extract(const char *, int &) override;    // the type of bubbles that are born
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  double place[3], disc, rate;       // Q, volume in a unit of time
  double mean = 0.0, sd = 0.0;       // radii; sd 0: all are of the mean
  double least = 0.0, most = 0.0;    // others are drawn again
  int type = 2;
  bigint seed = 1;
  double born = 0.0, owed = 0.0, given = 0.0;    // bubbles; volumes
  class FixBubbleFlow *gas = nullptr;

  double radius(double number) const;    // of the bubble number 0, 1, ...
};

}    // namespace LAMMPS_NS

#endif
#endif
