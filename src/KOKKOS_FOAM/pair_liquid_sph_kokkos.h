/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(liquid/sph/kk,PairLiquidSPHKokkos<LMPDeviceType>);
PairStyle(liquid/sph/kk/device,PairLiquidSPHKokkos<LMPDeviceType>);
PairStyle(liquid/sph/kk/host,PairLiquidSPHKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_PAIR_LIQUID_SPH_KOKKOS_H
#define LMP_PAIR_LIQUID_SPH_KOKKOS_H

#include "foam_kokkos.h"
#include "pair_liquid_sph.h"

namespace LAMMPS_NS {

// Rows of LAMMPS' full list, of the particles of a group with those of another.  Unlike the rows of FoamRows, which are
// short, they are not made of a half list: to sort what threads have put together would cost more than such a list saves.

template <class DeviceType> struct LiquidRows {
  using Numbers = Kokkos::View<int *, DeviceType>;
  int count = 0;
  Numbers of;       // whose row it is
  Numbers first;    // where it begins, [count+1]
  Numbers partner;

  struct Row {
    int i, size;
    const int *partners;
    template <class Visit> FOAM_ALWAYS_INLINE void for_each(const Visit &visit) const
    {
      for (int m = 0; m < size; m++) visit(partners[m], std::true_type());
    }
  };
  KOKKOS_INLINE_FUNCTION Row row(int n) const
  {
    return {of(n), first(n + 1) - first(n), partner.data() + first(n)};
  }
};

template <class DeviceType> class PairLiquidSPHKokkos : public PairLiquidSPH {
 public:
  PairLiquidSPHKokkos(class LAMMPS *);
  void init_style() override;
  double memory_usage() override;

  const LiquidRows<DeviceType> &rows(Kind kind) const { return lists[kind]; }
  int nrows(Kind kind) const { return lists[kind].count; }

 protected:
  void request_list() override;
  void take_lists() override;

 private:
  FoamKokkos<DeviceType> space;
  LiquidRows<DeviceType> lists[KINDS];

  void make(LiquidRows<DeviceType> &, int of, int with);
};

}    // namespace LAMMPS_NS

#endif
#endif
