/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/wall/kk,FixFoamWallKokkos<LMPDeviceType>);
FixStyle(foam/wall/kk/device,FixFoamWallKokkos<LMPDeviceType>);
FixStyle(foam/wall/kk/host,FixFoamWallKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_WALL_KOKKOS_H
#define LMP_FIX_FOAM_WALL_KOKKOS_H

#include "fix_foam_wall.h"
#include "foam_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType> class FixFoamWallKokkos : public FixFoamWall {
 public:
  FixFoamWallKokkos(class LAMMPS *, int, char **);

 protected:
  void push() override;
  Foam::WallTotals fetch() override;
  void host_reads() override;

 private:
  FoamKokkos<DeviceType> space;
};

}    // namespace LAMMPS_NS

#endif
#endif
