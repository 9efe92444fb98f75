/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_MOVING_BOX_H
#define LMP_FOAM_MOVING_BOX_H

#include "foam_physics.h"

#include "domain.h"

#include <algorithm>

namespace LAMMPS_NS {

// LAMMPS' box at another time: fix deform moves it after a step, an evaluation of forces within the step wants it
// where it is then

struct FoamBoxShape {
  double lo[3], hi[3], yz, xz, xy;

  explicit FoamBoxShape(const Domain *domain) : yz(domain->yz), xz(domain->xz), xy(domain->xy)
  {
    std::copy_n(domain->boxlo, 3, lo);
    std::copy_n(domain->boxhi, 3, hi);
  }
  void move(const Domain *domain, double later)    // at the rates that fix deform has told
  {
    for (int k = 0; k < 3; k++) {
      lo[k] += later * domain->h_ratelo[k];
      hi[k] += later * (domain->h_ratelo[k] + domain->h_rate[k]);
    }
    tilt(domain, later);
  }
  void tilt(const Domain *domain, double later)
  {
    yz += later * domain->h_rate[3];
    xz += later * domain->h_rate[4];
    xy += later * domain->h_rate[5];
  }
  void put(Domain *domain) const
  {
    std::copy_n(lo, 3, domain->boxlo);
    std::copy_n(hi, 3, domain->boxhi);
    domain->yz = yz;
    domain->xz = xz;
    domain->xy = xy;
    domain->set_global_box();
    domain->set_local_box();
  }
};

// for as long as this object lives, the box is that of a later time

class FoamBoxLater {
  Domain *const domain;
  const bool moved;
  const FoamBoxShape now;

 public:
  FoamBoxLater(Domain *domain, double later) : domain(domain), moved(later != 0.0), now(domain)
  {
    if (!moved) return;
    FoamBoxShape then = now;
    then.move(domain, later);
    then.put(domain);
  }
  FoamBoxLater(const FoamBoxLater &) = delete;
  FoamBoxLater &operator=(const FoamBoxLater &) = delete;
  ~FoamBoxLater()
  {
    if (moved) now.put(domain);
  }
};

inline Foam::AffineFlow foam_affine_flow(const Domain *domain)
{
  Foam::AffineFlow flow;
  std::copy_n(domain->boxlo, 3, flow.lo);
  std::copy_n(domain->h_inv, 6, flow.inverse);
  std::copy_n(domain->h_rate, 6, flow.rate);
  std::copy_n(domain->h_ratelo, 3, flow.rate_lo);
  return flow;
}

}    // namespace LAMMPS_NS

#endif
