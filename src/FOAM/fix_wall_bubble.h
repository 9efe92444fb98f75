/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/bubble,FixWallBubble);
// clang-format on
#else

#ifndef LMP_FIX_WALL_BUBBLE_H
#define LMP_FIX_WALL_BUBBLE_H

#include "bubble_collision.h"
#include "fix_bubble_films.h"
#include "foam_columns.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

// A plane, or the surface of a region, that bubbles with inertia meet.  The model is that of the pair style, but for
// keywords of its own.

class FixWallBubble : public FixBubbleFilms {
 public:
  FixWallBubble(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_reverse(int, int) override;
  void post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  const Bubble::WallTotals &of_this_rank() const { return totals; }
  void add_looks(FoamColumns &);    // the terms of each bubble, to those of its other contacts

 private:
  double place[3] = {0.0, 0.0, 0.0}, normal[3] = {0.0, 0.0, 0.0};
  std::string region_name;
  class Region *region = nullptr;    // none: a plane
  Bubble::Collision model;
  std::vector<std::string> words;    // keywords and values, until the pair style is known
  std::vector<double> table;         // ln of the integral of the film

  Bubble::WallTotals totals;    // of this rank, of the last evaluation
  Bubble::Losses losses;        // of this rank
  enum { FX, FY, FZ, CLOSED, VISCOUS, LUBRICATION, SLIDING, LOST, ENERGY = LOST + 3, ALL };
  double all[ALL] = {};
  bool reduced = false;

  void take_model();
  void push();
  template <class Space> Bubble::MeetPlane<typename Space::Bubbles> plane(Space &space);
  template <class Space, class Functor>
  Bubble::WallTotals meet(Space &space, const Functor &functor);
  void reduce();
};

}    // namespace LAMMPS_NS

#endif
#endif
