/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_WALL_H
#define LMP_FOAM_WALL_H

#include "foam_contacts.h"

// Walls at faces of the box: whom they touch, what they cover, how they push

namespace Foam {

// Faces in LAMMPS' order: xlo, xhi, ylo ...  Not more than there are in all, see FixFoamWall.

struct Walls {
  static constexpr int MOST = 6;
  int count = 0;
  int face[MOST] = {}, groupbit[MOST] = {};
  double place[MOST] = {}, drag[MOST] = {};
  const int *mask = nullptr;    // none: all walls are for all particles

  void add(int its_face, double its_place, double its_drag, int its_groupbit)
  {
    face[count] = its_face;
    place[count] = its_place;
    drag[count] = its_drag;
    groupbit[count++] = its_groupbit;
  }

  FOAM_FUNCTION int axis(int w) const { return face[w] / 2; }
  FOAM_FUNCTION double inward(int w) const { return face[w] % 2 ? -1.0 : 1.0; }
  template <class B> FOAM_FUNCTION double distance(const B &b, int i, int w) const
  {
    return inward(w) * (b.x(i, axis(w)) - place[w]);
  }
  FOAM_FUNCTION bool feels(int i, int w) const { return !mask || (mask[i] & groupbit[w]); }

  // what is left of v, a component along axis k; each wall that the bubble touches takes its part

  template <class B> FOAM_FUNCTION double hold(const B &b, int i, int k, double v) const
  {
    return count == 0 ? v : held(b, i, k, v);
  }

  // area of the bubble's surface that walls cut off

  template <int D, class B> FOAM_FUNCTION double cover(const B &b, int i) const
  {
    return count == 0 ? 0.0 : covered<D>(b, i);
  }

 private:
  template <class B> FOAM_RARELY_CALLED double held(const B &b, int i, int k, double v) const
  {
    for (int w = 0; w < count; w++)
      if (axis(w) != k && feels(i, w) && distance(b, i, w) < b.radius(i))
        v = velocity_along_wall(v, drag[w]);
    return v;
  }
  template <int D, class B> FOAM_RARELY_CALLED double covered(const B &b, int i) const
  {
    double area = 0.0;
    for (int w = 0; w < count; w++)
      if (feels(i, w)) area += wall_area<D>(distance(b, i, w), b.radius(i));
    return area;
  }
};

struct WallTotals {
  static constexpr int SLOT = 0;
  FoamSum force[3], touching, energy;    // force: on the walls
  FoamSum virial[3];    // relative to the wall, so that force / area is the pressure
  FOAM_FUNCTION void join(const WallTotals &other)
  {
    for (int k = 0; k < 3; k++) force[k].join(other.force[k]);
    touching.join(other.touching);
    energy.join(other.energy);
    for (int k = 0; k < 3; k++) virial[k].join(other.virial[k]);
  }
};

// Forces of walls on bubbles, added to those that there are

template <class Law, class B> struct PushFromWalls {
  static constexpr const char *NAME = "foam: walls";
  B b;
  Walls walls;
  Law law;
  Coefficients coefficients;
  double *stress[3];    // of each bubble, along the axes; or none

  FOAM_FUNCTION void operator()(int i, WallTotals &all) const
  {
    const double R = b.radius(i);
    double virial[3] = {};
    bool touches = false;
    for (int w = 0; w < walls.count && R > 0.0; w++) {
      const double s = walls.distance(b, i, w);
      if (!(s < law.range() * R)) continue;
      const double stiffness = coefficients.stiffness(b.type(i), b.type(i));
      const double overlap = wall_overlap(s, R), F = law.force(stiffness, overlap, R, 0.0);
      const int k = walls.axis(w);
      b.f(i, k) += walls.inward(w) * F;
      all.force[k] += -walls.inward(w) * F;
      all.energy += law.energy(stiffness, overlap, R, 0.0);
      virial[k] += F * s;
      if (overlap > 0.0) touches = true;
    }
    if (touches) all.touching += 1.0;
    for (int k = 0; k < 3; k++) {
      all.virial[k] += virial[k];
      if (stress[k]) stress[k][i] = virial[k];
    }
  }
};

}    // namespace Foam

#endif
