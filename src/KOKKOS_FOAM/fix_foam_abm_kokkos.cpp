/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_abm_kokkos.h"

namespace LAMMPS_NS {
template class FixFoamABMKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixFoamABMKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
