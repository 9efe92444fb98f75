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
  double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {1.0, 1.0, 1.0}, yz = 0.0, xz = 0.0, xy = 0.0;

  FoamBoxShape() = default;
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

inline Foam::AffineMap foam_affine_map(const FoamBoxShape &from, const FoamBoxShape &to)
{
  Foam::AffineMap map;
  double a[3], b[3], inverse[3];    // sides
  for (int k = 0; k < 3; k++) {
    map.from[k] = from.lo[k];
    map.to[k] = to.lo[k];
    a[k] = from.hi[k] - from.lo[k];
    b[k] = to.hi[k] - to.lo[k];
    map.m[k] = b[k] / a[k];
  }
  inverse[0] = -from.yz / (a[1] * a[2]);    // yz, xz, xy of the inverse
  inverse[1] = (from.xy * from.yz - from.xz * a[1]) / (a[0] * a[1] * a[2]);
  inverse[2] = -from.xy / (a[0] * a[1]);
  map.m[3] = b[1] * inverse[0] + to.yz / a[2];
  map.m[4] = b[0] * inverse[1] + to.xy * inverse[0] + to.xz / a[2];
  map.m[5] = b[0] * inverse[2] + to.xy / a[1];
  return map;
}

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
