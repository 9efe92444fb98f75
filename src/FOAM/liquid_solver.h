/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_LIQUID_SOLVER_H
#define LMP_LIQUID_SOLVER_H

#include "foam_totals.h"
#include "liquid_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

// Linear systems x_i + sum_j a_ij x_j = b_i, a row for each particle of this rank and columns of its ghosts too, by the
// stabilised biconjugate gradients of van der Vorst, SIAM J. Sci. Stat. Comput. 13, 631 (1992).  Rows are divided by their
// diagonal beforehand, which is Jacobi's preconditioner.

namespace Liquid {

using LAMMPS_NS::FoamSum;

// An entry for each neighbor (liquid_rows.h), in the same places; a row may have none of them

template <bool BY_ROWS> struct Matrix {
  CloseRows<BY_ROWS> close;
  double *value;
  int *size;

  FOAM_FUNCTION void put(int i, int m, double a) const { value[close.at(i, m)] = a; }
  FOAM_FUNCTION void end(int i, int n, double factor) const
  {
    size[i] = n;
    for (int m = 0; m < n; m++) value[close.at(i, m)] *= factor;
  }
  FOAM_FUNCTION double times(int i, const double *x) const
  {
    double sum[4] = {x[i], 0.0, 0.0,
                     0.0};    // so that an addition need not wait for the one before
    const int n = size[i];
    int m = 0;
    auto product = [&](int m) {
      const size_t at = close.at(i, m);
      return value[at] * x[close.partner[at]];
    };
    for (; m + 4 <= n; m += 4)
      for (int k = 0; k < 4; k++) sum[k] += product(m + k);
    for (; m < n; m++) sum[0] += product(m);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
};

struct Vectors {
  double *x, *b, *r, *first, *p, *v, *s,
      *t;    // those that a matrix meets reach over ghosts: x, p, s
};

struct Products {    // sums over all particles
  FoamSum a, b;
  FOAM_FUNCTION void join(const Products &other)
  {
    a.join(other.a);
    b.join(other.b);
  }
};

struct Copy {
  static constexpr const char *NAME = "liquid: copy";
  const double *from;
  double *to;
  FOAM_FUNCTION void operator()(int i) const { to[i] = from[i]; }
};

// Where the search begins: a solution that goes on as between the last two

struct Extrapolate {
  static constexpr const char *NAME = "liquid: extrapolate";
  const double *last, *older;
  double *to;
  double ratio;    // of the times between them
  FOAM_FUNCTION void operator()(int i) const { to[i] = last[i] + ratio * (last[i] - older[i]); }
};

// The mean of a solution

struct SumAndCount {
  static constexpr const char *NAME = "liquid: mean";
  const double *x;
  FOAM_FUNCTION void operator()(int i, Products &all) const
  {
    all.a += x[i];
    all.b += 1.0;
  }
};

template <class M> struct StartResidual {
  static constexpr const char *NAME = "liquid: residual";
  M A;
  Vectors w;
  FOAM_FUNCTION void operator()(int i, Products &all) const
  {
    const double r = w.b[i] - A.times(i, w.x);
    w.r[i] = w.first[i] = w.p[i] = r;
    all.a += r * r;
    all.b += w.b[i] * w.b[i];
  }
};

template <class M> struct ApplyToDirection {
  static constexpr const char *NAME = "liquid: matrix times direction";
  M A;
  Vectors w;
  FOAM_FUNCTION void operator()(int i, Products &all) const
  {
    w.v[i] = A.times(i, w.p);
    all.a += w.first[i] * w.v[i];
  }
};

struct HalfStep {
  static constexpr const char *NAME = "liquid: half step";
  Vectors w;
  double alpha;
  FOAM_FUNCTION void operator()(int i) const { w.s[i] = w.r[i] - alpha * w.v[i]; }
};

template <class M> struct ApplyToResidual {
  static constexpr const char *NAME = "liquid: matrix times residual";
  M A;
  Vectors w;
  FOAM_FUNCTION void operator()(int i, Products &all) const
  {
    w.t[i] = A.times(i, w.s);
    all.a += w.t[i] * w.s[i];
    all.b += w.t[i] * w.t[i];
  }
};

struct FullStep {
  static constexpr const char *NAME = "liquid: full step";
  Vectors w;
  double alpha, omega;
  FOAM_FUNCTION void operator()(int i, Products &all) const
  {
    w.x[i] += alpha * w.p[i] + omega * w.s[i];
    const double r = w.r[i] = w.s[i] - omega * w.t[i];
    all.a += r * r;
    all.b += w.first[i] * r;
  }
};

struct NextSearch {
  static constexpr const char *NAME = "liquid: next direction";
  Vectors w;
  double beta, omega;
  FOAM_FUNCTION void operator()(int i) const { w.p[i] = w.r[i] + beta * (w.p[i] - omega * w.v[i]); }
};

struct Solved {
  enum End { CONVERGED, SLOW, BROKEN } end = CONVERGED;
  int iterations = 0;
  double residual = 0.0;    // |r| / |b|
};

// x from where it is, to |r| <= tolerance |b|.  means.ghosts(vector) brings ghosts up to date; means.all(functor), means.each(functor)
// run over the particles, the first with sums over all ranks.  Where a direction breaks down the search starts again from
// the residual.

template <class Ghosts, class All, class Each> struct Means {
  Ghosts ghosts;
  All all;
  Each each;
};
template <class Ghosts, class All, class Each>    // for C++17
Means(Ghosts, All, Each)->Means<Ghosts, All, Each>;

template <class M, class Means>
Solved solve(const M &A, const Vectors &w, double tolerance, int most, const Means &means)
{
  Solved state;
  means.ghosts(w.x);
  Products now = means.all(StartResidual<M>{A, w});
  const double size = now.b;
  double rho = now.a;
  auto residual = [&](double square) {
    return size > 0.0 ? std::sqrt(square / size) : std::sqrt(square);
  };
  state.residual = residual(now.a);
  int restarts = 0;
  while (!(state.residual <= tolerance)) {
    if (!std::isfinite(state.residual) || restarts > 3) {
      state.end = Solved::BROKEN;
      return state;
    }
    if (state.iterations >= most) {
      state.end = Solved::SLOW;
      return state;
    }
    state.iterations++;
    means.ghosts(w.p);
    const double along = means.all(ApplyToDirection<M>{A, w}).a;
    const double alpha = rho / along;
    means.each(HalfStep{w, alpha});
    means.ghosts(w.s);
    const Products t = means.all(ApplyToResidual<M>{A, w});
    const double omega = t.b > 0.0 ? t.a / t.b : 0.0;
    now = means.all(FullStep{w, alpha, omega});
    state.residual = residual(now.a);
    const double beta = now.b / rho * alpha / omega;
    rho = now.b;
    if (std::isfinite(beta) && std::fabs(rho) > 1.0e-30 * now.a) {
      means.each(NextSearch{w, beta, omega});
    } else {
      restarts++;
      means.ghosts(w.x);
      now = means.all(StartResidual<M>{A, w});
      rho = now.a;
      state.residual = residual(now.a);
    }
  }
  return state;
}

}    // namespace Liquid

#endif
