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

#include "foam_found_kokkos.h"
#include "foam_ghosts_kokkos.h"
#include "foam_kokkos.h"
#include "foam_rows_kokkos.h"
#include "kokkos_base.h"
#include "neigh_list_kokkos.h"
#include "pair_durian_foam.h"

namespace LAMMPS_NS {

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
  Foam::Coefficients coefficients() const override
  {
    return {sigma0_there.data(), atom->ntypes, hub.record.rin};
  }

  // LAMMPS' communication on a device leaves out the radii that atom_style sphere 1 asks for

  bool sends_radii() const override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_forward_comm_kokkos(int, DAT::tdual_int_1d, DAT::tdual_double_1d &, int, int *) override;
  void unpack_forward_comm_kokkos(int, int, DAT::tdual_double_1d &) override;

  // On a single rank each ghost is the image of an owned bubble: one loop brings them up to date,
  // in everything instead of LAMMPS' communication, or in radii beside it.  False if there is none.

  bool refresh_ghosts(Ghosts) override;

  // of the list taken last; a chunk of rows is the work of one thread

  const FoamRows<DeviceType> &contact_rows() const { return rows; }
  int rows_at_once() const { return chunk; }

  void take_list() override;

 protected:
  bool can_make_lists() const override;
  void gather(unsigned what) override;
  void send_given() override;

 private:
  FoamKokkos<DeviceType> space;
  FoamFound found;    // what rows are made of on the host
  FoamRows<DeviceType> rows;
  int chunk = 1;    // bubbles in it

  // the list that the rows were made of, by LAMMPS' counters
  bool rows_known = false;
  bigint rows_ncalls = -1, rows_lastcall = -1;

  DAT::tdual_int_1d k_owner;    // of a ghost, on a single rank
  using Boxes = Kokkos::View<int *[3], Kokkos::LayoutRight, DeviceType>;
  Boxes boxes;    // from owner to ghost
  enum { RADII, OWNERS, GIVEN } sending = RADII;
  bool owners_known = false;    // for the present list
  bool ghosts_fresh = false;    // just refreshed in everything

  double bin_width = 0.0;    // chosen here; 0: LAMMPS' own or users'

  bool sigma0_known = false;    // there
  Kokkos::View<double *, DeviceType> sigma0_there;
  DAT::ttransform_kkacc_1d k_eatom;
  DAT::ttransform_kkacc_1d_6 k_vatom;

  void choose_bins();
  bool has_own_bins() const;
  void make_rows();
  void tell_sizes();
  void make_owners();
  FoamGhosts<DeviceType> ghosts() const;
  Foam::Given given_there();
  template <int D, unsigned WHAT, class Law> void gather_in(const Law &, unsigned what);
};

}    // namespace LAMMPS_NS

#endif
#endif
