/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_BUBBLES_H
#define LMP_LIQUID_BUBBLES_H

#include "foam_start.h"
#include "liquid_operators.h"

#include <cstdint>

// Bubbles in the liquid [K23], as functors for each bubble, and for each particle of the liquid what bubbles do to it.  What is
// at a bubble is a mean over the particles around it, each with its own h:
//   phi_b = sum_i phi_i W(|r_b - r_i|, h_i) V_i / V_lb,  V_lb = sum_i W V_i
// What it does to them goes back with the same weights, M_i = sum_b M_b W / V_lb, so that sum_i V_i M_i = sum_b M_b.

namespace Liquid {

enum AtBubble {
  AROUND,    // V_lb
  FLOW,      // u_l
  CURL = FLOW + 3,
  TURBULENCE = CURL + 3,    // k
  EPS_B,
  LIQUID_ACCELERATION,    // du_l/dt
  DRAG = LIQUID_ACCELERATION + 3,
  LIFT_FORCE = DRAG + 3,
  VIRTUAL = LIFT_FORCE + 3,
  BUOYANCY = VIRTUAL + 3,
  BUBBLE_ACCELERATION = BUOYANCY + 3,
  NORMAL_B = BUBBLE_ACCELERATION + 3,    // of the surface; not divided by V_lb
  NEIGHBORS = NORMAL_B + 3,              // particles around it,
  ON_SURFACE,                            // and those of them on the surface
  REACTION,                              // M_b, nu_b, 1/V_lb: ghosts have these
  VISCOSITY_B = REACTION + 3,
  INVERSE_AROUND,
  AT_BUBBLES
};

// What a bubble keeps from step to step

enum BubbleState {
  TURBULENT,                   // velocity of the liquid that is not resolved
  DEFORMED = TURBULENT + 3,    // L
  STRESSED,                    // integral of eps over its life
  AGE,
  MEETS,    // 1 while the surface is near,
  LEFT,     // and time until it is there, < 0 afterwards
  GONE,     // 1 once it has burst
  BUBBLE_STATES
};
inline constexpr int BEFORE_STEP = 3 + BUBBLE_STATES;    // velocities, too

struct BubbleColumns {
  double *at[AT_BUBBLES], *kept[BUBBLE_STATES];
  FOAM_FUNCTION double &operator()(int c, int i) const { return at[c][i]; }
  FOAM_FUNCTION double &state(int c, int i) const { return kept[c][i]; }
};

struct BubbleSetting {
  double We = 1.0, Fr = 0.0, beta = 1.0;    // Fr 0: no gravity
  bool turbulence = false, breaks = false, surface = true;
  bool drag = true, lift = true, virtual_mass = true, substeps = true;
  enum Viscosity { NONE, SATO, PUBLISHED } viscosity = SATO;
  double lasts = -1.0;    // of a film at the surface; < 0: by We, Fr and Re
};

template <class Row, class B, class Visit>
FOAM_ALWAYS_INLINE void particles_around(const Row &row, const B &b, const Columns &c,
                                         const Visit &visit)
{
  const int i = row.i;
  row.for_each([&](int j, auto) {
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
      const double d = b.x(i, k) - b.x(j, k);
      square += d * d;
    }
    const Kernel W(c(H, j));
    if (square < W.reach() * W.reach()) visit(j, W(std::sqrt(square)));
  });
}

struct Curl {    // of the velocity, from its gradient
  static constexpr const char *NAME = "liquid: curl";
  Columns c;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < 3; k++) {
      const int a = (k + 1) % 3, d = (k + 2) % 3;
      c(VORTEX + k, i) = c(GRADIENT + 3 * a + d, i) - c(GRADIENT + 3 * d + a, i);
    }
  }
};

template <class B, class List> struct Interpolate {
  static constexpr const char *NAME = "liquid: interpolate to bubbles";
  B b;
  List list;
  Columns c;
  BubbleColumns at;
  Setting set;
  const double *acceleration[3];    // of particles
  bool surface;                     // is it looked for
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = list.row(n);
    const int i = row.i;
    double around = 0.0, u[3] = {}, curl[3] = {}, k_sum = 0.0, eps = 0.0, dudt[3] = {};
    double normal[3] = {}, count = 0.0, on_surface = 0.0;
    particles_around(row, b, c, [&](int j, double w) {
      const double f = w * set.volume_of_liquid() / c(ALPHA, j);
      around += f;
      k_sum += f * c(UNRESOLVED, j);
      eps += f * c(EPSILON, j);
      for (int k = 0; k < 3; k++) {
        u[k] += f * b.v(j, k);
        curl[k] += f * c(VORTEX + k, j);
        dudt[k] += f * acceleration[k][j];
      }
      if (!surface) return;
      count += 1.0;
      if (c(SURFACE, j) > 0.0) on_surface += 1.0;
      for (int k = 0; k < 3; k++) normal[k] += f * c(NORMAL + k, j);
    });
    const double inverse = around > 0.0 ? 1.0 / around : 0.0;
    at(AROUND, i) = around;
    at(INVERSE_AROUND, i) = inverse;
    at(TURBULENCE, i) = inverse * k_sum;
    at(EPS_B, i) = inverse * eps;
    at(NEIGHBORS, i) = count;
    at(ON_SURFACE, i) = on_surface;
    for (int k = 0; k < 3; k++) {
      at(NORMAL_B + k, i) = normal[k];
      at(FLOW + k, i) = inverse * u[k];
      at(CURL + k, i) = inverse * curl[k];
      at(LIQUID_ACCELERATION + k, i) = inverse * dudt[k];
    }
  }
};

