/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_rkc_kokkos.h"

namespace LAMMPS_NS {
template class FixFoamRKCKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixFoamRKCKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
