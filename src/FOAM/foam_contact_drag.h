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

// Drag between bubbles in contact [Tighe et al., Phys. Rev. Lett. 105, 088303 (2010)]:
//   mu0 (v_i - u_i) + mu_c sum_j (v_i - v_j) = F_i,  j in contact with i.
// For w = v - u, which has no jump where a sheared box is periodic, this is a linear system A w = b of all bubbles,
//   mu0 w_i + mu_c sum_j (w_i - w_j) = F_i - mu_c sum_j (u_i - u_j),
// A symmetric and, for mu0 > 0, positive: the same for each component.  Conjugate gradients solve it, preconditioned by the
// diagonal, from the last solution on.  A product A p is a pass over the contacts.  Residuals r = b - A w bound the
// error of w: A has no eigenvalue below mu0, so |error| <= |r| / mu0.

namespace Foam {

struct DragTotals {    // of one iteration; r in units of velocity, r / mu0
  FoamSum product, squares, forces, numbers;
  FOAM_FUNCTION void join(const DragTotals &other)
  {
    product.join(other.product);
    squares.join(other.squares);
    forces.join(other.forces);
    numbers.join(other.numbers);
  }
};

// The columns of the system.  vsum are the sums of p_j - p_i over contacts, of what was given last: where images have
// another velocity, differences are the same from both sides.

template <int D, class B> struct DragSystem {
  Drag<D, B> drag;
  double mu_c;
  const double *contacts, *vsum[3];
  double *w[3], *r[3], *p[3];

  FOAM_FUNCTION bool alive(int i) const { return drag.b.radius(i) > 0.0; }
  FOAM_FUNCTION double diagonal(int i) const { return drag.mu0 + mu_c * contacts[i]; }
  FOAM_FUNCTION double apply(int i, int k) const    // A p
  {
    return contact_drag_force(drag.mu0, mu_c, p[k][i], vsum[k][i]);
  }
  FOAM_FUNCTION void add(int i, int k, DragTotals &all) const
  {
    const double residual = r[k][i] / drag.mu0;
    all.squares += residual * residual;
    all.product += r[k][i] * r[k][i] / diagonal(i);
  }
};

// p = u, of which the sums are asked for

template <int D, class B> struct GiveAmbient {
  static constexpr const char *NAME = "foam: drag, ambient velocities";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i) const
  {
    for (int k = 0; k < D; k++) s.p[k][i] = s.alive(i) ? s.drag.ambient(i, k) : 0.0;
  }
};

// r = b, and p = w

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

// r = b - A w, and the first direction

template <int D, class B> struct StartSolution {
  static constexpr const char *NAME = "foam: drag, start";
  DragSystem<D, B> s;
  FOAM_FUNCTION void operator()(int i, DragTotals &all) const
  {
    if (!s.alive(i)) return;
    for (int k = 0; k < D; k++) {
      const double without = s.r[k][i] / s.drag.mu0;
      all.forces += without * without;
      all.numbers += 1.0;
      s.r[k][i] -= s.apply(i, k);
      s.p[k][i] = s.r[k][i] / s.diagonal(i);
      s.add(i, k, all);
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
    if (!s.alive(i)) return;
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
    if (!s.alive(i)) return;
    for (int k = 0; k < D; k++) s.p[k][i] = s.r[k][i] / s.diagonal(i) + beta * s.p[k][i];
  }
};

// w with a root mean square error (over components) of at most so much.  gather() brings the sums over contacts of
// what is in p, gather_ambient(), if the liquid flows, the same with u of images where they are; all(functor) the totals over
// all ranks.  False if it is not found; what is no number the judgement of the step finds.

template <int D, class B, class Space, class Gather, class Ambient, class All>
bool solve_contact_drag(const DragSystem<D, B> &s, Space &space, int n, double error,
                        const Gather &gather, bool flows, const Ambient &gather_ambient,
                        const All &all)
{
  constexpr double ROUNDING = 1.0e-14;
  constexpr int MOST = 10000;
  if (flows) {
    space.for_each(n, GiveAmbient<D, B>{s});
    gather_ambient();
  }
  space.for_each(n, TakeForces<D, B>{s, flows});
  gather();
  DragTotals now = all(StartSolution<D, B>{s});
  const double enough = std::max(error * error * now.numbers, ROUNDING * ROUNDING * now.forces);
  for (int products = 1; now.squares > enough && products < MOST; products++) {
    gather();
    const double alpha = now.product / all(AlongDirection<D, B>{s}).product;
    const double before = now.product;
    now = all(AdvanceSolution<D, B>{s, alpha});
    space.for_each(n, NextDirection<D, B>{s, now.product / before});
  }
  return !(now.squares > enough);
}

}    // namespace Foam

#endif