// u_l = what is resolved + u', which goes on by dt

template <class B> struct AddTurbulence {
  static constexpr const char *NAME = "liquid: turbulence at bubbles";
  B b;
  BubbleColumns at;
  Setting set;
  std::uint64_t seed;    // of this step
  double dt;
  FOAM_FUNCTION void operator()(int i) const
  {
    double relative[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
      relative[k] = at(FLOW + k, i) - b.v(i, k);
      square += relative[k] * relative[k];
    }
    if (dt > 0.0) {
      const Langevin process(at(TURBULENCE, i), std::sqrt(square), set.h0, dt);
      const Foam::Draws draws(seed, b.tag(i));
      const double inverse = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
      double zeta[3], along[2] = {0.0, 0.0};    // parts of u' and zeta along the relative velocity
      for (int k = 0; k < 3; k++) {
        zeta[k] = draws.normal(2 * k);
        along[0] += relative[k] * inverse * at.state(TURBULENT + k, i);
        along[1] += relative[k] * inverse * zeta[k];
      }
      for (int k = 0; k < 3; k++) {
        const double r = relative[k] * inverse;
        at.state(TURBULENT + k, i) = process.E[1] * at.state(TURBULENT + k, i) +
                                     (process.E[0] - process.E[1]) * along[0] * r +
                                     process.W[1] * zeta[k] +
                                     (process.W[0] - process.W[1]) * along[1] * r;
      }
    }
    for (int k = 0; k < 3; k++) at(FLOW + k, i) += at.state(TURBULENT + k, i);
  }
};

// Forces on a bubble at a velocity.  A bubble that no liquid is around falls.

struct OnBubble {
  double drag;    // F_d = drag (u_l - u_b)
  double lift[3], buoyancy[3];
  double other[3];         // by pair styles and fixes
  double volume, added;    // and beta C_vm V_b, of the virtual mass
  double speed;            // |u_rel|

  template <class B>
  FOAM_FUNCTION OnBubble(const B &b, const BubbleColumns &at, const Setting &set,
                         const BubbleSetting &gas, int i, const double *velocity)
  {
    const double a = b.radius(i), wet = at(AROUND, i) > 0.0 ? 1.0 : 0.0;
    volume = bubble_volume(a);
    added = gas.virtual_mass ? wet * VIRTUAL_MASS * gas.beta * volume : 0.0;
    double relative[3], square = 0.0;
    for (int k = 0; k < 3; k++) {
      relative[k] = at(FLOW + k, i) - velocity[k];
      square += relative[k] * relative[k];
    }
    speed = wet * std::sqrt(square);
    drag = gas.drag ? wet * drag_factor(a, speed, set.Re, gas.beta) : 0.0;
    const double factor = gas.lift ? wet * LIFT * gas.beta * volume : 0.0;
    for (int k = 0; k < 3; k++) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      lift[k] = factor * (relative[l] * at(CURL + m, i) - relative[m] * at(CURL + l, i));
      buoyancy[k] = (1.0 - wet * gas.beta) * volume * set.gravity[k];
      other[k] = gas.beta * b.f(i, k);
    }
  }
};

// All of them in the present state, the acceleration, for which that of the virtual mass is solved, and the reaction

