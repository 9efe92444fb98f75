/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_BUBBLE_LIQUID_H
#define LMP_BUBBLE_LIQUID_H

#include "bubble_physics.h"
#include "foam_bubbles.h"

#include <cmath>

// What the liquid does to bubbles with inertia, and the loops that do it.
//   (rho_g + C rho) V du/dt = (rho_g - rho) V g + drag + forces of collisions

namespace Bubble {

struct Liquid {
  double rho = 0.0, mu = 0.0, g[3] = {0.0, 0.0, 0.0};
  double added = 0.5;    // C
  Drag drag = Drag::CONTAMINATED;
};

struct LiquidTotals {
  Foam::FoamSum buoyancy, drag;    // powers
  FOAM_FUNCTION void join(const LiquidTotals &other)
  {
    buoyancy.join(other.buoyancy);
    drag.join(other.drag);
  }
};

// mass: that of the gas

FOAM_FUNCTION double effective_mass(const Liquid &liquid, double mass, double R)
{
  return mass + liquid.added * liquid.rho * volume(R);
}

template <class B> struct Rise {
  static constexpr const char *NAME = "bubble: rise";
  B b;
  Liquid liquid;
  const double *flow[3];    // velocity of the liquid; or none
  double *stiffness;        // of the drag; or none
  bool moves = true;
  double *drag_of[3]{}, *buoyancy_of[3]{};    // columns to look at

  FOAM_FUNCTION void operator()(int i, LiquidTotals &all) const
  {
    const double R = b.radius(i), m = b.mass(i);
    double u[3], relative[3], slip = 0.0;
    for (int k = 0; k < 3; k++) {
      u[k] = b.v(i, k);
      relative[k] = flow[k] ? u[k] - flow[k][i] : u[k];
      slip += relative[k] * relative[k];
    }
    const double coefficient = drag(liquid.drag, liquid.rho, liquid.mu, R, std::sqrt(slip));
    const double weight = m - liquid.rho * volume(R);
    for (int k = 0; k < 3; k++) {
      const double lift = weight * liquid.g[k], friction = -coefficient * relative[k];
      if (moves) b.f(i, k) += lift + friction;
      all.buoyancy += lift * u[k];
      all.drag += friction * u[k];
      if (drag_of[k]) drag_of[k][i] = friction;
      if (buoyancy_of[k]) buoyancy_of[k][i] = lift;
    }
    if (stiffness) stiffness[i] = coefficient;
  }
};

// with the mass that the liquid adds

struct KineticEnergy {
  Foam::FoamSum sum;
  FOAM_FUNCTION void join(const KineticEnergy &other) { sum.join(other.sum); }
};

template <class B> struct AddKinetic {
  static constexpr const char *NAME = "bubble: kinetic energy";
  B b;
  Liquid liquid;
  FOAM_FUNCTION void operator()(int i, KineticEnergy &all) const
  {
    double square = 0.0;
    for (int k = 0; k < 3; k++) square += b.v(i, k) * b.v(i, k);
    all.sum += 0.5 * effective_mass(liquid, b.mass(i), b.radius(i)) * square;
  }
};

// for bubbles that the liquid does not act on

struct ClearColumn {
  static constexpr const char *NAME = "bubble: clear column";
  double *column;
  FOAM_FUNCTION void operator()(int i) const { column[i] = 0.0; }
};

}    // namespace Bubble

#endif
