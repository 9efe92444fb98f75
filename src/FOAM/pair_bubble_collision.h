/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(bubble/collision,PairBubbleCollision);
// clang-format on
#else

#ifndef LMP_PAIR_BUBBLE_COLLISION_H
#define LMP_PAIR_BUBBLE_COLLISION_H

#include "bubble_collision.h"
#include "fix_bubble_films.h"
#include "foam_columns.h"
#include "foam_half_list.h"

#include "atom.h"
#include "neigh_list.h"
#include "pair.h"

#include <vector>

namespace LAMMPS_NS {

// Bubbles with inertia that collide: elastic force, film, lubrication, sliding.  A full list: each bubble takes its own
// forces, from all its partners, so that nothing has to come back from ghosts, and films are kept by both.

class PairBubbleCollision : public Pair {
 public:
  PairBubbleCollision(class LAMMPS *);
  ~PairBubbleCollision() override;
  static PairBubbleCollision *of(class LAMMPS *);    // the one in use, or none

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double memory_usage() override;

  Bubble::Collision model;
  bool exact = false;    // the integral of the film
  const Bubble::CollisionTotals &of_this_rank() const { return totals; }

  FoamColumns &
  look();    // the terms of each bubble in the present state; velocities of ghosts are up to date

 protected:
  FoamColumnList all_columns;
  FoamColumns looks{all_columns, "terms of collisions", Bubble::LOOKS};
  FoamColumns stress{all_columns, "stress of collisions", 6};
  std::vector<double> table;    // ln of the integral
  Bubble::CollisionTotals totals;
  FixBubbleFilms *films = nullptr;
  std::vector<double> largest;    // radius of each type

  void allocate();
  void check_radii();
  void take_totals();
  template <bool TALLY, class Space> auto loop(Space &space, bool looked);
  template <bool TALLY, class Space> void collide(Space &space);
};

template <bool TALLY, class Space> auto PairBubbleCollision::loop(Space &space, bool looked)
{
  using List = FoamHalfList<true>;
  Bubble::Looks terms;
  if (looked)
    for (int k = 0; k < Bubble::LOOKS; k++) terms.column[k] = space.column(looks, k);
  return Bubble::Collide<typename Space::Bubbles, List, TALLY>{
      space.bubbles(),
      {list->ilist, list->numneigh, list->firstneigh, atom->nlocal},
      {model, terms, looked},
      {}};
}

}    // namespace LAMMPS_NS

#endif
#endif