template <class B> struct BubbleForces {
  static constexpr const char *NAME = "liquid: forces on bubbles";
  B b;
  BubbleColumns at;
  Setting set;
  BubbleSetting gas;
  FOAM_FUNCTION void operator()(int i) const
  {
    const double velocity[3] = {b.v(i, 0), b.v(i, 1), b.v(i, 2)};
    const OnBubble on(b, at, set, gas, i, velocity);
    for (int k = 0; k < 3; k++) {
      const double d = at(DRAG + k, i) = on.drag * (at(FLOW + k, i) - velocity[k]);
      const double l = at(LIFT_FORCE + k, i) = on.lift[k], dudt = at(LIQUID_ACCELERATION + k, i);
      at(BUOYANCY + k, i) = on.buoyancy[k];
      const double acceleration = at(BUBBLE_ACCELERATION + k, i) =
          (d + l + on.buoyancy[k] + on.other[k] + on.added * dudt) / (on.volume + on.added);
      const double v = at(VIRTUAL + k, i) = on.added * (dudt - acceleration);
      at(REACTION + k, i) = -(d + l + v) / gas.beta;
    }
    at(VISCOSITY_B, i) = viscosity(b.radius(i), on.speed);
  }
  FOAM_FUNCTION double viscosity(double a, double speed) const
  {
    switch (gas.viscosity) {
      case BubbleSetting::SATO:
        return bubble_viscosity_sato(a, speed, set.Re);
      case BubbleSetting::PUBLISHED:
        return bubble_viscosity(a, speed);
      default:
        return 0.0;
    }
  }
};

struct BubbleTotals {
  Foam::FoamSum gone, broken;
  Foam::FoamMax speed;    // squared
  FOAM_FUNCTION void join(const BubbleTotals &other)
  {
    gone.join(other.gone);
    broken.join(other.broken);
    speed.join(other.speed);
  }
};

template <class B> struct SpeedOfBubbles {    // before the first step
  static constexpr const char *NAME = "liquid: speed of bubbles";
  B b;
  FOAM_FUNCTION void operator()(int i, BubbleTotals &all) const
  {
    double speed = 0.0;
    for (int k = 0; k < 3; k++) speed += b.v(i, k) * b.v(i, k);
    all.speed.raise(speed);
  }
};

// Bubbles as they were before a step, which may be repeated

template <class B> struct KeepBubbles {
  static constexpr const char *NAME = "liquid: keep bubbles";
  B b;
  BubbleColumns at;
  double *kept[BEFORE_STEP];
  bool back;    // from there
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < 3; k++) exchange(b.v(i, k), kept[k][i]);
    for (int k = 3; k < BEFORE_STEP; k++) exchange(at.state(k - 3, i), kept[k][i]);
  }
  template <class Number> FOAM_FUNCTION void exchange(Number &now, double &before) const
  {
    if (back)
      now = before;
    else
      before = now;
  }
};

// What a surface dissipates that entrains bubbles

struct KeepEntraining {
  static constexpr const char *NAME = "liquid: entraining surface";
  Columns c;
  double *dissipates;
  FOAM_FUNCTION void operator()(int i) const
  {
    const bool does = c(SURFACE, i) > 0.0 && entrains(c(EPSILON, i), c(ALPHA, i));
    dissipates[i] = does ? c(EPSILON, i) : 0.0;
  }
};

// Bubbles grow older, longer, and near the surface; and who bursts or breaks at the end of the step

template <class B> struct AgeBubbles {
  static constexpr const char *NAME = "liquid: age of bubbles";
  static constexpr double FEWEST = 20.0;    // particles around a bubble that is in the liquid
  B b;
  BubbleColumns at;
  Setting set;
  BubbleSetting gas;
  double dt;
  FOAM_FUNCTION void operator()(int i, BubbleTotals &all) const
  {
    const double a = b.radius(i), eps = at(EPS_B, i);
    double speed = 0.0;
    for (int k = 0; k < 3; k++) speed += b.v(i, k) * b.v(i, k);
    all.speed.raise(speed);
    at.state(AGE, i) += dt;
    at.state(STRESSED, i) += eps * dt;
    if (gas.breaks) {
      double &length = at.state(DEFORMED, i);
      length = std::fmax(length + dt * deformation_speed(eps, a, gas.We), 0.0);
      if (length > 2.0 * a) all.broken += 1.0;
    }
    if (!gas.surface) return;
    double normal = 0.0, along = 0.0;
    for (int k = 0; k < 3; k++) {
      normal += at(NORMAL_B + k, i) * at(NORMAL_B + k, i);
      along += (at(FLOW + k, i) - b.v(i, k)) * at(NORMAL_B + k, i);
    }
    normal = std::sqrt(normal);
    const bool near = nearness(normal, at(AROUND, i)) > LEAST_NEARNESS;
    bool burst = at(NEIGHBORS, i) < FEWEST && at(ON_SURFACE, i) == at(NEIGHBORS, i);
    if (!near) {
      at.state(MEETS, i) = 0.0;
    } else if (!(at.state(MEETS, i) > 0.0)) {
      const double T = set.dr * normal / std::fmax(std::fabs(along), 1.0e-300);
      if (at.state(AGE, i) > T) {
        at.state(MEETS, i) = 1.0;
        at.state(LEFT, i) = T;
      }
    } else {
      at.state(LEFT, i) -= dt;
      if (at.state(LEFT, i) < -lasts(a)) burst = true;
    }
    if (burst) {
      at.state(GONE, i) = 1.0;
      all.gone += 1.0;
    }
  }
  FOAM_FUNCTION double lasts(double a) const
  {
    if (gas.lasts >= 0.0) return gas.lasts;
    return gas.Fr > 0.0 ? persistence(gas.We, gas.Fr, set.Re, a) : 0.0;
  }
};

