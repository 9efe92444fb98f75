/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_CONTACT_DRAG_H
#define LMP_FOAM_CONTACT_DRAG_H

#include "foam_drag.h"

#include <algorithm>

// Velocities where bubbles in contact drag each other: linear systems A w = b of all bubbles, solved by conjugate gradients
// with the diagonal as preconditioner.  A is symmetric, the same for each component; a product A p is a pass over the
// contacts.  Two laws of drag:
//
// Contact [Tighe et al., Phys. Rev. Lett. 105, 088303 (2010)]:
//   mu0 (v_i - u_i) + mu_c sum_j (v_i - v_j) = F_i,  j in contact with i.
// For w = v - u, which has no jump where a sheared box is periodic,
//   mu0 w_i + mu_c sum_j (w_i - w_j) = F_i - mu_c sum_j (u_i - u_j).
// A is positive for mu0 > 0 and has no eigenvalue below mu0, so |error| <= |r| / mu0 of residuals r = b - A w.  It is solved
// from the last solution on.
//
// Mean of neighbors [L20 (2.15), all velocities of the same time]: v_i - sum_j v_j / z_i = F_i / mu0 with z_i contacts, or
//   mu0 sum_j (v_i - v_j) = z_i mu0 (g_i - c),  g = F / mu0.
// A is the Laplacian of the graph of contacts, and leaves a velocity common to a cluster open: so there is a solution only
// for c = sum z_i g_i / sum z_i of each cluster, and that with sum z_i v_i = 0 is taken.  Who belongs to a cluster need not be
// known: preconditioned by z_i, the iteration for A e = A g from e = 0 on stays where the sums with the weights z_i are 0, and so
// ends at e = g - c; that for A v = z_i mu0 e at v.  A bubble without contacts has v = g.  Velocities of bubbles in a flow that
// is imposed, v = g + u, are known, and hold the clusters that touch them: there c = 0.  Residuals are taken to bound the error
// by the least eigenvalue, other than 0, of the preconditioned matrix: about that of a lattice of bubbles for the longest wave in
// the box, (2 pi a / L)^2 / (2 D) with a distance a between neighbors, of which a quarter is taken, since disorder makes it
// smaller.  An error of e acts like one of a force.

namespace Foam {

struct DragTotals {    // of one iteration; r in units of velocity
  FoamSum product, squares, forces, numbers;
  FOAM_FUNCTION void join(const DragTotals &other)
  {
    product.join(other.product);
    squares.join(other.squares);
    forces.join(other.forces);
    numbers.join(other.numbers);
  }
};

// The columns of a system.  vsum are the sums of p_j - p_i over contacts, of what was given last: where images have
// another velocity, differences are the same from both sides.

template <int D, class B> struct DragSystem {
  Drag<D, B> drag;
  double mu_c;     // mu0 for the mean of neighbors
  double least;    // eigenvalue for the mean of neighbors, or 0: contact
  const double *contacts, *vsum[3];
  double *w[3], *r[3], *p[3];

  FOAM_FUNCTION bool mean() const { return least > 0.0; }
  FOAM_FUNCTION bool alive(int i) const { return drag.b.radius(i) > 0.0; }
  FOAM_FUNCTION bool open(int i) const { return alive(i) && !(mean() && drag.ambient.imposed(i)); }
  FOAM_FUNCTION double own(int i) const { return mean() && contacts[i] > 0.0 ? 0.0 : drag.mu0; }
  FOAM_FUNCTION double diagonal(int i) const { return own(i) + mu_c * contacts[i]; }
  FOAM_FUNCTION double apply(int i, int k) const    // A p
  {
    return contact_drag_force(own(i), mu_c, p[k][i], vsum[k][i]);
  }
  FOAM_FUNCTION double without_neighbors(int i, int k) const    // g
  {
    return drag_velocity(drag.b.f(i, k), drag.mu0, 0.0);
  }
  FOAM_FUNCTION void add(int i, int k, DragTotals &all) const
  {
    const double residual = as_velocity(i, r[k][i]);
    all.squares += residual * residual;
    all.product += r[k][i] * r[k][i] / diagonal(i);
  }
  FOAM_FUNCTION double as_velocity(int i, double r) const    // the error, at most
  {
    return r / (mean() ? diagonal(i) * least : drag.mu0);
  }
};

// contact: p = u, of which the sums are asked for

template <int D, class B> struct GiveAmbient {
  static constexpr const char *NAME = "foam: drag, ambient velocities";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < D; k++) s.p[k][i] = s.alive(i) ? s.drag.ambient(i, k) : 0.0;
  }
};

// contact: r = b, and p = w

template <int D, class B> struct TakeForces {
  static constexpr const char *NAME = "foam: drag, forces";
  DragSystem<D, B> s;
  bool flows;    // p is u
  FOAM_FUNCTION void operator()(int i) const
  {
    const bool alive = s.alive(i);
    for (int k = 0; k < D; k++) {
      s.r[k][i] = alive ? s.drag.b.f(i, k) : 0.0;
      if (alive && flows) s.r[k][i] += s.mu_c * s.vsum[k][i];
      if (!alive) s.w[k][i] = 0.0;
      s.p[k][i] = s.w[k][i];
    }
  }
};

