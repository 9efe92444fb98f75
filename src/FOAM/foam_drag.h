/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_DRAG_H
#define LMP_FOAM_DRAG_H

#include "foam_bubbles.h"
#include "foam_wall.h"

// Forces become velocities: the balance of force and drag, mu0 (v_i - u_i) = F_i, with u_i the ambient velocity,
// that of the liquid around bubble i

namespace Foam {

// Who tells the ambient velocity: a flow of the liquid, where there is one; else nobody (a liquid at rest), or the
// neighbors, by the mean of the velocities of the bubbles in contact.

struct AmbientVelocity {
  const double *contacts = nullptr, *vsum[3] = {};    // sums over contacts, or none
  const double *flow[3] = {};    // columns for this rank's bubbles, NaN: none is imposed there

  FOAM_FUNCTION bool imposed(int i) const { return flow[0] && flow[0][i] == flow[0][i]; }
  FOAM_FUNCTION double operator()(int i, int k) const
  {
    if (imposed(i)) return flow[k][i];
    return contacts ? mean_of_neighbors(vsum[k][i], contacts[i]) : 0.0;
  }
};

struct DriftTotals {    // of all velocities, relative to a flow that is imposed
  static constexpr int SLOT = 1;
  FoamSum velocity[3], bubbles;
  FOAM_FUNCTION void join(const DriftTotals &other)
  {
    for (int k = 0; k < 3; k++) velocity[k].join(other.velocity[k]);
    bubbles.join(other.bubbles);
  }
};

template <int D, class B> struct Drag {
  B b;
  double mu0;
  AmbientVelocity ambient{};
  Sums<DriftTotals> drift{};    // nothing unless it is taken off
  bool drift_removed = false;
  const double *solved[3] =
      {};           // v - u, if bubbles in contact drag each other: foam_contact_drag.h
  Walls walls{};    // that hold bubbles

  FOAM_FUNCTION double velocity(int i, int k) const
  {
    const double u = ambient(i, k);
    double v = solved[0] ? solved[k][i] + u : drag_velocity(b.f(i, k), mu0, u);
    if (drift_removed && drift().bubbles > 0.0) v -= drift().velocity[k] / drift().bubbles;
    v = walls.hold(b, i, k, v);
    return b.radius(i) > 0.0 ? v : 0.0;
  }

  bool is_plain() const    // see foam_vectors.h
  {
    return !ambient.flow[0] && !ambient.contacts && !solved[0] && !drift_removed &&
           walls.count == 0;
  }
};

template <int D, class B> struct AddDrift {
  static constexpr const char *NAME = "foam: drift";
  Drag<D, B> drag;
  FOAM_FUNCTION void operator()(int i, DriftTotals &all) const
  {
    if (!(drag.b.radius(i) > 0.0)) return;
    const bool flows = drag.ambient.imposed(i);
    for (int k = 0; k < D; k++)
      all.velocity[k] += drag.velocity(i, k) - (flows ? drag.ambient(i, k) : 0.0);
    all.bubbles += 1.0;
  }
};

// The velocities l that neighbor drag takes as given, see lagged_velocity().  The pair style finds them, also
// those of ghosts, in LAMMPS' v: there they are during a step, and v_n waits in columns of its own.

struct VelocityLag {
  double *v_start[3] = {};    // v_n; null: there is no lag
  double *lag[3] = {};        // l of the evaluation that gave v_n

  FOAM_FUNCTION bool exists() const { return v_start[0]; }

  template <class B> FOAM_FUNCTION double v(const B &b, int i, int k) const    // v_n
  {
    return exists() ? v_start[k][i] : b.v(i, k);
  }
  template <class B> FOAM_FUNCTION void put_v(const B &b, int i, int k, double v) const
  {
    if (exists())
      v_start[k][i] = v;
    else
      b.v(i, k) = v;
  }

  // the start of a step; of another attempt; the step is given up

  template <class B> FOAM_FUNCTION void begin(const B &b, int i, int k) const
  {
    if (!exists()) return;
    v_start[k][i] = b.v(i, k);
    rewind(b, i, k);
  }
  template <class B> FOAM_FUNCTION void rewind(const B &b, int i, int k) const
  {
    if (exists()) b.v(i, k) = lagged_velocity(v_start[k][i], lag[k][i]);
  }
  template <class B> FOAM_FUNCTION void give_up(const B &b, int i, int k) const
  {
    if (exists()) b.v(i, k) = v_start[k][i];
  }

  // from stage to stage l follows the velocities; that with which a new state was evaluated is kept

  template <class B> FOAM_FUNCTION void follow(const B &b, int i, int k, double v) const
  {
    if (exists()) b.v(i, k) = lagged_velocity(v, b.v(i, k));
  }
  template <class B> FOAM_FUNCTION void keep(const B &b, int i, int k) const
  {
    if (exists()) lag[k][i] = b.v(i, k);
  }
};

}    // namespace Foam

#endif
