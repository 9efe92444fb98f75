/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "fix_foam_contacts_kokkos.h"

#include "pair_durian_foam_kokkos.h"

using namespace LAMMPS_NS;

template <class DeviceType>
Foam::ContactTotals FixFoamContactsKokkos<DeviceType>::follow(double later)
{
  const auto &rows = *static_cast<PairDurianFoamKokkos<DeviceType> *>(this->pair);    // see init()
  return this->follow_in(this->space, rows.contact_rows(), this->atom->nlocal, rows.rows_at_once(),
                         later);
}

template <class DeviceType> void FixFoamContactsKokkos<DeviceType>::show_there()
{
  this->show_in(this->space);
}

template <class DeviceType> void FixFoamContactsKokkos<DeviceType>::host_reads()
{
  this->atomKK->sync(Host, TAG_MASK);
}

namespace LAMMPS_NS {
template class FixFoamContactsKokkos<LMPDeviceType>;
#ifdef LMP_KOKKOS_GPU
template class FixFoamContactsKokkos<LMPHostType>;
#endif
}    // namespace LAMMPS_NS
