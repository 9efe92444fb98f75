/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(foam/bubble/kk,ComputeFoamBubbleKokkos<LMPDeviceType>);
ComputeStyle(foam/bubble/kk/device,ComputeFoamBubbleKokkos<LMPDeviceType>);
ComputeStyle(foam/bubble/kk/host,ComputeFoamBubbleKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_COMPUTE_FOAM_BUBBLE_KOKKOS_H
#define LMP_COMPUTE_FOAM_BUBBLE_KOKKOS_H

#include "compute_foam_bubble.h"
#include "foam_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType> class ComputeFoamBubbleKokkos : public ComputeFoamBubble {
 public:
  ComputeFoamBubbleKokkos(class LAMMPS *, int, char **);
  ~ComputeFoamBubbleKokkos() override;
  void compute_peratom() override;

 private:
  FoamKokkos<DeviceType> space;
  DAT::tdual_double_1d k_vector;
  DAT::tdual_double_2d_lr k_array;
};

}    // namespace LAMMPS_NS

#endif
#endif
