/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_OPERATORS_H
#define LMP_LIQUID_OPERATORS_H

#include "foam_bubbles.h"
#include "liquid_physics.h"
#include "liquid_rows.h"

// One step of the liquid [K23], as functors for each particle.  A particle gathers from its neighbors with its own h.
// Between these loops ghosts get the columns that the next one reads of neighbors:
//
//   TakeGas       c, alpha, h                                         reads bubbles
//   FindClose     the neighbors that all others go through (liquid_rows.h)
//   Gather        L, gradients, cover, shift, closure                 reads alpha, u
//   Smooth        normals of the surface                              reads raw normals
//   Predict       u* = u + (dt/alpha) [div(alpha (1 + nu) grad u) / Re + M] + dt f/m       reads alpha (1 + nu)
//   Assemble      the pressure's matrix and right side                reads u*
//   Project       grad p, u = u* - dt (grad p - e_g/Fr^2), x          reads p

namespace Liquid {

enum Column {
  GAS,    // c
  ALPHA,
  H,
  COVER,      // 3 inside
  SURFACE,    // 1 on the surface, else 0
  NORMAL,     // smoothed
  RAW = NORMAL + 3,
  SHIFT = RAW + 3,         // dt u_ps
  GRADIENT = SHIFT + 3,    // d u_k / d a at 3 a + k
  CORRECTION = GRADIENT + 9,
  STRAIN = CORRECTION + 6,    // |S|
  VORTEX,                     // curl u, k and eps: ghosts have these where there are bubbles
  UNRESOLVED = VORTEX + 3,    // k
  EPSILON,
  NU_S,
  NU_B,
  GRAD_ALPHA,                   // of ln alpha, for the momentum as published
  DIFFUSES = GRAD_ALPHA + 3,    // alpha (1 + nu)
  BY_BUBBLES,                   // M
  VISCOUS = BY_BUBBLES + 3,
  STAR = VISCOUS + 3,    // u*
  DIV_STAR = STAR + 3,
  SOLUTION,    // the new pressure
  GRAD_P,
  COLUMNS = GRAD_P + 3
};

struct Columns {
  double *at[COLUMNS];
  FOAM_FUNCTION double &operator()(int c, int i) const { return at[c][i]; }
};

struct Setting {
  double dr = 0.0, h0 = 0.0, Re = 0.0, Ma = 0.05;
  double gravity[3] = {0.0, 0.0, 0.0};    // e_g / Fr^2
  bool shifts = true, slides = true;      // slides: shifts go along the surface wherever it is near
  bool balanced = true;                   // the pressure of a liquid at rest is found exactly
  bool published = false;                 // momentum as [K23] prints it: see Predict
  bool sticks = false;                    // div u* sees what sticks to walls: see Assemble
  Closure closure;

  FOAM_FUNCTION double volume_of_liquid() const { return dr * dr * dr; }
};

// What the loops have in common

template <class B, class List> struct Loop {
  B b;
  List list;
  Walls walls;
  Columns c;
  Setting set;

  FOAM_FUNCTION double volume(int i) const { return set.volume_of_liquid() / c(ALPHA, i); }
  template <class Visit>
  FOAM_ALWAYS_INLINE void neighbors_of(const typename List::Row &row, const Visit &visit) const
  {
    neighbors<true>(row, b, walls, c(H, row.i), visit);
  }
};

template <class B> struct Advance {    // x* = x + dt u
  static constexpr const char *NAME = "liquid: advance";
  B b;
  Walls walls;
  double dt;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < 3; k++) {
      double u = b.v(i, k), x = b.place(i, k) + dt * u;
      if (walls.keep(k, x, u)) b.v(i, k) = u;
      b.put(i, k, x);
    }
  }
};

// Gas in a particle: of the bubbles within 2 h, h as it was before; images of bubbles count

