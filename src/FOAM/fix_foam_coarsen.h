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
#include "foam_input.h"
#include "foam_gas.h"
#include "pair_foam.h"

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
  int modify_param(int, char **) override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  bool ready() const { return pair; }    // since its first run
  void tell(FoamHub &) const;            // what to gather
  bool changed = false;                  // by fix_modify, so that known rates are outdated

  // the law for the sums over contacts that the pair style gathered last; on all ranks, as
  // exchange through the liquid takes sums over all bubbles

  template <int D, class Space> Foam::Exchange<D> exchange(Space &space, int nlocal) const
  {
    Foam::Exchange<D> gas;
    gas.K = K;
    gas.kappa = kappa;
    gas.law = law;
    gas.Rin = pair->hub.record.rin;
    gas.Ain = mean_surface();
    if (through_films) gas.film = space.column(pair->film, 0);
    gas.area = space.column(pair->area, 0);
    if (gas.through_liquid()) gas.walls = pair->hub.walls_that(FoamHub::COVER, space);
    using AddFreeSurface = Foam::AddFreeSurface<D, typename Space::Bubbles>;
    if (gas.through_liquid())
      gas.use(pair->hub.free_surface_known && space.reads(pair->hub.free_surface)
                  ? pair->hub.free_surface
                  : space.template sums<Foam::FreeSurface>(
                        nlocal, AddFreeSurface{space.bubbles(), law, gas.area, gas.walls}));
    return gas;
  }
  template <int D> void note(const Foam::Exchange<D> &gas)    // the integrator, for its rates
  {
    rho_on_device = gas.sums.on_device;
    rho = gas.liquid.inverse_rho > 0.0 ? 1.0 / gas.liquid.inverse_rho : 0.0;
  }
  virtual double critical_radius() { return rho; }    // of those rates; 0 without liquid exchange
  void keep_critical_radius(double value)
  {
    rho_on_device = nullptr;
    rho = value;
  }

  double smallest_radius() const;    // below it a bubble is removed
  void accepted(double h, double removed, double gas_removed);
  std::string end_reached() const;    // why the run is over, or empty

  double K, kappa;
  bool through_films = true;
  bool has_dead() const { return dead; }

 protected:
  PairFoam *pair;
  Foam::LiquidLaw law;
  double rmin;         // in units of <R_in>
  double ain_given;    // <A_in> if the user gave it, else 0
  bigint nmin;
  double rho;
  const Foam::FreeSurface *rho_on_device = nullptr;    // see Foam::Sums
  bool dead;    // there are removed bubbles, on any rank, that are not yet taken out

  bool find_pair();
  FoamInput::Keywords keywords();    // of fix and fix_modify alike
  double mean_surface() const
  {
    return ain_given > 0.0 ? ain_given : pair->hub.record.ain;
  }    // <A_in>
  virtual void take_out_dead();
  void count_particles();
};

}    // namespace LAMMPS_NS

#endif
#endif