// New velocities.  Drag is stiff: it is taken at the end of as many sub-steps as it has relaxation times in the step, and the
// liquid gets the mean of what they have done.

template <class B> struct MoveBubbles {
  static constexpr const char *NAME = "liquid: move bubbles";
  static constexpr double MOST = 100.0;    // as fmin of a device wants it
  B b;
  BubbleColumns at;
  Setting set;
  BubbleSetting gas;
  double dt;
  FOAM_FUNCTION void operator()(int i) const
  {
    double velocity[3] = {b.v(i, 0), b.v(i, 1), b.v(i, 2)}, reaction[3] = {};
    const OnBubble first(b, at, set, gas, i, velocity);
    const double times = dt * first.drag / (first.volume + first.added);
    const int steps = gas.substeps ? static_cast<int>(std::fmin(std::ceil(times + 0.5), MOST)) : 1;
    const double step = dt / steps;
    double normal[3] = {}, held = 0.0;
    if (gas.surface && at.state(MEETS, i) > 0.0) {
      double square = 0.0;
      for (int k = 0; k < 3; k++) square += at(NORMAL_B + k, i) * at(NORMAL_B + k, i);
      held = held_at_surface(nearness(std::sqrt(square), at(AROUND, i)));
      if (square > 0.0)    // else nothing is around it any more
        for (int k = 0; k < 3; k++) normal[k] = at(NORMAL_B + k, i) / std::sqrt(square);
    }
    for (int n = 0; n < steps; n++) {
      const OnBubble on(b, at, set, gas, i, velocity);
      const double mass = on.volume + on.added;
      double at_surface = 0.0;
      if (held > 0.0) at_surface = held * holding(on, i, velocity, normal);
      for (int k = 0; k < 3; k++) {
        const double dudt = at(LIQUID_ACCELERATION + k, i), u = velocity[k];
        const double fs = at_surface * normal[k];
        const double others = on.lift[k] + on.buoyancy[k] + on.other[k] + on.added * dudt + fs;
        velocity[k] = (u + step / mass * (others + on.drag * at(FLOW + k, i))) /
                      (1.0 + step * on.drag / mass);
        reaction[k] -= on.drag * (at(FLOW + k, i) - velocity[k]) + on.lift[k] + fs +
                       on.added * (dudt - (velocity[k] - u) / step);
      }
    }
    for (int k = 0; k < 3; k++) {
      b.v(i, k) = velocity[k];
      at(REACTION + k, i) = reaction[k] / (steps * gas.beta);
    }
  }

  // Force along the normal that brings a bubble to the surface in the time that is left, as if there were no other
  // [K23 (2.22)]

  FOAM_FUNCTION double holding(const OnBubble &on, int i, const double *velocity,
                               const double *normal) const
  {
    const double left = std::fmax(at.state(LEFT, i), dt);
    double force = 0.0;
    for (int k = 0; k < 3; k++) {
      const double relative = at(FLOW + k, i) - velocity[k];
      const double others = on.buoyancy[k] + on.other[k] + on.drag * relative + on.lift[k] +
                            on.added * at(LIQUID_ACCELERATION + k, i);
      force += normal[k] * ((on.volume + on.added) * relative / left - others);
    }
    return force;
  }
};

// and what the liquid gets of it

template <class B, class List> struct TakeReaction {
  static constexpr const char *NAME = "liquid: take reaction of bubbles";
  B b;
  List list;
  Columns c;
  BubbleColumns at;
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = list.row(n);
    const int i = row.i;
    const Kernel W(c(H, i));
    double M[3] = {}, nu = 0.0;
    row.for_each([&](int j, auto) {
      double square = 0.0;
      for (int k = 0; k < 3; k++) {
        const double d = b.x(i, k) - b.x(j, k);
        square += d * d;
      }
      if (!(square < W.reach() * W.reach())) return;
      const double f = W(std::sqrt(square)) * at(INVERSE_AROUND, j);
      for (int k = 0; k < 3; k++) M[k] += f * at(REACTION + k, j);
      nu += f * at(VISCOSITY_B, j);
    });
    c(NU_B, i) = nu;
    for (int k = 0; k < 3; k++) c(BY_BUBBLES + k, i) = M[k];
  }
};

}    // namespace Liquid

#endif
