// Gas exchange through films and through the liquid, and what a removal gives to the survivors.

#include "foam_physics.h"
#include "samples.h"

#include <gtest/gtest.h>

using namespace Foam;

// ---------------------------------------------------------------------- films

TEST(Film, ClosedForm)
{
  Samples samples(1);
  for (int n = 0; n < 1000; n++) {
    const double Ri = samples.decades(1.0e-3, 1.0e3), Rj = samples.decades(1.0e-3, 1.0e3);
    const double A = samples.decades(1.0e-3, 1.0e3);
    const long double exact = A * (1.0L / Rj - 1.0L / Ri);
    // a difference of doubles is rounded once, then three more operations
    EXPECT_NEAR(film_exchange(A, Ri, Rj), exact, 4.0 * EPS * std::fabs(exact));
  }
}

TEST(Film, AntisymmetricToTheLastBit)
{
  Samples samples(2);
  for (int n = 0; n < 10000; n++) {
    const double Ri = samples.decades(1.0e-3, 1.0e3), Rj = samples.decades(1.0e-3, 1.0e3);
    const double r = samples.uniform(0.0, Ri + Rj);
    EXPECT_EQ(film_exchange(contact_area<2>(r, Ri, Rj), Ri, Rj),
              -film_exchange(contact_area<2>(r, Rj, Ri), Rj, Ri));
    EXPECT_EQ(film_exchange(contact_area<3>(r, Ri, Rj), Ri, Rj),
              -film_exchange(contact_area<3>(r, Rj, Ri), Rj, Ri));
  }
}

TEST(Film, LargeBubblesGrow)
{
  EXPECT_GT(film_exchange(1.0, 1.1, 1.0), 0.0);
  EXPECT_LT(film_exchange(1.0, 1.0, 1.1), 0.0);
  EXPECT_EQ(film_exchange(1.0, 1.3, 1.3), 0.0);
  EXPECT_DOUBLE_EQ(film_exchange(1.0, 1.0e6, 1.0), 0.999999);
}

// ---------------------------------------------------------------------- liquid

namespace {

struct Population {
  std::vector<double> R, free;
};

// radii over `ratio`, contacts of up to twice the surface, so that many free areas are clamped

template <int D> Population random_population(int n, double ratio, unsigned seed)
{
  Samples samples(seed);
  Population p;
  for (int i = 0; i < n; i++) {
    p.R.push_back(samples.decades(1.0, ratio));
    const double A = surface<D>(p.R[i]);
    p.free.push_back(free_area(A, samples.uniform(0.0, 2.0) * A));
  }
  return p;
}

struct Exchange {
  double rho_inverse, sum, rounding;
  std::vector<double> Vdot;
};

// The rounding of 1/rho, a sum of n terms, is the same for all: at most n EPS / rho times the sum
// of the weights. The same again for the sum of the rates itself.

Exchange exchange(LiquidLaw law, const Population &p, double coefficient)
{
  double w_sum = 0.0, w_over_R_sum = 0.0;
  for (size_t i = 0; i < p.R.size(); i++) {
    const double w = liquid_weight(law, p.free[i], p.R[i]);
    w_sum += w;
    w_over_R_sum += w / p.R[i];
  }
  Exchange e{inverse_critical_radius(w_sum, w_over_R_sum), 0.0, 0.0, {}};
  for (size_t i = 0; i < p.R.size(); i++) {
    const double w = liquid_weight(law, p.free[i], p.R[i]);
    e.Vdot.push_back(liquid_exchange(coefficient, w, e.rho_inverse, p.R[i]));
    e.sum += e.Vdot[i];
    e.rounding += p.R.size() * EPS * coefficient * w * (e.rho_inverse + 1.0 / p.R[i]);
  }
  return e;
}

}    // namespace

TEST(Liquid, FreeAreaIsClampedAtZero)
{
  EXPECT_EQ(free_area(3.0, 1.0), 2.0);
  EXPECT_EQ(free_area(3.0, 3.0), 0.0);
  EXPECT_EQ(free_area(3.0, 4.0), 0.0);
  // continuous there
  EXPECT_NEAR(free_area(3.0, 3.0 - 1.0e-12), 0.0, 1.1e-12);
}

TEST(Liquid, CoefficientsOfTheLaws)
{
  // kappa 0.1, K 0.01, <R_in> 2, <A_in> 12, <A> 16
  EXPECT_DOUBLE_EQ(liquid_coefficient(LiquidLaw::AREA, 0.1, 0.01, 2.0, 12.0, 16.0), 0.00075);
  EXPECT_DOUBLE_EQ(liquid_coefficient(LiquidLaw::LSW, 0.1, 0.01, 2.0, 12.0, 16.0), 0.002);
}

TEST(Liquid, ConservesGas)
{
  for (const LiquidLaw law : {LiquidLaw::AREA, LiquidLaw::LSW})
    for (const double ratio : {1.5, 10.0, 1.0e6})
      for (unsigned seed = 0; seed < 20; seed++) {
        const Exchange flat = exchange(law, random_population<2>(300, ratio, seed), 0.7);
        EXPECT_LE(std::fabs(flat.sum), flat.rounding);
        const Exchange full = exchange(law, random_population<3>(300, ratio, seed), 0.7);
        EXPECT_LE(std::fabs(full.sum), full.rounding);
      }
}

