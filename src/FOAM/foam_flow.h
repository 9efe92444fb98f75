/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_FLOW_H
#define LMP_FOAM_FLOW_H

#include "foam_bubbles.h"

#include "lmptype.h"

#include <limits>

// The velocity of the liquid around each bubble, where a flow is imposed: see AmbientVelocity in foam_drag.h

namespace Foam {

struct FlowVelocity {    // columns; NaN where nothing is imposed
  double *u[3];

  FOAM_FUNCTION bool imposed(int i) const { return u[0][i] == u[0][i]; }
  FOAM_FUNCTION void put(int i, const double *velocity) const
  {
    for (int k = 0; k < 3; k++) u[k][i] = velocity[k];
  }
};

struct ClearFlow {
  static constexpr const char *NAME = "foam: clear flow";
  FlowVelocity flow;
  double none = std::numeric_limits<double>::quiet_NaN();
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < 3; k++) flow.u[k][i] = none;
  }
};

template <class B> struct FlowWithBox {
  static constexpr const char *NAME = "foam: flow with the box";
  B b;
  Members member;    // whom the flow is for
  AffineFlow affine;
  FlowVelocity flow;
  FOAM_FUNCTION void operator()(int i) const
  {
    if (!member(i)) return;
    const double x[3] = {b.place(i, 0), b.place(i, 1), b.place(i, 2)};
    double u[3];
    affine(x, u);
    flow.put(i, u);
  }
};

// The velocity of the box at each place, added to given velocities or taken off

template <int D, class B> struct AddAffine {
  static constexpr const char *NAME = "foam: velocity of the box";
  B b;
  AffineFlow affine;
  double *given[3];
  double sign;
  AddAffine reversed() const
  {
    AddAffine other = *this;
    other.sign = -sign;
    return other;
  }
  FOAM_FUNCTION void operator()(int i) const
  {
    const double x[3] = {b.x(i, 0), b.x(i, 1), b.x(i, 2)};
    double u[3];
    affine(x, u);
    for (int k = 0; k < D; k++) given[k][i] += sign * u[k];
  }
};

// A bubble that leaves a box through a side that moves comes back with the velocity of its image.  Between the two,
// velocities are those of the bubble as if it had never come back, which no exchange and no flip of the box changes.

template <int D, class B> struct ShiftByImages {
  static constexpr const char *NAME = "foam: velocities of images";
  B b;
  const LAMMPS_NS::imageint *image;
  AffineFlow affine;
  double *before[3];    // f_{n-1}, or none
  double sign;
  FOAM_FUNCTION void operator()(int i) const
  {
    using namespace LAMMPS_NS;
    const double boxes[3] = {static_cast<double>((image[i] & IMGMASK) - IMGMAX),
                             static_cast<double>(((image[i] >> IMGBITS) & IMGMASK) - IMGMAX),
                             static_cast<double>((image[i] >> IMG2BITS) - IMGMAX)};
    double dv[3];
    affine.along(boxes, dv);
    for (int k = 0; k < D; k++) {
      if (dv[k] == 0.0) continue;
      b.v(i, k) += sign * dv[k];
      if (before[k]) before[k][i] += sign * dv[k];
    }
  }
};

// What a user sees of a flow

struct FlowTotals {
  FoamSum velocity[3], bubbles, dissipated;
  FOAM_FUNCTION void join(const FlowTotals &other)
  {
    for (int k = 0; k < 3; k++) velocity[k].join(other.velocity[k]);
    bubbles.join(other.bubbles);
    dissipated.join(other.dissipated);
  }
};

template <int D, class B> struct AddFlow {
  static constexpr const char *NAME = "foam: totals of a flow";
  B b;
  FlowVelocity flow;
  double mu0;
  FOAM_FUNCTION void operator()(int i, FlowTotals &all) const
  {
    if (!flow.imposed(i) || !(b.radius(i) > 0.0)) return;
    all.bubbles += 1.0;
    for (int k = 0; k < D; k++) {
      all.velocity[k] += flow.u[k][i];
      all.dissipated += dissipated(mu0, b.v(i, k), flow.u[k][i]);
    }
  }
};

}    // namespace Foam

#endif
