/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_WALLS_H
#define LMP_LIQUID_WALLS_H

#include "foam_physics.h"

namespace Liquid {

// Walls are faces of the box.  The liquid goes on behind them as its mirror image, which needs no particles: an image of j
// is within reach of i only if j is, or j = i.  So where i is near walls, its neighbors and itself are taken
// once more for each wall, edge and corner.

struct Walls {
  enum Kind { NONE, NOSLIP, SLIP };    // symmetric: as slip
  int kind[3][2] = {};                 // of each axis, at its low and high end
  double place[3][2] = {};

  FOAM_FUNCTION bool any() const
  {
    for (int k = 0; k < 3; k++)
      if (kind[k][0] || kind[k][1]) return true;
    return false;
  }

  // A particle that has come through a wall goes back to where its image is, and goes no further: true if it has come

  FOAM_FUNCTION bool keep(int k, double &x, double &u) const
  {
    for (int end = 0; end < 2; end++) {
      const double outwards = end ? 1.0 : -1.0, beyond = outwards * (x - place[k][end]);
      if (kind[k][end] == NONE || !(beyond > 0.0)) continue;
      x = place[k][end] - outwards * beyond;
      if (u * outwards > 0.0) u = 0.0;
      return true;
    }
    return false;
  }
};

// The walls that a particle is near to: at most one across each axis, since boxes are wider than that

struct NearWalls {
  int axes = 0;      // bits of those with a wall
  int noslip = 0;    // those of them with one that liquid sticks to
  double place[3] = {0.0, 0.0, 0.0};

  template <class X> FOAM_FUNCTION NearWalls(const Walls &walls, const X &x, double reach)
  {
    for (int k = 0; k < 3; k++)
      for (int end = 0; end < 2; end++)
        if (walls.kind[k][end] && std::fabs(x[k] - walls.place[k][end]) < reach) {
          axes |= 1 << k;
          if (walls.kind[k][end] == Walls::NOSLIP) noslip |= 1 << k;
          place[k] = walls.place[k][end];
        }
  }
};

// A particle's image across some of these axes

struct Image {
  int axes, noslip;
  double place[3];

  FOAM_FUNCTION bool across(int k) const { return axes & (1 << k); }
  FOAM_FUNCTION double coordinate(double x, int k) const
  {
    return across(k) ? 2.0 * place[k] - x : x;
  }

  // reversed at each wall without slip, in its normal part at each with slip

  FOAM_FUNCTION double velocity(double u, int k) const
  {
    bool reversed = across(k) && !(noslip & (1 << k));
    for (int wall = 0; wall < 3; wall++)
      if (noslip & (1 << wall)) reversed = !reversed;
    return reversed ? -u : u;
  }
  FOAM_FUNCTION double vector(double n, int k) const { return across(k) ? -n : n; }
  FOAM_FUNCTION Image slipping() const { return {axes, 0, {place[0], place[1], place[2]}}; }
};

// The particle itself, of another type, so that loops over most particles know nothing of walls

struct Itself {
  static constexpr int axes = 0;
  FOAM_FUNCTION double coordinate(double x, int) const { return x; }
  FOAM_FUNCTION double velocity(double u, int) const { return u; }
  FOAM_FUNCTION double vector(double n, int) const { return n; }
  FOAM_FUNCTION Itself slipping() const { return {}; }
};

FOAM_FUNCTION Image image_across(const NearWalls &near, int axes)
{
  return {axes, near.noslip & axes, {near.place[0], near.place[1], near.place[2]}};
}

}    // namespace Liquid

#endif
