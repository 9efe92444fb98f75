/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_HUB_H
#define LMP_FOAM_HUB_H

#include "foam_bubbles.h"
#include "foam_gas.h"

#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

// What belongs to a foam as a whole.  The pair style has it, since every foam has one (PairFoam); fixes and computes
// ask it, and nobody else.

class FoamHub : protected Pointers {
 public:
  FoamHub(LAMMPS *lmp, const char *style) : Pointers(lmp), style(style) {}

  // Facts of the simulation, from its first run on, through later ones and restarts

  struct Record {
    double rin = 0.0, ain = 0.0;    // <R_in>, <A_in>: means at the start of the first run
    double tau = 0.0;               // integral of K dt / <R_in>^2
    double removed_bubbles = 0.0, removed_gas = 0.0;
  };
  Record record;
  bool rin_fixed = false, ain_fixed = false;    // given, or a run has started

  void take_means();                  // of the present bubbles, unless fixed; on all ranks
  void fix_means();                   // a run starts
  void go_on_from(const Record &);    // for a pair style that replaces another
  void tell_means(const char *whence) const;

  // Sums over the living bubbles of an accepted state, the same on all ranks; of the integrator

  struct Population {
    double bubbles = 0.0, radius_sum = 0.0, gas = 0.0, radius_max = 0.0;
  };
  Population population;

  double skin = 0.0;    // that steps of the last run needed; 0: none yet

  // Who is a bubble: the group of the foam's fixes

  int groupbit = Foam::GROUP_ALL;
  static bool integrates(const class Fix *);    // does this fix move the bubbles of a foam?
  void find_group();

  // What each evaluation gathers beside the forces: Foam::FILM, AREA; of the gas exchange

  unsigned gas_wanted = 0;
  Foam::LiquidLaw liquid_law = Foam::LiquidLaw::AREA;
  bool radii_change = false;

  // Sums over all bubbles for exchange through the liquid, where they come with the forces

  Foam::Sums<Foam::FreeSurface> free_surface;
  bool free_surface_known = false;

  // Walls at faces of the box, of fixes foam/wall; as functors take them, where the box is now

  struct Wall {
    const class Fix *of;
    int face;
    double drag;
    bool covers;
  };
  std::vector<Wall> walls;
  void take_away(const class Fix *);    // its walls

  enum WallsThat { HOLD, COVER };
  template <class Space> Foam::Walls walls_that(WallsThat act, Space &space) const
  {
    if (walls.empty()) return {};
    int group = Foam::GROUP_ALL;
    Foam::Walls found = walls_now(act, group);
    found.mask = space.members(group).mask;
    return found;
  }
  double place_of(int face) const;

 private:
  Foam::Walls walls_now(WallsThat, int &group) const;    // group: not all, if one has a smaller one
  const char *const style;
};

}    // namespace LAMMPS_NS

#endif
