/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/coarsen,FixFoamCoarsen);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_COARSEN_H
#define LMP_FIX_FOAM_COARSEN_H

#include "fix.h"
#include "foam_physics.h"
#include "foam_reduce.h"

#include <string>

namespace LAMMPS_NS {

// Gas exchange: its laws, the removal of small bubbles and the end of a coarsening run.
// An integrator (FixFoamIntegrate) owns the state and calls this for rates.

class FixFoamCoarsen : public Fix {
 public:
  FixFoamCoarsen(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  void post_run() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  // sums over the living bubbles of an accepted state, the same on all ranks
  struct Population {
    double bubbles = 0.0, radius_sum = 0.0, gas = 0.0, radius_max = 0.0;
  };
  Population population;

  struct Liquid {    // the state of the whole foam that enters the exchange through the liquid
    double coefficient = 0.0, inverse_rho = 0.0;
  };
  struct Split {    // the two parts of Vdot of one bubble
    double film, liquid;
  };

  unsigned wanted() const;    // what the pair style has to gather for it

  // all of these use the sums over contacts that the pair style gathered last

  virtual Liquid liquid() const;    // over all ranks
  Split exchange(int i, const Liquid &) const;
  virtual void rates(double *qdot, bool of_radius);    // of q = R^d, or of R, for each owned bubble

  double smallest_radius() const;    // below it a bubble is removed
  void accepted(double h, double removed, double gas_removed);
  std::string end_reached() const;    // why the run is over, or empty

  double K, kappa;
  double rho;    // of the rates evaluated last; 0 without exchange through the liquid
  bool has_dead() const { return dead; }

 protected:
  class PairDurianFoam *pair;
  FoamReduce reduce;
  Foam::LiquidLaw law;
  double rmin;         // in units of <R_in>
  double ain_given;    // <A_in> if the user gave it, else 0
  bigint nmin;
  double time;    // spent coarsening
  double removed_bubbles, removed_gas;
  bool dead;    // there are removed bubbles, on any rank, that are not yet taken out

  virtual void take_out_dead();
  template <int D> double weight(int i) const;
  template <int D> Liquid liquid_in() const;
  template <int D> Split exchange_in(int i, const Liquid &) const;
  template <int D> void rates_in(double *qdot, bool of_radius);
};

}    // namespace LAMMPS_NS

#endif
#endif
