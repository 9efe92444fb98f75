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
#include "foam_host.h"

#include "atom.h"

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
  virtual void
  add_looks(FoamColumns &);    // the terms of each bubble, to those of its other contacts

 protected:
  virtual void push();
  template <class Space> void push_in(Space &space);
  template <class Space> void add_looks_in(Space &space, FoamColumns &looks);
  bool at_region() const { return region != nullptr; }

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
  void act(int vflag);
  template <class Space> Bubble::MeetPlane<typename Space::Bubbles> plane(Space &space)
  {
    return {space.bubbles(),
            {place[0], place[1], place[2]},
            {normal[0], normal[1], normal[2]},
            {model, {}, false},
            {}};
  }
  template <class Space, class Functor>
  Bubble::WallTotals meet(Space &space, const Functor &functor)
  {
    return space.template totals<Bubble::WallTotals>(atom->nlocal, functor);
  }
  Bubble::WallTotals meet(FoamHost &, const Bubble::MeetPlane<Foam::HostBubbles> &);
  void reduce();
};

template <class Space> void FixWallBubble::push_in(Space &space)
{
  auto functor = plane(space);
  auto run = [&](const Bubble::Films &films) {
    functor.films = films;
    totals = meet(space, functor);
    return 0;
  };
  if (model.stop == Bubble::Stop::CONTACT)
    evaluate(space, atom->nmax, run);
  else
    run({});
}

template <class Space> void FixWallBubble::add_looks_in(Space &space, FoamColumns &looks)
{
  auto functor = plane(space);
  functor.moves = false;
  functor.encounter.looked = true;
  for (int k = 0; k < Bubble::LOOKS; k++)
    functor.encounter.looks.column[k] = space.column(looks, k);
  if (model.stop == Bubble::Stop::CONTACT) functor.films = now(space);
  meet(space, functor);
}

}    // namespace LAMMPS_NS

#endif
#endif