TEST(Liquid, BubblesAboveRhoGrow)
{
  const Population p = random_population<3>(300, 10.0, 5);
  for (const LiquidLaw law : {LiquidLaw::AREA, LiquidLaw::LSW}) {
    const Exchange e = exchange(law, p, 1.0);
    for (size_t i = 0; i < p.R.size(); i++) {
      if (p.free[i] == 0.0)
        EXPECT_EQ(e.Vdot[i], 0.0);    // squeezed by others: takes no part
      else
        EXPECT_EQ(e.Vdot[i] > 0.0, p.R[i] * e.rho_inverse > 1.0);
    }
  }
}

TEST(Liquid, NoFreeSurfaceNoExchange)
{
  Population p = random_population<2>(50, 10.0, 6);
  for (double &free : p.free) free = 0.0;
  for (const LiquidLaw law : {LiquidLaw::AREA, LiquidLaw::LSW}) {
    const Exchange e = exchange(law, p, 1.0);
    EXPECT_EQ(e.rho_inverse, 0.0);
    for (const double Vdot : e.Vdot) EXPECT_EQ(Vdot, 0.0);
  }
}

TEST(Liquid, OneBubbleOrEqualBubblesKeepTheirGas)
{
  for (const LiquidLaw law : {LiquidLaw::AREA, LiquidLaw::LSW})
    for (const size_t n : {1, 7}) {
      const Population p{std::vector<double>(n, 1.3), std::vector<double>(n, 2.0)};
      const Exchange e = exchange(law, p, 1.0);
      EXPECT_NEAR(e.rho_inverse, 1.0 / 1.3, n * EPS);
      for (const double Vdot : e.Vdot) EXPECT_NEAR(Vdot, 0.0, 2.0 * n * EPS);
    }
}

TEST(Liquid, RhoOfFreeBubbles)
{
  // radii 1, 2, 3 without contacts
  Population flat{{1.0, 2.0, 3.0}, {}}, full = flat;
  for (const double R : flat.R) {
    flat.free.push_back(surface<2>(R));
    full.free.push_back(surface<3>(R));
  }
  // sum Af / sum (Af / R): <R> in 2D, <R^2>/<R> in 3D
  EXPECT_DOUBLE_EQ(exchange(LiquidLaw::AREA, flat, 1.0).rho_inverse, 1.0 / 2.0);
  EXPECT_DOUBLE_EQ(exchange(LiquidLaw::AREA, full, 1.0).rho_inverse, 6.0 / 14.0);
  // sum (Af / R) / sum (Af / R^2): 1/<1/R> in 2D, <R> in 3D
  EXPECT_DOUBLE_EQ(exchange(LiquidLaw::LSW, flat, 1.0).rho_inverse, 11.0 / 18.0);
  EXPECT_DOUBLE_EQ(exchange(LiquidLaw::LSW, full, 1.0).rho_inverse, 1.0 / 2.0);
}

TEST(Liquid, FreeBubblesIn3DObeyLifshitzSlyozovWagner)
{
  // dR/dt = kappa K <R_in> / R (1/<R> - 1/R)
  Samples samples(7);
  Population p;
  double mean = 0.0;
  for (int i = 0; i < 100; i++) {
    p.R.push_back(samples.uniform(0.5, 1.5));
    p.free.push_back(surface<3>(p.R[i]));
    mean += p.R[i] / 100.0;
  }
  const double kappa = 0.1, K = 0.01, Rin = 1.2;
  const double c = liquid_coefficient(LiquidLaw::LSW, kappa, K, Rin, 1.0, 1.0);
  const Exchange e = exchange(LiquidLaw::LSW, p, c);
  for (int i = 0; i < 100; i++)
    EXPECT_NEAR(radius_rate<3>(e.Vdot[i], p.R[i]),
                kappa * K * Rin / p.R[i] * (1.0 / mean - 1.0 / p.R[i]),
                c * 400.0 * EPS);    // sums of 100 terms
}

// ---------------------------------------------------------------------- removal

template <int D> static void removal_conserves_gas()
{
  Samples samples(8);
  for (int trial = 0; trial < 20; trial++) {
    const int n = 200;
    double before = 0.0, excess = 0.0, survivors = 0.0, after = 0.0;
    std::vector<double> R;
    for (int i = 0; i < n; i++) {
      R.push_back(samples.decades(0.05, 5.0));
      const double V = CONTENT<D> * power_of_radius<D>(R[i]);
      before += V;
      (R[i] < 0.1 ? excess : survivors) += V;
    }
    const double factor = redistribution_factor(excess, survivors);
    const double scale = D == 2 ? std::sqrt(factor) : std::cbrt(factor);
    for (const double Ri : R)
      if (Ri >= 0.1) after += CONTENT<D> * power_of_radius<D>(scale * Ri);
    EXPECT_NEAR(after, before, n * EPS * before);    // rounding of sums of n terms
  }
}

TEST(Removal, ConservesGas)
{
  removal_conserves_gas<2>();
  removal_conserves_gas<3>();
}

TEST(Removal, NothingRemovedChangesNothing)
{
  EXPECT_EQ(redistribution_factor(0.0, 12.3), 1.0);
}

TEST(Removal, ShareIsInProportionToContent)
{
  // a tenth of the survivors' gas comes in: each of them grows by a tenth, whatever its size
  EXPECT_DOUBLE_EQ(redistribution_factor(0.5, 5.0), 1.1);
}

// ---------------------------------------------------------------------- whole foam

TEST(Foam, FractionAndScaledTime)
{
  EXPECT_DOUBLE_EQ(gas_fraction(90.0, 100.0), 0.9);
  EXPECT_DOUBLE_EQ(scaled_time(1.0e-3, 4000.0, 2.0), 1.0);
}
