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
#include "pair_durian_foam_kokkos.h"

#include "atom_kokkos.h"
#include "comm.h"
#include "force.h"
#include "kokkos_base.h"
#include "modify.h"
#include "pair.h"
#include "timer.h"

namespace LAMMPS_NS {

// Columns that travel with the bubbles: in a buffer, one bubble after the other

template <class DeviceType> struct FoamTravelling {
  struct Column {
    double *first;
    KOKKOS_INLINE_FUNCTION double &operator[](int i) const { return first[i]; }
  };
  int count;
  Kokkos::View<Column *, DeviceType> column;
};

template <class DeviceType> struct FoamPackExchange {
  static constexpr const char *NAME = "foam: pack exchange";
  FoamTravelling<DeviceType> all;
  double *buf;
  typename ArrayTypes<DeviceType>::t_int_1d sendlist, copylist;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = sendlist(n), j = copylist(n);
    for (int c = 0; c < all.count; c++) {
      buf[static_cast<size_t>(n) * all.count + c] = all.column(c)[i];
      if (j >= 0) all.column(c)[i] = all.column(c)[j];    // fills the gap
    }
  }
};

// the second message of two begins at next, with bubble number nfirst

template <class DeviceType> struct FoamUnpackExchange {
  static constexpr const char *NAME = "foam: unpack exchange";
  FoamTravelling<DeviceType> all;
  const double *buf;
  typename ArrayTypes<DeviceType>::t_int_1d indices;
  int nfirst, next;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = indices(n);
    if (i < 0) return;    // not for this rank
    const size_t before = n < nfirst ? n : n - nfirst;
    const double *const from = buf + (n < nfirst ? 0 : next) + before * all.count;
    for (int c = 0; c < all.count; c++) all.column(c)[i] = from[c];
  }
};

template <class DeviceType> struct FoamClearForces {
  static constexpr const char *NAME = "foam: clear forces";
  typename ArrayTypes<DeviceType>::t_kkacc_1d_3 f;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const { f(i, 0) = f(i, 1) = f(i, 2) = 0.0; }
};

// An integrator of a foam on a device: Style, such as FixFoamABM, with its loops there, and its
// columns travelling with the bubbles without a detour to the host.

template <class Style, class DeviceType>
class FixFoamIntegrateKokkos : public Style, public KokkosBase {
 public:
  FixFoamIntegrateKokkos(LAMMPS *lmp, int narg, char **arg)
      : Style(lmp, narg, arg), here(lmp, X_MASK | V_MASK | RADIUS_MASK)
  {
    this->kokkosable = 1;
    this->exchange_comm_device = this->sort_device = std::is_same_v<DeviceType, LMPDeviceType>;
    this->execution_space = FoamKokkos<DeviceType>::SPACE;
    this->datamask_read = this->datamask_modify = EMPTY_MASK;    // the loops see to it
    here.groupbit = this->groupbit;
    here.keep(this->all_columns);
    if (std::is_same_v<KK_FLOAT, float>) {
      this->low.use(lmp->atom->nmax);
      here.low = &this->low;
    }
  }

  void post_constructor() override { foam_strip_suffix(this->style); }

  int pack_exchange_kokkos(const int &nsend, DAT::tdual_double_2d_lr &k_buf,
                           DAT::tdual_int_1d k_sendlist, DAT::tdual_int_1d k_copylist,
                           ExecutionSpace space) override
  {
    return space == Device ? pack_in<LMPDeviceType>(nsend, k_buf, k_sendlist, k_copylist)
                           : pack_in<LMPHostType>(nsend, k_buf, k_sendlist, k_copylist);
  }
  void unpack_exchange_kokkos(DAT::tdual_double_2d_lr &k_buf, DAT::tdual_int_1d &k_indices,
                              int nrecv, int nrecv1, int nextrarecv1, ExecutionSpace space) override
  {
    if (space == Device)
      unpack_in<LMPDeviceType>(k_buf, k_indices, nrecv, nrecv1, nextrarecv1);
    else
      unpack_in<LMPHostType>(k_buf, k_indices, nrecv, nrecv1, nextrarecv1);
  }

  void sort_kokkos(Kokkos::BinSort<KeyViewType, BinOp> &sorter) override
  {
    for (FoamColumns *columns : this->travelling())
      for (int c = 0; c < columns->active(); c++) {
        using Column = Kokkos::View<double *, LMPDeviceType, Kokkos::MemoryUnmanaged>;
        sorter.sort(LMPDeviceType(), Column(columns->on_device(c), columns->rows()));
      }
  }

