/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/contacts/kk,FixFoamContactsKokkos<LMPDeviceType>);
FixStyle(foam/contacts/kk/device,FixFoamContactsKokkos<LMPDeviceType>);
FixStyle(foam/contacts/kk/host,FixFoamContactsKokkos<LMPHostType>);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_CONTACTS_KOKKOS_H
#define LMP_FIX_FOAM_CONTACTS_KOKKOS_H

#include "fix_foam_contacts.h"
#include "foam_travelling_kokkos.h"

namespace LAMMPS_NS {

template <class DeviceType>
class FixFoamContactsKokkos : public FoamTravellingKokkos<FixFoamContacts, DeviceType> {
 public:
  FixFoamContactsKokkos(class LAMMPS *lmp, int narg, char **arg)
      : FoamTravellingKokkos<FixFoamContacts, DeviceType>(lmp, narg, arg, EMPTY_MASK)
  {
  }

 protected:
  Foam::ContactTotals follow(double) override;
  void show_there() override;
  void host_reads() override;
};

}    // namespace LAMMPS_NS

#endif
#endif
