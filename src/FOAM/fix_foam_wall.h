/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/wall,FixFoamWall);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_WALL_H
#define LMP_FIX_FOAM_WALL_H

#include "fix.h"
#include "foam_columns.h"
#include "foam_laws.h"
#include "foam_wall.h"
#include "pair_foam.h"

#include "atom.h"
#include "domain.h"

#include <type_traits>
#include <vector>

namespace LAMMPS_NS {

// Walls at faces of the box.  Their forces are added here; that they hold bubbles and cover them, Foam::Drag and
// Foam::Exchange have to know: the hub tells them.

class FixFoamWall : public Fix {
 public:
  FixFoamWall(class LAMMPS *, int, char **);
  ~FixFoamWall() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void min_setup(int) override;
  void post_force(int) override;
  void min_post_force(int) override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double memory_usage() override;

 protected:
  PairFoam *pair = nullptr;
  FoamColumnList all_columns;
  FoamColumns stress{all_columns, "stress at walls", 3};    // for output per atom only
  Foam::Sums<Foam::WallTotals> totals;    // of this rank, of the forces that were added last

  virtual void push();
  virtual Foam::WallTotals fetch() { return totals.known; }
  virtual void host_reads() {}
  template <class Space> void push_in(Space &space);

 private:
  std::vector<int> faces;
  double drag = 0.0;
  bool covers = false;
  bool reduced = false;    // all_totals are those of totals, of all ranks
  Foam::WallTotals all_totals;

  void check_box() const;
  const Foam::WallTotals &of_all_ranks();
};

template <class Space> void FixFoamWall::push_in(Space &space)
{
  Foam::Walls walls;
  for (int face : faces) walls.add(face, pair->hub.place_of(face), drag, groupbit);
  auto stress_along = [&](int k) {
    return vflag_atom ? space.column(stress, k) : nullptr;
  };
  Foam::with_law(pair->law, [&](const auto &law) {
    const Foam::PushFromWalls<std::decay_t<decltype(law)>, typename Space::Bubbles> functor{
        space.bubbles(),
        walls,
        law,
        pair->coefficients(),
        {stress_along(0), stress_along(1), stress_along(2)}};
    totals = space.template own_sums<Foam::WallTotals>(atom->nlocal, functor);
  });
}

}    // namespace LAMMPS_NS

#endif
#endif
