/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_FOAM_INTEGRATE_KOKKOS_H
#define LMP_FIX_FOAM_INTEGRATE_KOKKOS_H

#include "foam_kokkos.h"
#include "foam_travelling_kokkos.h"

#include "atom_kokkos.h"
#include "comm.h"
#include "force.h"
#include "modify.h"
#include "pair.h"
#include "timer.h"

namespace LAMMPS_NS {

template <class DeviceType> struct FoamClearForces {
  static constexpr const char *NAME = "foam: clear forces";
  typename ArrayTypes<DeviceType>::t_kkacc_1d_3 f;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const { f(i, 0) = f(i, 1) = f(i, 2) = 0.0; }
};

// An integrator of a foam on a device: Style, such as FixFoamABM, with its loops there

template <class Style, class DeviceType>
class FixFoamIntegrateKokkos : public FoamTravellingKokkos<Style, DeviceType> {
 public:
  FixFoamIntegrateKokkos(LAMMPS *lmp, int narg, char **arg)
      : FoamTravellingKokkos<Style, DeviceType>(lmp, narg, arg, X_MASK | V_MASK | RADIUS_MASK)
  {
    space.groupbit = this->groupbit;
    if (std::is_same_v<KK_FLOAT, float>) {
      this->residuals.use(lmp->atom->nmax);
      space.residuals = &this->residuals;
    }
  }

 protected:
  using FoamTravellingKokkos<Style, DeviceType>::space;

  Foam::Judgement candidate(double step, bool first) override
  {
    return Foam::with_dimension(
        this->dim, [&]<int D>() { return this->template candidate_in<D>(space, step, first); });
  }
  void keep_history() override { this->keep_history_in(space); }
  void take_rates(bool history) override { this->take_rates_in(space, history); }
  void redistribute(double factor) override { this->redistribute_in(space, factor); }
  void return_to_start() override { this->return_to_start_in(space); }
  void take_listed() override
  {
    this->take_listed_in(space);
    this->pair->take_list();
  }
  void add_to_path() override { this->add_to_path_in(space); }
  double largest_radius() override { return this->largest_radius_in(space); }
  void solve_drag() override { this->solve_drag_in(space); }
  double count_bubbles() override { return this->count_bubbles_in(space); }
  void shift_by_images(double sign) override { this->shift_by_images_in(space, sign); }

  void host_reads() override { this->atomKK->sync(Host, ALL_MASK); }
  void host_wrote() override
  {
    this->atomKK->modified(Host, X_MASK | V_MASK | F_MASK | RADIUS_MASK);
  }

  // as VerletKokkos::run() does it in turn

  void compute_forces(int eflag, int vflag) override
  {
    Timer *const timer = this->timer;
    Modify *const modify = this->modify;
    Pair *const pair = this->force->pair;
    timer->stamp(Timer::MODIFY);
    if (!this->pair->refresh_ghosts(PairFoam::Ghosts::EVERYTHING)) this->comm->forward_comm();
    timer->stamp(Timer::COMM);

    // the pair style alone writes forces of owned bubbles over, and leaves those of ghosts 0

    const bool writes_over = pair->fuse_force_clear_flag && !modify->n_pre_force;
    if (!writes_over) clear_forces();
    if (modify->n_pre_force) modify->pre_force(vflag);
    timer->stamp(Timer::MODIFY);
    this->atomKK->sync(pair->execution_space, pair->datamask_read);
    pair->compute(eflag, vflag);
    this->atomKK->modified(pair->execution_space, pair->datamask_modify);
    timer->stamp(Timer::PAIR);
    if (this->force->newton && !writes_over) {
      Kokkos::fence();
      this->comm->reverse_comm();
      timer->stamp(Timer::COMM);
    }
    if (modify->n_post_force_any) modify->post_force(vflag);
  }

 private:
  void clear_forces()
  {
    this->atomKK->k_f.clear_sync_state();
    space.for_all(this->atom->nlocal + (this->force->newton ? this->atom->nghost : 0),
                  FoamClearForces<DeviceType>{this->atomKK->k_f.template view<DeviceType>()});
    this->atomKK->modified(FoamKokkos<DeviceType>::SPACE, F_MASK);
  }
};

}    // namespace LAMMPS_NS

#endif
