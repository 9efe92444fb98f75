/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(durian/foam/kk,PairDurianFoamKokkos<LMPDeviceType>);
PairStyle(durian/foam/kk/device,PairDurianFoamKokkos<LMPDeviceType>);
PairStyle(durian/foam/kk/host,PairDurianFoamKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_PAIR_DURIAN_FOAM_KOKKOS_H
#define LMP_PAIR_DURIAN_FOAM_KOKKOS_H

#include "foam_kokkos.h"
#include "kokkos_base.h"
#include "neigh_list_kokkos.h"
#include "pair_durian_foam.h"

namespace LAMMPS_NS {

// Pairs of bubbles in rows, made of LAMMPS' half list, which knows sizes: its full list does not,
// and would be several times as long.  Bubbles are cut into chunks of consecutive ones, and a
// chunk is the work of one thread.  A pair within a chunk occurs once, and both partners get
// their share; any other occurs in the rows of both partners, and each takes its own.  So nothing
// is atomic, nothing is sent back from ghosts, and the sums of a bubble are always of the same order.
// A chunk of one bubble makes it a full list, a single chunk a half list.

template <class DeviceType> struct FoamRows {
  static constexpr bool CHUNKS = FoamKokkos<DeviceType>::ON_HOST;    // of one bubble elsewhere
  using Numbers = Kokkos::View<int *, DeviceType>;
  Numbers first;     // where a row begins, [nlocal+1]
  Numbers shared;    // how many of its pairs occur once; these come first
  Numbers partner;

  struct Row {
    int i, size, shared;
    const int *partners;
    template <class Visit> KOKKOS_INLINE_FUNCTION void for_each(const Visit &visit) const
    {
      for (int m = 0; m < size; m++) visit(partners[m], CHUNKS && m < shared);
    }
  };
  KOKKOS_INLINE_FUNCTION Row row(int i) const
  {
    return {i, first(i + 1) - first(i), CHUNKS ? shared(i) : 0, partner.data() + first(i)};
  }
};

// Ghosts of a single rank: images of owned bubbles, some boxes away. As a body, counts these.

template <class DeviceType> struct FoamGhosts {
  static constexpr const char *NAME = "foam: boxes of ghosts";
  typename FoamKokkos<DeviceType>::Bubbles b;
  typename ArrayTypes<DeviceType>::t_int_1d owner;
  Kokkos::View<int *[3], Kokkos::LayoutRight, DeviceType> boxes;
  int nlocal;
  double xprd, yprd, zprd, xy, xz, yz;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = nlocal + n, o = owner(i);
    const double dz = b.x(i, 2) - b.x(o, 2);
    const double nz = Kokkos::round(dz / zprd);
    const double dy = b.x(i, 1) - b.x(o, 1) - nz * yz;
    const double ny = Kokkos::round(dy / yprd);
    const double dx = b.x(i, 0) - b.x(o, 0) - nz * xz - ny * xy;
    boxes(n, 0) = static_cast<int>(Kokkos::round(dx / xprd));
    boxes(n, 1) = static_cast<int>(ny);
    boxes(n, 2) = static_cast<int>(nz);
  }
};

template <class DeviceType> class PairDurianFoamKokkos : public PairDurianFoam, public KokkosBase {
 public:
  using device_type = DeviceType;
  using AT = ArrayTypes<DeviceType>;

  PairDurianFoamKokkos(class LAMMPS *);
  ~PairDurianFoamKokkos() override;

  void compute(int, int) override;
  void init_style() override;
  void reinit() override;
  double memory_usage() override;

  // LAMMPS' communication on a device leaves out the radii that atom_style sphere 1 asks for

  bool sends_radii() const override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_forward_comm_kokkos(int, DAT::tdual_int_1d, DAT::tdual_double_1d &, int, int *) override;
  void unpack_forward_comm_kokkos(int, int, DAT::tdual_double_1d &) override;

  // On a single rank each ghost is the image of an owned bubble: one loop brings them up to date,
  // in everything instead of LAMMPS' communication, or in radii beside it.  False if there is none.

  enum class Ghosts { RADII, EVERYTHING };
  bool refresh_ghosts(Ghosts);

  void take_list();    // LAMMPS has built it, and ghosts are where their owners are

  using PairDurianFoam::gather;

 protected:
  void gather_contacts(unsigned) override;

 private:
  FoamKokkos<DeviceType> here;
  FoamRows<DeviceType> rows;
  int chunk = 1;    // bubbles in it

  // the list that the rows were made of, by LAMMPS' counters
  bool rows_known = false;
  bigint rows_ncalls = -1, rows_lastcall = -1;

  DAT::tdual_int_1d k_owner;    // of a ghost, on a single rank
  using Boxes = Kokkos::View<int *[3], Kokkos::LayoutRight, DeviceType>;
  Boxes boxes;    // from owner to ghost
  enum { RADII, OWNERS } sending = RADII;
  bool owners_known = false;    // for the present list
  bool ghosts_fresh = false;    // just refreshed in everything

  bool sigma0_known = false;    // there
  Kokkos::View<double *, DeviceType> sigma0_there;
  DAT::ttransform_kkacc_1d k_eatom;
  DAT::ttransform_kkacc_1d_6 k_vatom;

  void make_rows();
  void make_owners();
  FoamGhosts<DeviceType> ghosts() const;
  template <int D, unsigned WHAT> void gather_in();
};

}    // namespace LAMMPS_NS

#endif
#endif
