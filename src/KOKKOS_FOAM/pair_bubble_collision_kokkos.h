/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(bubble/collision/kk,PairBubbleCollisionKokkos<LMPDeviceType>);
PairStyle(bubble/collision/kk/device,PairBubbleCollisionKokkos<LMPDeviceType>);
PairStyle(bubble/collision/kk/host,PairBubbleCollisionKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_PAIR_BUBBLE_COLLISION_KOKKOS_H
#define LMP_PAIR_BUBBLE_COLLISION_KOKKOS_H

#include "foam_kokkos.h"
#include "foam_rows_kokkos.h"
#include "pair_bubble_collision.h"

namespace LAMMPS_NS {

template <class DeviceType> class PairBubbleCollisionKokkos : public PairBubbleCollision {
 public:
  PairBubbleCollisionKokkos(class LAMMPS *);
  void init_style() override;
  void host_reads() override { atomKK->sync(Host, RADIUS_MASK | TYPE_MASK | TAG_MASK | MASK_MASK); }
  double memory_usage() override;

 protected:
  const char *style_of_films() const override;
  void request_list() override;
  void take_list() override;
  void collide() override { collide_in(space, rows, atom->nlocal); }
  void fill_looks() override { fill_looks_in(space, rows, atom->nlocal); }

 private:
  FoamKokkos<DeviceType> space;
  FoamRows<DeviceType> rows;    // each bubble with all its partners
  Kokkos::View<double *, DeviceType> table_there;
};

}    // namespace LAMMPS_NS

#endif
#endif
