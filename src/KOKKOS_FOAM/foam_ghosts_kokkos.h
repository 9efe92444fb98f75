/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_GHOSTS_KOKKOS_H
#define LMP_FOAM_GHOSTS_KOKKOS_H

#include "foam_kokkos.h"

namespace LAMMPS_NS {

// Ghosts of a single rank: images of owned bubbles, some boxes away. As a functor, counts these.

template <class DeviceType> struct FoamGhosts {
  static constexpr const char *NAME = "foam: boxes of ghosts";
  typename FoamKokkos<DeviceType>::Bubbles b;
  typename ArrayTypes<DeviceType>::t_int_1d owner;
  Kokkos::View<int *[3], Kokkos::LayoutRight, DeviceType> boxes;
  int nlocal;
  double xprd, yprd, zprd, xy, xz, yz;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = nlocal + n, o = owner(i);
    const double dz = b.x(i, 2) - b.x(o, 2);
    const double nz = Kokkos::round(dz / zprd);
    const double dy = b.x(i, 1) - b.x(o, 1) - nz * yz;
    const double ny = Kokkos::round(dy / yprd);
    const double dx = b.x(i, 0) - b.x(o, 0) - nz * xz - ny * xy;
    boxes(n, 0) = static_cast<int>(Kokkos::round(dx / xprd));
    boxes(n, 1) = static_cast<int>(ny);
    boxes(n, 2) = static_cast<int>(nz);
  }
};

template <class DeviceType> struct OwnIndex {
  static constexpr const char *NAME = "foam: owners";
  typename ArrayTypes<DeviceType>::t_int_1d owner;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const { owner(i) = i; }
};

template <class DeviceType, bool EVERYTHING> struct RefreshGhosts {
  static constexpr const char *NAME = EVERYTHING ? "foam: ghosts" : "foam: radii of ghosts";
  FoamGhosts<DeviceType> g;
  bool velocities;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    const int i = g.nlocal + n, o = g.owner(i);
    g.b.radius(i) = g.b.radius(o);
    if constexpr (EVERYTHING) {
      const int nx = g.boxes(n, 0), ny = g.boxes(n, 1), nz = g.boxes(n, 2);
      g.b.x(i, 0) = g.b.x(o, 0) + nx * g.xprd + ny * g.xy + nz * g.xz;
      g.b.x(i, 1) = g.b.x(o, 1) + ny * g.yprd + nz * g.yz;
      g.b.x(i, 2) = g.b.x(o, 2) + nz * g.zprd;
      if (velocities)
        for (int k = 0; k < 3; k++) g.b.v(i, k) = g.b.v(o, k);
    }
  }
};

template <class B> struct ClearGhostForces {
  static constexpr const char *NAME = "foam: clear forces of ghosts";
  B b;
  int nlocal;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    for (int k = 0; k < 3; k++) b.f(nlocal + n, k) = 0.0;
  }
};
template <class B> ClearGhostForces(B, int) -> ClearGhostForces<B>;

template <class DeviceType> struct CopyFromOwners {
  static constexpr const char *NAME = "foam: given velocities of ghosts";
  FoamGhosts<DeviceType> g;
  Foam::Given given;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    for (int k = 0; k < 3; k++) given.v[k][g.nlocal + n] = given.v[k][g.owner(g.nlocal + n)];
  }
};

template <class List> struct PackGiven {
  static constexpr const char *NAME = "foam: pack given velocities";
  Foam::Given given;
  List sent;
  double *buf;
  KOKKOS_INLINE_FUNCTION void operator()(int m) const
  {
    for (int k = 0; k < 3; k++) buf[3 * m + k] = given.v[k][sent(m)];
  }
};
template <class List> PackGiven(Foam::Given, List, double *) -> PackGiven<List>;

struct UnpackGiven {
  static constexpr const char *NAME = "foam: unpack given velocities";
  Foam::Given given;
  const double *buf;
  int first;
  KOKKOS_INLINE_FUNCTION void operator()(int m) const
  {
    for (int k = 0; k < 3; k++) given.v[k][first + m] = buf[3 * m + k];
  }
};

template <class View, class List> struct PackOne {
  static constexpr const char *NAME = "foam: pack";
  View values;
  List sent;
  double *buf;
  KOKKOS_INLINE_FUNCTION void operator()(int m) const { buf[m] = values(sent(m)); }
};
template <class View, class List> PackOne(View, List, double *) -> PackOne<View, List>;

template <class View> struct UnpackOne {
  static constexpr const char *NAME = "foam: unpack";
  View values;
  const double *buf;
  int first;
  KOKKOS_INLINE_FUNCTION void operator()(int m) const { values(first + m) = buf[m]; }
};
template <class View> UnpackOne(View, const double *, int) -> UnpackOne<View>;

}    // namespace LAMMPS_NS

#endif
