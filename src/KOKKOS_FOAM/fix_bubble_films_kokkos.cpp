/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_bubble_films_kokkos.h"

using namespace LAMMPS_NS;

namespace LAMMPS_NS {
template class FixBubbleFilmsKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixBubbleFilmsKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