template <class B, class List> struct TakeGas : Loop<B, List> {
  static constexpr const char *NAME = "liquid: take gas";
  const double *before;
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = this->list.row(n);
    const int i = row.i;
    const Kernel W(before[i] > 0.0 ? before[i] : this->set.h0);
    double sum = 0.0;
    neighbors<false>(row, this->b, this->walls, W.h,
                     [&](int j, const double *, double r, const auto &) {
                       sum += W(r) * bubble_volume(this->b.radius(j));
                     });
    this->c(GAS, i) = sum = std::fmin(sum, MOST_GAS);
    this->c(ALPHA, i) = liquid_fraction(sum);
    this->c(H, i) = smoothing_length(this->set.h0, this->c(ALPHA, i));
  }
};

struct WithoutGas {
  static constexpr const char *NAME = "liquid: without gas";
  Columns c;
  Setting set;
  FOAM_FUNCTION void operator()(int i) const
  {
    c(GAS, i) = c(NU_B, i) = 0.0;
    c(ALPHA, i) = 1.0;
    c(H, i) = set.h0;
    for (int k = 0; k < 3; k++) c(BY_BUBBLES + k, i) = 0.0;
  }
};

struct GatherTotals {
  Foam::FoamSum surface, volume_of_gas, dissipated, entraining;
  Foam::FoamMax nu, gas;
  FOAM_FUNCTION void join(const GatherTotals &other)
  {
    surface.join(other.surface);
    volume_of_gas.join(other.volume_of_gas);
    dissipated.join(other.dissipated);
    entraining.join(other.entraining);
    nu.join(other.nu);
    gas.join(other.gas);
  }
};

template <class B, class List> struct Gather : Loop<B, List> {
  static constexpr const char *NAME = "liquid: gather";
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = this->list.row(n);
    const int i = row.i;
    const auto &c = this->c;
    const Kernel W(c(H, i));
    const double w0 = W(0.0), Vi = this->volume(i);
    const double u[3] = {this->b.v(i, 0), this->b.v(i, 1), this->b.v(i, 2)};
    double A[6] = {}, raw[3] = {}, concentration[3] = {}, difference[3][3] = {}, of_alpha[3] = {};
    double weights = Vi * w0, filtered[3] = {weights * u[0], weights * u[1], weights * u[2]};

    this->neighbors_of(row, [&](int j, const double *r, double distance, const auto &image) {
      const double V = this->volume(j), w = W(distance), s = V * W.slope_over_r(distance);
      const double uj[3] = {this->b.v(j, 0), this->b.v(j, 1), this->b.v(j, 2)};
      const double shifts = s * shift_weight(w, w0);
      weights += V * w;
      for (int k = 0; k < 3; k++) {
        const double image_u = image.axes ? image.velocity(uj[k], k) : uj[k];
        filtered[k] += V * w * image_u;
        raw[k] += s * r[k];
        concentration[k] += shifts * r[k];
        A[k] -= s * r[k] * r[k];
        for (int a = 0; a < 3; a++) difference[a][k] += s * r[a] * (image_u - u[k]);
      }
      if (this->set.published) {
        const double d = s * std::log(c(ALPHA, j) / c(ALPHA, i));
        for (int k = 0; k < 3; k++) of_alpha[k] += d * r[k];
      }
      A[3] -= s * r[0] * r[1];
      A[4] -= s * r[0] * r[2];
      A[5] -= s * r[1] * r[2];
    });

    double L[6], gradient[3][3], square = 0.0;
    correction(A, L);
    for (int k = 0; k < 6; k++) c(CORRECTION + k, i) = L[k];
    c(COVER, i) = A[0] + A[1] + A[2];
    c(SURFACE, i) = c(COVER, i) < SURFACE_COVER ? 1.0 : 0.0;
    for (int k = 0; k < 3; k++) {
      const double column[3] = {difference[0][k], difference[1][k], difference[2][k]};
      double corrected[3];
      multiply(L, column, corrected);
      for (int a = 0; a < 3; a++) c(GRADIENT + 3 * a + k, i) = gradient[a][k] = corrected[a];
      c(RAW + k, i) = W.h * raw[k];
      c(SHIFT + k, i) = shift_of(W.h, concentration[k]);
      const double d = u[k] - filtered[k] / weights;
      square += d * d;
    }
    if (this->set.published) {
      double along[3];
      multiply(L, of_alpha, along);
      for (int k = 0; k < 3; k++) c(GRAD_ALPHA + k, i) = along[k];
    }
    const double S = strain_rate(gradient);
    c(STRAIN, i) = S;
    c(UNRESOLVED, i) = 0.5 * square;
    c(NU_S, i) = eddy_viscosity(this->set.closure, this->set.Re, W.h, S, 0.5 * square);
    c(EPSILON, i) = dissipation(this->set.Re, c(NU_S, i), S);
  }
};

