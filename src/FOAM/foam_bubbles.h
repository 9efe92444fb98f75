/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_BUBBLES_H
#define LMP_FOAM_BUBBLES_H

#include "foam_physics.h"
#include "foam_totals.h"
#include "lmptype.h"

// Functors of loops over bubbles are written once for base and KOKKOS styles: each is called for one
// bubble at a time, on the host or on a device.  It holds plain pointers to columns, see foam_columns.h,
// and B, the way in which LAMMPS stores the bubbles themselves: HostBubbles here, FoamKokkosBubbles in
// foam_kokkos.h.  Where functors run, a "space" tells (FoamHost, FoamKokkos): it hands out bubbles and
// columns, loops and sums.  Which particles are bubbles is the space's matter alone.

namespace Foam {

using LAMMPS_NS::FoamLength;
using LAMMPS_NS::FoamMax;
using LAMMPS_NS::FoamSum;

template <class T> struct Rows {    // [n][3]
  T *first;
  FOAM_FUNCTION T &operator()(int i, int k) const { return first[3 * static_cast<size_t>(i) + k]; }
};

template <class T> struct Values {    // [n]
  T *first;
  FOAM_FUNCTION T &operator()(int i) const { return first[i]; }
};

// Who is a bubble: the members of a group of LAMMPS.  Usually all particles are, and then no mask is read.

constexpr int GROUP_ALL = 1;    // the bit of group all

struct Members {
  const int *mask = nullptr;    // none: all particles
  int groupbit = GROUP_ALL;
  FOAM_FUNCTION bool operator()(int i) const { return !mask || (mask[i] & groupbit); }
};

struct HostBubbles {
  Rows<double> x, v, f;
  Values<double> radius;
  Values<int> type;
  Values<LAMMPS_NS::tagint> tag;
  Values<double> mass;    // none, where the atom style has none

  FOAM_FUNCTION double place(int i, int k) const { return x(i, k); }
  FOAM_FUNCTION void put(int i, int k, double value) const { x(i, k) = value; }
};

// May a pair come within reach(R_i + R_j) before the next list, in whose time distances change by up to the skin?
// LAMMPS' lists by the cutoff of types have many pairs that may not.

struct ReachOfContact {    // range (R_i + R_j)
  double range;
  FOAM_FUNCTION double operator()(double sum) const { return range * sum; }
};

template <class B, class Reach> struct ComesNear {
  B b;
  Reach reach;
  double skin;
  FOAM_FUNCTION bool operator()(int i, int j) const
  {
    const double far = reach(b.radius(i) + b.radius(j)) + skin;
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
      const double d = b.x(i, k) - b.x(j, k);
      square += d * d;
    }
    return square < far * far;
  }
};

// What one pass over the contacts gathers

enum Gather : unsigned {
  FORCE = 1,       // spring forces, energy and virial
  CONTACTS = 2,    // number of contacts
  VSUM = 4,        // sum of neighbors' velocities
  FILM = 8,        // sum of film exchange
  AREA = 16,       // sum of contact areas
  ENERGY = 32,     // each bubble's share of the energies
  ANY = 64,        // what a loop is told when it runs
  TALLY = 128,     // energy and virial of each pair
  GIVEN = 256,     // VSUM of what neighbors have been given more than the bubble
  DRAG = CONTACTS | VSUM,
  DIAGNOSTICS = CONTACTS | FILM | AREA | ENERGY
};

struct Given {    // columns of velocities
  double *v[3];
};

// Sums over the contacts of each bubble, as columns.  Contacts are those with other bubbles: a particle
// that is none has no gas to exchange and leads no bubble along, only its force and energy count.

struct ContactSums {
  double *contacts, *vsum[3];
  const double *given[3];       // velocities, for GIVEN; of ghosts, too
  double *area;                 // sum of A_ij
  double *film;                 // sum of A_ij (1/R_j - 1/R_i)
  double *espring, *edurian;    // half of the springs' energies; energy of [L20]
  Members members;              // who is a bubble

  FOAM_FUNCTION void clear(int i, unsigned what) const
  {
    if (what & CONTACTS) contacts[i] = 0.0;
    if (what & VSUM) vsum[0][i] = vsum[1][i] = vsum[2][i] = 0.0;
    if (what & AREA) area[i] = 0.0;
    if (what & FILM) film[i] = 0.0;
    if (what & ENERGY) espring[i] = edurian[i] = 0.0;
  }
};

// Sums over all bubbles of all ranks. On a device they may stay there, so that the host need not wait for
// them: then known is not.

template <class Totals> struct Sums {
  Totals known{};
  const Totals *on_device = nullptr;
  FOAM_FUNCTION const Totals &operator()() const { return on_device ? *on_device : known; }
};

}    // namespace Foam

#endif
