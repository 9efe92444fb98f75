/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/films/kk,FixBubbleFilmsKokkos<LMPDeviceType>);
FixStyle(bubble/films/kk/device,FixBubbleFilmsKokkos<LMPDeviceType>);
FixStyle(bubble/films/kk/host,FixBubbleFilmsKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_FILMS_KOKKOS_H
#define LMP_FIX_BUBBLE_FILMS_KOKKOS_H

#include "fix_bubble_films.h"
#include "foam_travelling_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixBubbleFilmsKokkos : public FoamTravellingKokkos<FixBubbleFilms, DeviceType> {
 public:
  FixBubbleFilmsKokkos(class LAMMPS *lmp, int narg, char **arg)
      : FoamTravellingKokkos<FixBubbleFilms, DeviceType>(lmp, narg, arg, EMPTY_MASK)
  {
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