// Totals of the particles, once bubbles have added to the viscosity

struct Account {
  static constexpr const char *NAME = "liquid: account";
  Columns c;
  Setting set;
  FOAM_FUNCTION void operator()(int i, GatherTotals &all) const
  {
    const double V = set.volume_of_liquid(), nu = c(NU_S, i) + c(NU_B, i);
    c(DIFFUSES, i) = c(ALPHA, i) * (1.0 + nu);
    all.surface += c(SURFACE, i);
    all.volume_of_gas += V * c(GAS, i);
    all.dissipated += V * c(EPSILON, i);
    if (c(SURFACE, i) > 0.0 && entrains(c(EPSILON, i), c(ALPHA, i))) all.entraining += 1.0;
    all.nu.raise(nu);
    all.gas.raise(c(GAS, i));
  }
};

// The normal of the surface, by the filter; and what is shifted there: its tangential part.  [K23 (3.12)], which prints the
// normal one, has it on the surface alone.  But particles below it see it, too, and are shifted towards it in each step: the
// liquid swells, or sinks.  So the tangential part is taken wherever the surface is within reach.

template <class B, class List> struct Smooth : Loop<B, List> {
  static constexpr const char *NAME = "liquid: smooth normals";
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = this->list.row(n);
    const int i = row.i;
    const auto &c = this->c;
    const Kernel W(c(H, i));
    bool near = c(SURFACE, i) > 0.0;
    double weights = this->volume(i) * W(0.0), sum[3];
    for (int k = 0; k < 3; k++) sum[k] = weights * c(RAW + k, i);
    this->neighbors_of(row, [&](int j, const double *, double distance, const auto &image) {
      const double f = this->volume(j) * W(distance);
      weights += f;
      if (this->set.slides && c(SURFACE, j) > 0.0) near = true;
      for (int k = 0; k < 3; k++) sum[k] += f * image.vector(c(RAW + k, j), k);
    });
    double along = 0.0, square = 0.0;
    for (int k = 0; k < 3; k++) {
      const double normal = c(NORMAL + k, i) = sum[k] / weights;
      along += normal * c(SHIFT + k, i);
      square += normal * normal;
    }
    if (!(near && square > 0.0)) return;
    for (int k = 0; k < 3; k++) c(SHIFT + k, i) -= along / square * c(NORMAL + k, i);
  }
};

// The source prints the momentum [K23 (2.3), (3.14)] as that of alpha u, with q = alpha p in the place of p: u* =
// (alpha_n u + dt [...]) / alpha, lap q - grad(ln alpha) . grad q - (Ma/dt)^2 q = (alpha/dt) div u* - (Ma/dt)^2 q_n,
// u = u* - dt (grad q / alpha - e_g/Fr^2).  Then a particle speeds up where bubbles gather although nothing pushes it, and
// the buoyancy of a plume counts twice.

template <class B, class List> struct Predict : Loop<B, List> {
  static constexpr const char *NAME = "liquid: predict velocities";
  const double *smoothing;    // of the step before: alpha_n = (h0/h)^3
  double dt;
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = this->list.row(n);
    const int i = row.i;
    const auto &c = this->c;
    const Kernel W(c(H, i));
    const double u[3] = {this->b.v(i, 0), this->b.v(i, 1), this->b.v(i, 2)}, kappa = c(DIFFUSES, i);
    double sum[3] = {};
    this->neighbors_of(row, [&](int j, const double *, double distance, const auto &image) {
      const double weight = harmonic_mean(kappa, c(DIFFUSES, j)) *
                            laplacian_weight(W.slope_over_r(distance), this->volume(j));
      for (int k = 0; k < 3; k++) sum[k] += weight * (u[k] - image.velocity(this->b.v(j, k), k));
    });
    double kept = 1.0;
    if (this->set.published && smoothing[i] > 0.0)
      kept = fraction_of_length(this->set.h0, smoothing[i]) / c(ALPHA, i);
    for (int k = 0; k < 3; k++) {
      c(VISCOUS + k, i) = sum[k] / this->set.Re;
      c(STAR + k, i) = kept * u[k] + dt / c(ALPHA, i) * (c(VISCOUS + k, i) + c(BY_BUBBLES + k, i)) +
                       dt * this->b.f(i, k) / this->set.volume_of_liquid();
    }
  }
};

