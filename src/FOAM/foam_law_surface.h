/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_LAW_SURFACE_H
#define LMP_FOAM_LAW_SURFACE_H

#include "bubble_physics.h"
#include "foam_law.h"

namespace Foam {

// The elastic force of a bubble in 3D that is deformed by Delta [Heitkam et al., J. Phys.: Condens. Matter 29, 124005
// (2017), eq. 9], with x = Delta / R and the surface tension SIGMA:
//   F = SIGMA R (18.5 x^2 + 2 x),  U = SIGMA R^2 (18.5 x^3 / 3 + x^2)
// Two bubbles are two elements in series, as two of Durian's springs are: the same force deforms both, Delta_i + Delta_j
// = overlap.  A wall (R_j = 0) does not deform.
//
// sigma0 of the pair's types does not enter, but for 0, which switches the pair off.

struct SurfaceLaw : ContactLaw {
  static constexpr const char *NAME = "surface";
  static constexpr std::array<LawParameter, 1> PARAMETERS{{{"SIGMA", 0.0}}};
  static constexpr bool ONLY_3D = true;
  double sigma;
  explicit SurfaceLaw(const double *parameters) : sigma(parameters[0]) {}

  double spring(double sigma0) const { return sigma0 > 0.0 ? sigma : 0.0; }

  FOAM_FUNCTION double force(double stiffness, double overlap, double Ri, double Rj) const
  {
    return stiffness > 0.0 ? sigma * reduced_force(overlap, Ri, Rj) : 0.0;
  }
  FOAM_FUNCTION double energy(double stiffness, double overlap, double Ri, double Rj) const
  {
    if (!(stiffness > 0.0)) return 0.0;
    const double f = reduced_force(overlap, Ri, Rj);
    return sigma * (energy_of_one(f, Ri) + (Rj > 0.0 ? energy_of_one(f, Rj) : 0.0));
  }

 private:
  FOAM_FUNCTION static double reduced_force(double overlap, double Ri, double Rj)
  {
    return Rj > 0.0 ? Bubble::in_series(overlap, Ri, Rj) : Bubble::elastic_force(1.0, overlap, Ri);
  }
  FOAM_FUNCTION static double energy_of_one(double f, double R)
  {
    return Bubble::elastic_energy(1.0, Bubble::deformation(f, R), R);
  }
};

}    // namespace Foam

#endif
