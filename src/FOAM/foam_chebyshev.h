/* ----------------------------------------------------------------------
   The numbers of the stabilised Runge-Kutta-Chebyshev method, apart from any
   state: second order, as many stages as the step needs to be stable
   (B. P. Sommeijer, L. F. Shampine, J. G. Verwer, RKC: An explicit solver for
   parabolic PDEs, J. Comput. Appl. Math. 88, 315 (1998), eqs. 2.1 to 2.6).

   A step of length h with s stages, Y_0 = y_n, F_j = f(Y_j), y_{n+1} = Y_s:

     Y_1 = Y_0 + m_1 h F_0
     Y_j = Y_0 + mu_j (Y_{j-1} - Y_0) + nu_j (Y_{j-2} - Y_0)
               + h (m_j F_{j-1} + g_j F_0)                      j = 2 ... s

   with Chebyshev polynomials T_j and their derivatives at w0:

     w0 = 1 + epsilon / s^2,  w1 = T'_s / T''_s
     b_j = T''_j / (T'_j)^2,  b_0 = b_1 = b_2,  a_j = 1 - b_j T_j
     m_1 = b_1 w1
     mu_j = 2 b_j w0 / b_{j-1},  nu_j = -b_j / b_{j-2}
     m_j = 2 b_j w1 / b_{j-1},   g_j = -a_{j-1} m_j

   The paper has epsilon = 2/13, which leaves 0.95 of a fast mode after a step.  With 1 that is 0.75 to 0.78, for
   steps shorter by 9 %: in foams, where contacts that open and close excite fast modes, errors of a step are then
   smaller by more than that.

   Y_j belongs to the time t_n + c_j h, c_j = w1 T''_j / T'_j, and is of second
   order there (j > 1).
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_CHEBYSHEV_H
#define LMP_FOAM_CHEBYSHEV_H

#include "foam_physics.h"

#include <cmath>
#include <vector>

namespace Foam {

class Chebyshev {
 public:
  // what Y_j takes of Y_{j-1} - Y_0, Y_{j-2} - Y_0, h F_{j-1}, h F_0, and c_j; the first stage
  // has m_1 in rate_start

  struct Stage {
    double last, before, rate, rate_start, place;
  };

  static constexpr int FEWEST = 3;    // so that Y_{s-1} is of second order, see stage_error()
  static constexpr int MOST = 200;

  explicit Chebyshev(int count) : stages(count + 1), w0(1.0 + EPSILON / (double(count) * count))
  {
    std::vector<Polynomial> T(count + 1);
    T[0] = {1.0, 0.0, 0.0};
    T[1] = {w0, 1.0, 0.0};
    for (int j = 2; j <= count; j++) T[j] = after(T[j - 1], T[j - 2]);
    const double w1 = T[count].first / T[count].second;
    auto b = [&](int j) {
      const Polynomial &t = T[j < 2 ? 2 : j];
      return t.second / (t.first * t.first);
    };
    stages[1] = {0.0, 0.0, 0.0, b(1) * w1, b(1) * w1};
    for (int j = 2; j <= count; j++) {
      const double m = 2.0 * b(j) * w1 / b(j - 1);
      const double a = 1.0 - b(j - 1) * T[j - 1].value;
      stages[j] = {2.0 * b(j) * w0 / b(j - 1), -b(j) / b(j - 2), m, -a * m,
                   w1 * T[j].second / T[j].first};
    }
  }

  int count() const { return static_cast<int>(stages.size()) - 1; }
  const Stage &operator[](int j) const { return stages[j]; }    // 1 ... count

  // Stable are steps of h times the spectral radius of the Jacobian, if its eigenvalues are real
  // and negative, up to 2/3 (s^2 - 1) (1 - 2 epsilon / 15), [SSV98] eq. 2.7; that is of first order in epsilon, and
  // 2.5 % too little with 1

  static double stable(int count)
  {
    return 2.0 / 3.0 * (1.0 - 2.0 / 15.0 * EPSILON) * (double(count) * count - 1.0);
  }
  static int count_for(double h_times_radius)
  {
    int s = FEWEST;
    while (s < MOST && stable(s) < h_times_radius) s++;
    return s;
  }

 private:
  static constexpr double EPSILON = 1.0;
  struct Polynomial {
    double value, first, second;    // T_j, T'_j, T''_j at w0
  };
  std::vector<Stage> stages;
  double w0;

  // T_j = 2 w T_{j-1} - T_{j-2} and its derivatives

  Polynomial after(const Polynomial &t, const Polynomial &before) const
  {
    return {2.0 * w0 * t.value - before.value, 2.0 * t.value + 2.0 * w0 * t.first - before.first,
            4.0 * t.first + 2.0 * w0 * t.second - before.second};
  }
};

FOAM_FUNCTION double advance(double start, double last, double before, double rate,
                             double rate_start, double h, const Chebyshev::Stage &c)
{
  return start + (c.last * (last - start) + c.before * (before - start) +
                  h * (c.rate * rate + c.rate_start * rate_start));
}

// The error of a step, without the rates at its end: that of the step to Y_{s-1}, by [SSV98]
// eq. 2.10,
//
//     0.8 (Y_0 - Y_{s-1}) + 0.4 c h (F_0 + F_{s-1})      c = c_{s-1}
//
// which is of third order in c h, over c^3

FOAM_FUNCTION double stage_error(double start, double last, double rate, double rate_start,
                                 double h, double c)
{
  return (0.8 * (start - last) + 0.4 * c * h * (rate + rate_start)) / (c * c * c);
}

}    // namespace Foam

#endif