 protected:
  FoamKokkos<DeviceType> here;

  FoamTotals attempt(double step, bool first) override
  {
    return Foam::with_dimension(
        this->dim, [&]<int D>() { return this->template attempt_in<D>(here, step, first); });
  }
  void keep_history() override { this->keep_history_in(here); }
  void take_rates(bool history) override { this->take_rates_in(here, history); }
  void redistribute(double factor) override { this->redistribute_in(here, factor); }
  void return_to_start() override { this->return_to_start_in(here); }
  void take_listed() override
  {
    this->take_listed_in(here);
    pair_there()->take_list();
  }
  double largest_radius() override { return this->largest_radius_in(here); }
  double count_bubbles() override { return this->count_bubbles_in(here); }

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
    if (!pair_there()->refresh_ghosts(PairThere::Ghosts::EVERYTHING)) this->comm->forward_comm();
    timer->stamp(Timer::COMM);

    if (!pair->fuse_force_clear_flag || modify->n_pre_force) clear_forces();
    if (modify->n_pre_force) modify->pre_force(vflag);
    timer->stamp(Timer::MODIFY);
    this->atomKK->sync(pair->execution_space, pair->datamask_read);
    pair->compute(eflag, vflag);
    this->atomKK->modified(pair->execution_space, pair->datamask_modify);
    timer->stamp(Timer::PAIR);
    if (this->force->newton) {
      Kokkos::fence();
      this->comm->reverse_comm();
      timer->stamp(Timer::COMM);
    }
    if (modify->n_post_force_any) modify->post_force(vflag);
  }

 private:
  using PairThere = PairDurianFoamKokkos<DeviceType>;
  PairThere *pair_there() { return static_cast<PairThere *>(this->pair); }    // see init()

  // LAMMPS has the buffer on the side of its communication, device or host

  template <class Side> FoamTravelling<Side> travelling_in()
  {
    const FoamColumnList list = this->travelling();
    using Columns = decltype(FoamTravelling<Side>::column);
    FoamTravelling<Side> all{0, Columns("foam: travelling columns", capacity(list))};
    const auto column = Kokkos::create_mirror_view(all.column);
    for (FoamColumns *columns : list)
      for (int c = 0; c < columns->active(); c++)
        column(all.count++) = {std::is_same_v<Side, LMPDeviceType> ? columns->on_device(c)
                                                                   : (*columns)[c]};
    Kokkos::deep_copy(all.column, column);
    return all;
  }
  template <class Side>
  int pack_in(int nsend, DAT::tdual_double_2d_lr &k_buf, DAT::tdual_int_1d &k_sendlist,
              DAT::tdual_int_1d &k_copylist)
  {
    k_buf.sync<Side>();
    k_sendlist.sync<Side>();
    k_copylist.sync<Side>();
    const FoamPackExchange<Side> pack{travelling_in<Side>(), k_buf.view<Side>().data(),
                                      k_sendlist.view<Side>(), k_copylist.view<Side>()};
    Kokkos::parallel_for(pack.NAME, Kokkos::RangePolicy<Side>(0, nsend), pack);
    k_buf.modify<Side>();
    return nsend * pack.all.count;
  }
  template <class Side>
  void unpack_in(DAT::tdual_double_2d_lr &k_buf, DAT::tdual_int_1d &k_indices, int nrecv,
                 int nrecv1, int nextrarecv1)
  {
    k_buf.sync<Side>();
    k_indices.sync<Side>();
    const FoamUnpackExchange<Side> unpack{travelling_in<Side>(), k_buf.view<Side>().data(),
                                          k_indices.view<Side>(), nrecv1, nextrarecv1};
    Kokkos::parallel_for(unpack.NAME, Kokkos::RangePolicy<Side>(0, nrecv), unpack);
  }

  void clear_forces()
  {
    this->atomKK->k_f.clear_sync_state();
    here.for_all(this->atom->nlocal + (this->force->newton ? this->atom->nghost : 0),
                 FoamClearForces<DeviceType>{this->atomKK->k_f.template view<DeviceType>()});
    this->atomKK->modified(FoamKokkos<DeviceType>::SPACE, F_MASK);
  }
};

}    // namespace LAMMPS_NS

#endif