// Row i of the pressure: lap p - (Ma/dt)^2 p = (1/dt) div u* - (Ma/dt)^2 p_n, divided by its diagonal.  An image of j has p
// of j and the hydrostatic difference, so that it adds to the entry of j; p = 0 on the surface.
//
// Morris' sums give a linear function a Laplacian where particles are in disorder, so that gravity sets a liquid at rest in
// motion.  Balanced, they are taken of what p has beyond the hydrostatic pressure, p - x . e_g/Fr^2.
//
// lap p has images with p of their particle, so that it is the divergence of a grad p that slips along walls.  div u* is
// taken likewise, also where walls do not slip.  With images that are reversed, a u* along a wall that is not resolved there
// has a divergence where particles are in disorder, which no p removes: corners shoot single particles out.

template <class B, class List, class Matrix> struct Assemble : Loop<B, List> {
  static constexpr const char *NAME = "liquid: assemble";
  Matrix matrix;
  const double *before;    // p_n
  double *right;
  double dt;
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = this->list.row(n);
    const int i = row.i;
    const auto &c = this->c;
    const Kernel W(c(H, i));
    const double star[3] = {c(STAR, i), c(STAR + 1, i), c(STAR + 2, i)};
    const bool surface = c(SURFACE, i) > 0.0;
    const double compressed = this->set.Ma / dt * this->set.Ma / dt;
    double steep[3] = {}, L[6];    // L grad(ln alpha)
    for (int k = 0; k < 6; k++) L[k] = c(CORRECTION + k, i);
    if (this->set.published) {
      const double of_alpha[3] = {c(GRAD_ALPHA, i), c(GRAD_ALPHA + 1, i), c(GRAD_ALPHA + 2, i)};
      multiply(L, of_alpha, steep);
    }
    double difference[3][3] = {}, diagonal = -compressed, heads = 0.0, of_pair = 0.0;
    int count = 0, last = -1;
    auto close = [&]() {
      if (last >= 0 && last != i && !surface) matrix.put(i, count++, of_pair);
    };
    this->neighbors_of(row, [&](int j, const double *r, double distance, const auto &image) {
      const double V = this->volume(j), s = W.slope_over_r(distance);
      const double scale = this->set.published ? c(ALPHA, j) : 1.0;
      double weight = laplacian_weight(s, V);
      if (this->set.published)
        weight += s * V * (steep[0] * r[0] + steep[1] * r[1] + steep[2] * r[2]);
      const auto slipping = image.slipping();
      for (int k = 0; k < 3; k++) {
        const double u = c(STAR + k, j);
        const double d =
            (this->set.sticks ? image.velocity(u, k) : slipping.velocity(u, k)) - star[k];
        for (int a = 0; a < 3; a++) difference[a][k] += V * s * r[a] * d;
        const double from =
            this->set.balanced ? this->b.x(i, k) : image.coordinate(this->b.x(j, k), k);
        heads += weight * scale * this->set.gravity[k] * (from - this->b.x(j, k));
      }
      if (j != last) {
        close();
        last = j;
        of_pair = 0.0;
      }
      if (j == i) return;    // its own image has its own pressure
      of_pair -= weight;
      diagonal += weight;
    });
    close();

    double divergence = 0.0;
    for (int k = 0; k < 3; k++) {
      const double column[3] = {difference[0][k], difference[1][k], difference[2][k]};
      double corrected[3];
      multiply(L, column, corrected);
      divergence += corrected[k];
    }
    c(DIV_STAR, i) = divergence;
    if (this->set.published) divergence *= c(ALPHA, i);
    const bool alone = surface || !(diagonal < 0.0);
    matrix.end(i, alone ? 0 : count, alone ? 1.0 : 1.0 / diagonal);
    right[i] = alone ? 0.0 : (divergence / dt - compressed * before[i] + heads) / diagonal;
  }
};

