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
#include "neigh_list_kokkos.h"
#include "pair_durian_foam.h"

namespace LAMMPS_NS {

// Pairs of bubbles in rows, made of LAMMPS' half list, which knows sizes: its full list does not,
// and would be several times as long.  Bubbles are cut into chunks of consecutive ones, and a
// chunk is the work of one thread.  A pair within a chunk occurs once, and both partners get
// their share; any other occurs in the rows of both partners, and each takes its own.  So nothing
// is atomic, nothing is sent back from ghosts, and the order of summation is always the same.
// A chunk of one bubble makes it a full list, a single chunk a half list.

template <class DeviceType> struct FoamRows {
  using Numbers = Kokkos::View<int *, DeviceType>;
  Numbers first;     // where a row begins, [nlocal+1]
  Numbers shared;    // how many of its pairs occur once; these come first
  Numbers partner;

  struct Row {
    int i, size, shared;
    const int *partners;
    KOKKOS_INLINE_FUNCTION int operator[](int m) const { return partners[m]; }
    KOKKOS_INLINE_FUNCTION bool both(int m, int) const { return m < shared; }
  };
  KOKKOS_INLINE_FUNCTION Row row(int i) const
  {
    return {i, first(i + 1) - first(i), shared(i), partner.data() + first(i)};
  }
};

template <class DeviceType> class PairDurianFoamKokkos : public PairDurianFoam {
 public:
  using device_type = DeviceType;
  using AT = ArrayTypes<DeviceType>;

  PairDurianFoamKokkos(class LAMMPS *);
  ~PairDurianFoamKokkos() override;

  void compute(int, int) override;
  void init_style() override;
  double memory_usage() override;

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

  Kokkos::View<double *, DeviceType> sigma0_there;
  DAT::ttransform_kkacc_1d k_eatom;
  DAT::ttransform_kkacc_1d_6 k_vatom;

  void look_at_list();
  void make_rows();
  template <int D, unsigned WHAT> void gather_in();
};

}    // namespace LAMMPS_NS

#endif
#endif
