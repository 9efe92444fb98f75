/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/rise,FixBubbleRise);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_RISE_H
#define LMP_FIX_BUBBLE_RISE_H

#include "bubble_liquid.h"
#include "fix.h"
#include "foam_columns.h"

#include <string>

namespace LAMMPS_NS {

// The liquid around bubbles with inertia: buoyancy, drag, and the mass that is added to that of the gas

class FixBubbleRise : public Fix {
 public:
  FixBubbleRise(class LAMMPS *, int, char **);
  static FixBubbleRise *of(class LAMMPS *);    // the one in use, or none
  int setmask() override;
  void init() override;
  void setup_pre_reverse(int, int) override;
  void post_force(int) override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

  Bubble::Liquid liquid;
  bool implicit = false;       // the integrator may treat the drag implicitly
  const double *stiffness()    // force of the drag per speed of each bubble, at the last evaluation
  {
    return implicit ? columns[STIFFNESS] : nullptr;
  }
  void look(double *const *drag,
            double *const *buoyancy);    // columns of forces, as things are now

 protected:
  FoamColumnList all_columns;
  enum { STIFFNESS, VX, VY, VZ, NCOLUMNS };
  FoamColumns columns{all_columns, "liquid around bubbles", NCOLUMNS};

 private:
  std::string flow[3];    // variables of style atom
  bool flows = false;
  Bubble::LiquidTotals totals;                            // of this rank
  double work[2] = {0.0, 0.0}, before[2] = {0.0, 0.0};    // by buoyancy and drag; powers
  enum { WORK_BUOYANCY, WORK_DRAG, POWER_BUOYANCY, POWER_DRAG, KINETIC, ALL };
  double all[ALL] = {};
  bool reduced = false;

  void act();
  void take_flow();
  template <class Space> Bubble::Rise<typename Space::Bubbles> functor(Space &space);
  void reduce();
};

}    // namespace LAMMPS_NS

#endif
#endif
