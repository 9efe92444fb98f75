/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/flow/kk,FixFoamFlowKokkos<LMPDeviceType>);
FixStyle(foam/flow/kk/device,FixFoamFlowKokkos<LMPDeviceType>);
FixStyle(foam/flow/kk/host,FixFoamFlowKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_FLOW_KOKKOS_H
#define LMP_FIX_FOAM_FLOW_KOKKOS_H

#include "fix_foam_flow.h"
#include "foam_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType> class FixFoamFlowKokkos : public FixFoamFlow {
 public:
  FixFoamFlowKokkos(class LAMMPS *, int, char **);

 protected:
  void host_reads() override;
  Foam::FlowTotals totals_there() override;

 private:
  FoamKokkos<DeviceType> space;
};

}    // namespace LAMMPS_NS

#endif
#endif