// mean: w = e = 0, and r - A p = A g

template <int D, class B> struct GiveForces {
  static constexpr const char *NAME = "foam: drag, velocities without neighbors";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < D; k++) {
      s.w[k][i] = s.r[k][i] = 0.0;
      s.p[k][i] = s.open(i) ? -s.without_neighbors(i, k) : 0.0;
    }
  }
};

// mean: r = b of the e that was found, and p the velocities that are known

template <int D, class B> struct GiveKnown {
  static constexpr const char *NAME = "foam: drag, known velocities";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    const bool alive = s.alive(i), open = s.open(i);
    for (int k = 0; k < D; k++) {
      s.r[k][i] = open ? s.diagonal(i) * s.w[k][i] : 0.0;
      s.w[k][i] = alive && !open ? s.without_neighbors(i, k) : 0.0;    // v - u
      s.p[k][i] = alive && !open ? s.w[k][i] + s.drag.ambient(i, k) : 0.0;
    }
  }
};

// r = b - A p, and the first direction

template <int D, class B> struct StartSolution {
  static constexpr const char *NAME = "foam: drag, start";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i, DragTotals &all) const
  {
    const bool open = s.open(i);
    for (int k = 0; k < D; k++) {
      if (open) {
        const double before = s.as_velocity(i, s.r[k][i]);
        all.forces += before * before;
        all.numbers += 1.0;
        s.r[k][i] -= s.apply(i, k);
        s.add(i, k, all);
      }
      s.p[k][i] = open ? s.r[k][i] / s.diagonal(i) : 0.0;
    }
  }
};

template <int D, class B> struct AlongDirection {    // p A p
  static constexpr const char *NAME = "foam: drag, along the direction";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i, DragTotals &all) const
  {
    for (int k = 0; k < D; k++) all.product += s.p[k][i] * s.apply(i, k);
  }
};

template <int D, class B> struct AdvanceSolution {
  static constexpr const char *NAME = "foam: drag, advance";
  DragSystem<D, B> s;
  double alpha;
  FOAM_FUNCTION void operator()(int i, DragTotals &all) const
  {
    if (!s.open(i)) return;
    for (int k = 0; k < D; k++) {
      s.w[k][i] += alpha * s.p[k][i];
      s.r[k][i] -= alpha * s.apply(i, k);
      s.add(i, k, all);
    }
  }
};

template <int D, class B> struct NextDirection {
  static constexpr const char *NAME = "foam: drag, next direction";
  DragSystem<D, B> s;
  double beta;
  FOAM_FUNCTION void operator()(int i) const
  {
    if (!s.open(i)) return;
    for (int k = 0; k < D; k++) s.p[k][i] = s.r[k][i] / s.diagonal(i) + beta * s.p[k][i];
  }
};

// What a solution needs: gather() brings the sums over contacts of what is in p, gather_ambient() the same with u of images
// where they are, all(functor) the totals over all ranks.

template <class Gather, class Ambient, class All> struct DragMeans {
  Gather gather;
  Ambient gather_ambient;
  All all;
};
template <class Gather, class Ambient, class All>    // for C++17
DragMeans(Gather, Ambient, All)->DragMeans<Gather, Ambient, All>;

// w from r and p as they were given, with a root mean square error (over components) of at most so much.  False if it is
// not found; what is no number the judgement of the step finds.

template <int D, class B, class Space, class Means>
bool conjugate_gradients(const DragSystem<D, B> &s, Space &space, int n, double error,
                         const Means &means)
{
  const double ROUNDING = s.mean() ? 1.0e-13 : 1.0e-14;    // weighted sums leave 0, too
  constexpr int MOST = 10000;
  means.gather();
  DragTotals now = means.all(StartSolution<D, B>{s});
  const double enough =
      std::max(error * error * now.numbers,
               ROUNDING * ROUNDING * (now.forces + (s.mean() ? now.squares : 0.0)));
  for (int products = 1; now.squares > enough && products < MOST; products++) {
    means.gather();
    const double alpha = now.product / means.all(AlongDirection<D, B>{s}).product;
    const double before = now.product;
    now = means.all(AdvanceSolution<D, B>{s, alpha});
    space.for_each(n, NextDirection<D, B>{s, now.product / before});
  }
  return !(now.squares > enough);
}

template <int D, class B, class Space, class Means>
bool solve_contact_drag(const DragSystem<D, B> &s, Space &space, int n, double error, bool flows,
                        const Means &means)
{
  if (s.mean()) {
    space.for_each(n, GiveForces<D, B>{s});
    if (!conjugate_gradients(s, space, n, error * s.least, means)) return false;
    space.for_each(n, GiveKnown<D, B>{s});
  } else {
    if (flows) {
      space.for_each(n, GiveAmbient<D, B>{s});
      means.gather_ambient();
    }
    space.for_each(n, TakeForces<D, B>{s, flows});
  }
  return conjugate_gradients(s, space, n, error, means);
}

}    // namespace Foam

#endif