// Gradient of the pressure, and the end of the step: x = x_n + dt (u_n + u_{n+1}) / 2 + dt u_ps, from x* = x_n + dt u_n

struct SpeedTotals {
  Foam::FoamMax speed, push;    // squared; push: acceleration by gravity and other forces
  Foam::FoamSum kinetic;
  template <class B> FOAM_FUNCTION void add(const B &b, int i, const Setting &set)
  {
    const double mass = set.volume_of_liquid();
    double square = 0.0, pushed = 0.0;
    for (int k = 0; k < 3; k++) {
      const double u = b.v(i, k), a = set.gravity[k] + b.f(i, k) / mass;
      square += u * u;
      pushed += a * a;
    }
    speed.raise(square);
    push.raise(pushed);
    kinetic += 0.5 * mass * square;
  }
  FOAM_FUNCTION void join(const SpeedTotals &other)
  {
    speed.join(other.speed);
    push.join(other.push);
    kinetic.join(other.kinetic);
  }
};

template <class B> struct LookAtSpeeds {
  static constexpr const char *NAME = "liquid: speeds";
  B b;
  Setting set;
  FOAM_FUNCTION void operator()(int i, SpeedTotals &all) const { all.add(b, i, set); }
};

template <class B, class List> struct Project : Loop<B, List> {
  static constexpr const char *NAME = "liquid: gradient of the pressure";
  FOAM_FUNCTION void operator()(int n) const
  {
    const auto row = this->list.row(n);
    const int i = row.i;
    const auto &c = this->c;
    const Kernel W(c(H, i));
    const double p = c(SOLUTION, i);
    double sum[3] = {}, L[6], gradient[3];
    this->neighbors_of(row, [&](int j, const double *r, double distance, const auto &image) {
      const double s = this->volume(j) * W.slope_over_r(distance);
      double difference = c(SOLUTION, j) - p;
      const double scale = this->set.published ? c(ALPHA, j) : 1.0;
      if (image.axes)
        for (int k = 0; k < 3; k++)
          difference += scale * this->set.gravity[k] *
                        (image.coordinate(this->b.x(j, k), k) - this->b.x(j, k));
      for (int k = 0; k < 3; k++) sum[k] += s * r[k] * difference;
    });
    for (int k = 0; k < 6; k++) L[k] = c(CORRECTION + k, i);
    multiply(L, sum, gradient);
    for (int k = 0; k < 3; k++) c(GRAD_P + k, i) = gradient[k];
  }
};

template <class B> struct Move {
  static constexpr const char *NAME = "liquid: move";
  B b;
  Walls walls;
  Columns c;
  Setting set;
  double *pressure, *older, *acceleration[3], *smoothing;    // p, du/dt, h: they travel
  double level, dt;                                          // of p, which is kept without it
  FOAM_FUNCTION void operator()(int i, SpeedTotals &all) const
  {
    for (int k = 0; k < 3; k++) {
      const double before = b.v(i, k), shift = set.shifts ? c(SHIFT + k, i) : 0.0;
      const double gradient = c(GRAD_P + k, i) / (set.published ? c(ALPHA, i) : 1.0);
      double u = c(STAR + k, i) - dt * (gradient - set.gravity[k]);
      double x = b.place(i, k) + 0.5 * dt * (u - before) + shift;
      acceleration[k][i] = (u - before) / dt;
      walls.keep(k, x, u);
      b.put(i, k, x);
      b.v(i, k) = u;
    }
    older[i] = pressure[i];
    pressure[i] = c(SOLUTION, i) - level;
    smoothing[i] = c(H, i);
    all.add(b, i, set);
  }
};

}    // namespace Liquid

#endif
