/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/films,FixBubbleFilms);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_FILMS_H
#define LMP_FIX_BUBBLE_FILMS_H

#include "bubble_collision.h"
#include "fix_foam_records.h"

namespace LAMMPS_NS {

// h0 of contacts.  Pair style bubble/collision makes one by itself for those of bubbles.

class FixBubbleFilms : public FixFoamRecords {
 public:
  FixBubbleFilms(class LAMMPS *, int, char **);
  int setmask() override;

  // one evaluation of forces: run(films) brings records up to date, and tells how many contacts a bubble has at most

  template <class Space, class Run> void evaluate(Space &space, int nmax, Run &&run)
  {
    history.committed.use(nmax);
    for (bool again = false;; again = true) {
      const int most = run(films(space, true, again));
      if (most <= history.slots()) return;
      make_room(most);
    }
  }

  template <class Space> Bubble::Films now(Space &space)    // to be read
  {
    return films(space, false, false);
  }

 protected:
  struct Derived {
  };    // which keeps records at the end of its own constructor: nothing fails afterwards
  FixBubbleFilms(class LAMMPS *, int, char **, Derived);
  void look_at(int) override {}

 private:
  template <class Space> Bubble::Films films(Space &space, bool renewed, bool again)
  {
    return {history.records(space, history.committed), true, renewed, again};
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
