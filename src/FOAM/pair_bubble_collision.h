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
#include "neighbor.h"
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

  // the terms of each bubble in the present state; velocities of ghosts are up to date

  FoamColumns &look();
  void check_place(const char *style, int kokkosable, int execution_space) const;    // or an error
  virtual void host_reads() {}    // what LAMMPS keeps of bubbles

 protected:
  FoamColumnList all_columns;
  FoamColumns looks{all_columns, "terms of collisions", Bubble::LOOKS};
  FoamColumns stress{all_columns, "stress of collisions", 6};
  std::vector<double> table;    // ln of the integral
  Bubble::CollisionTotals totals;
  FixBubbleFilms *films = nullptr;
  std::vector<double> largest;     // radius of each type
  double largest_to_come = 0.0;    // that cutoffs allow for

  void allocate();
  void check_radii();
  void take_totals();
  bool list_is_new();
  template <class B> auto comes_near(const B &b) const
  {
    return Foam::ComesNear<B, Bubble::ReachOfCollision>{b, {model}, neighbor->skin};
  }

  virtual const char *style_of_films() const { return "bubble/films"; }
  virtual void request_list();
  virtual void take_list();
  virtual void collide();
  virtual void fill_looks();
  template <bool TALLY, class Space, class List> auto loop(Space &, const List &, bool looked);
  template <class Space, class List> void collide_in(Space &, const List &, int nrows);
  template <bool TALLY, class Space, class List>
  void collide_tallied_in(Space &, const List &, int nrows);
  template <class Space, class List> void fill_looks_in(Space &, const List &, int nrows);

 private:
  FoamShortList near_list;
  bigint listed_ncalls = -1, listed_lastcall = -1;    // by LAMMPS' counters
  FoamHalfList<true> rows() const;
};

template <bool TALLY, class Space, class List>
auto PairBubbleCollision::loop(Space &space, const List &rows, bool looked)
{
  Bubble::Looks terms;
  if (looked)
    for (int k = 0; k < Bubble::LOOKS; k++) terms.column[k] = space.column(looks, k);
  return Bubble::Collide<typename Space::Bubbles, List, TALLY>{
      space.bubbles(), rows, {model, terms, looked}, {}};
}

template <class Space, class List>
void PairBubbleCollision::collide_in(Space &space, const List &rows, int nrows)
{
  totals = Bubble::CollisionTotals();
  if (evflag)
    collide_tallied_in<true>(space, rows, nrows);
  else
    collide_tallied_in<false>(space, rows, nrows);
}

template <bool TALLY, class Space, class List>
void PairBubbleCollision::collide_tallied_in(Space &space, const List &rows, int nrows)
{
  auto functor = loop<TALLY>(space, rows, eflag_atom);
  using Totals = typename decltype(functor)::Totals;
  if (vflag_atom)
    for (int k = 0; k < 6; k++) functor.virial[k] = space.column(stress, k);
  auto run = [&](const Bubble::Films &its) {
    functor.films = its;
    const auto found = space.template totals<Totals>(nrows, functor);
    totals.join(found);
    return static_cast<int>(found.most);
  };
  if (films)
    films->evaluate(space, atom->nmax, run);
  else
    run({});
}

template <class Space, class List>
void PairBubbleCollision::fill_looks_in(Space &space, const List &rows, int nrows)
{
  auto functor = loop<true>(space, rows, true);
  functor.moves = false;
  if (films) functor.films = films->now(space);
  space.template totals<Bubble::CollisionTotals>(nrows, functor);
}

}    // namespace LAMMPS_NS

#endif
#endif
