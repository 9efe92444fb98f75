/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(liquid/flow/kk,FixLiquidFlowKokkos<LMPDeviceType>);
FixStyle(liquid/flow/kk/device,FixLiquidFlowKokkos<LMPDeviceType>);
FixStyle(liquid/flow/kk/host,FixLiquidFlowKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_LIQUID_FLOW_KOKKOS_H
#define LMP_FIX_LIQUID_FLOW_KOKKOS_H

#include "fix_liquid_flow.h"
#include "foam_travelling_kokkos.h"
#include "pair_liquid_sph_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixLiquidFlowKokkos : public FoamTravellingKokkos<FixLiquidFlow, DeviceType> {
 public:
  FixLiquidFlowKokkos(class LAMMPS *, int, char **);
  void post_constructor() override;
  double memory_usage() override;
  int pack_forward_comm_kokkos(int, DAT::tdual_int_1d, DAT::tdual_double_1d &, int, int *) override;
  void unpack_forward_comm_kokkos(int, int, DAT::tdual_double_1d &) override;

 protected:
  using FoamTravellingKokkos<FixLiquidFlow, DeviceType>::space;
  void look() override;
  void keep_pressure() override;
  void advance(double dt) override;
  void order() override;
  void gather(double dt) override;
  void project(double dt) override;
  void move(double dt) override;
  void send(FoamColumns &, int first, int count) override;

 private:
  struct RoomThere {
    template <class T> using Numbers = Kokkos::View<T *, DeviceType>;
    Numbers<double> entries;
    static constexpr bool BY_ROWS = FoamKokkos<DeviceType>::ON_HOST;
    Numbers<int> partners, sizes, used;
    Liquid::CloseRows<BY_ROWS> close(size_t rows, size_t width);
    Liquid::Matrix<BY_ROWS> matrix(const Liquid::CloseRows<BY_ROWS> &);
  } room_there;

  // On a single rank each ghost is the image of an owned particle: one loop brings columns to all of them

  Kokkos::View<int *, DeviceType> owner;    // of a ghost
  bool owners_known = false;

  const PairLiquidSPHKokkos<DeviceType> &near() const;
  void make_owners();
};

}    // namespace LAMMPS_NS

#endif
#endif
