/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_GAS_H
#define LMP_FOAM_GAS_H

#include "foam_bubbles.h"
#include "foam_wall.h"

// Gas exchange of a bubble, from the sums over its contacts and over all bubbles

namespace Foam {

// Rate of gas content: Vdot_i = K sum_j A_ij (1/R_j - 1/R_i) + c w_i (1/rho - 1/R_i),
// see foam_physics.h

// the free area of a bubble that exchanges gas with the liquid: contacts and walls cover the rest

template <int D, class B>
FOAM_FUNCTION double open_area(const B &b, int i, const double *contact_area, const Walls &walls)
{
  return free_area(surface<D>(b.radius(i)), contact_area[i] + walls.cover<D>(b, i));
}

// The sums over all bubbles that the second part takes

struct FreeSurface {
  static constexpr int SLOT = 0;    // of the sums that stay on a device
  FoamSum bubbles, surface, weight, weight_over_R;

  template <int D, class B>
  FOAM_FUNCTION void add(LiquidLaw law, const B &b, int i, const double *area, const Walls &walls)
  {
    const double R = b.radius(i);
    if (!(R > 0.0)) return;
    const double A = Foam::surface<D>(R),
                 w = liquid_weight(law, open_area<D>(b, i, area, walls), R);
    bubbles += 1.0;
    surface += A;
    weight += w;
    weight_over_R += w / R;
  }
  FOAM_FUNCTION void join(const FreeSurface &other)
  {
    bubbles.join(other.bubbles);
    surface.join(other.surface);
    weight.join(other.weight);
    weight_over_R.join(other.weight_over_R);
  }
  FOAM_FUNCTION double inverse_rho() const
  {
    return inverse_critical_radius(weight, weight_over_R);
  }
};

template <int D> struct Exchange {
  double K = 0.0, kappa = 0.0;
  LiquidLaw law = LiquidLaw::AREA;
  double Rin = 0.0, Ain = 0.0;
  const double *film = nullptr, *area = nullptr;    // sums over contacts, of each bubble; or none
  Walls walls{};                                    // that cover bubbles

  bool through_liquid() const { return K > 0.0 && kappa > 0.0; }

  struct Split {    // the two parts of Vdot
    double film, liquid;
  };
  struct Liquid {    // the state of the whole foam that enters the second
    double coefficient = 0.0, inverse_rho = 0.0;
  };

  FOAM_FUNCTION Liquid of(const FreeSurface &all) const
  {
    return {liquid_coefficient(law, kappa, K, Rin, Ain, all.surface / all.bubbles),
            all.inverse_rho()};
  }
  void use(const Sums<FreeSurface> &all)
  {
    sums = all;
    if (!all.on_device) liquid = of(all.known);
  }

  template <class B> FOAM_FUNCTION Split operator()(const B &b, int i) const
  {
    const double R = b.radius(i);
    const bool lives = K > 0.0 && R > 0.0;
    Split split{K > 0.0 && film ? K * film[i] : 0.0, 0.0};
    const Liquid l = sums.on_device ? of(sums()) : liquid;
    if (l.coefficient > 0.0) {
      const double weight = liquid_weight(law, open_area<D>(b, i, area, walls), R);
      split.liquid = liquid_exchange(l.coefficient, weight, l.inverse_rho, R);
    }
    return {lives ? split.film : 0.0, lives ? split.liquid : 0.0};
  }

  bool is_plain() const    // see foam_vectors.h
  {
    return K > 0.0 && film && liquid.coefficient > 0.0 && law == LiquidLaw::AREA &&
           walls.count == 0 && !sums.on_device;
  }

  Liquid liquid;    // if the sums are known
  Sums<FreeSurface> sums;
};

template <int D, class B> struct AddFreeSurface {
  static constexpr const char *NAME = "foam: sums of free surface";
  B b;
  LiquidLaw law;
  const double *area;
  Walls walls;
  FOAM_FUNCTION void operator()(int i, FreeSurface &all) const
  {
    all.template add<D>(law, b, i, area, walls);
  }
};

}    // namespace Foam

#endif
