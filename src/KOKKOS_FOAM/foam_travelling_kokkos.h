/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_TRAVELLING_KOKKOS_H
#define LMP_FOAM_TRAVELLING_KOKKOS_H

#include "foam_kokkos.h"

#include "kokkos.h"
#include "kokkos_base.h"

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

// Atoms are born, taken out and put in order on the host.  Arrays that grow meanwhile bring its numbers along if they are known
// to be the last ones.

template <class Work> void foam_on_host(LAMMPS *lmp, const Work &work)
{
  auto *const atoms = static_cast<AtomKokkos *>(lmp->atom);
  int &auto_sync = lmp->kokkos->auto_sync;
  const int before = auto_sync;
  auto_sync = 1;
  atoms->sync(Host, ALL_MASK);
  atoms->modified(Host, ALL_MASK);
  work();
  atoms->modified(Host, ALL_MASK);
  auto_sync = before;
}

// A fix on a device: Style, with its columns there, which travel with the bubbles without a detour to the host.
// Changes: see FoamKokkos.

template <class Style, class DeviceType>
class FoamTravellingKokkos : public Style, public KokkosBase {
 public:
  FoamTravellingKokkos(LAMMPS *lmp, int narg, char **arg, uint64_t changes)
      : Style(lmp, narg, arg), space(lmp, changes)
  {
    this->kokkosable = 1;
    this->exchange_comm_device = this->sort_device = std::is_same_v<DeviceType, LMPDeviceType>;
    this->execution_space = FoamKokkos<DeviceType>::SPACE;
    this->datamask_read = this->datamask_modify = EMPTY_MASK;    // the loops see to it
    space.keep(this->all_columns);
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
  FoamKokkos<DeviceType> space;

 private:
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
};

}    // namespace LAMMPS_NS

#endif
