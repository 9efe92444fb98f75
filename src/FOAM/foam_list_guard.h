/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LIST_GUARD_H
#define LMP_FOAM_LIST_GUARD_H

#include "foam_moving_box.h"

#include "pointers.h"

namespace LAMMPS_NS {

// How long a neighbor list is good.  It holds pairs closer than R_i + R_j + skin when built, so it is good
// for as long as no bubble has moved and grown by more than half the skin.  LAMMPS itself looks at motion
// only, and not at states that a step tries.

class FoamListGuard : protected Pointers {
 public:
  explicit FoamListGuard(LAMMPS *lmp) : Pointers(lmp) {}
  ~FoamListGuard() override;    // LAMMPS has its skin again, also after a command that does no run

  void built();    // just now
  void state_has_changed() { list_is_new = false; }
  bool is_new() const { return list_is_new; }    // built at the present state
  bool goes_with_box = false;    // bubbles are followed relative to a box that deforms
  Foam::AffineMap moved_by_box(double later) const;    // since the list was built

  double margin() const;    // how far a bubble may have moved and grown since
  void rebuild();           // out of turn

  // The skin follows the steps, up to some width, if it may: it is widened for a step that goes, or will go, further
  // than a new list, and narrowed when lists last long.  After a run LAMMPS has again the one of the neighbor command.

  bool follows = true;
  double skin_now = 0.0;    // kept in restarts; 0: none yet
  void begin_run(double skin_before);
  void end_run(const char *style);
  bool widen(double way, double widest);    // that a step goes; false: it may not
  void step_taken() { steps++; }
  bool skin_is_due();    // before an exchange: neighbor->skin has changed

  // The integrator knows when the list is outdated; LAMMPS' own look at it in each step is spared
  // during a run.

  void spare_checks();
  void give_checks_back();
  template <class Refresh> void with_checks(const Refresh &refresh)    // LAMMPS may print them
  {
    swap_delay();
    refresh();
    swap_delay();
  }

  bigint outlisted = 0;    // tries of this run that went beyond a list that was new
  void warn(const char *style, double steps) const;

 private:
  double corners_listed[8][3] = {};    // of the box, when the list was built
  FoamBoxShape box_listed;
  bool list_is_new = false;
  double skin_given = 0.0, skin_wanted = 0.0, skin_then = 0.0;    // then: before the run
  bigint steps = 0;                                               // since the list was built
  int delay_given = -1;    // neigh_modify delay, which does not count during a run

  void find_corners(double (*)[3]) const;
  void swap_delay();
};

}    // namespace LAMMPS_NS

#endif
