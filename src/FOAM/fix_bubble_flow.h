/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/flow,FixBubbleFlow);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_FLOW_H
#define LMP_FIX_BUBBLE_FLOW_H

#include "fix_foam_travelling.h"
#include "liquid_bubbles.h"

#include "atom.h"
#include "comm.h"

namespace LAMMPS_NS {

// Bubbles smaller than the spacing of a resolved liquid, which carries them and is pushed by them (liquid_bubbles.h).
// Fix liquid/flow, which makes the steps, calls.

class FixBubbleFlow : public FixFoamTravelling {
 public:
  FixBubbleFlow(class LAMMPS *, int, char **);
  static FixBubbleFlow *of(class LAMMPS *);    // the one there is, or none
  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  double compute_vector(int) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;

  FoamColumns work{all_columns, "columns of bubbles in a liquid", Liquid::AT_BUBBLES, STAYS};
  Liquid::BubbleSetting set;

  // from particles to bubbles: what is there, forces; with dt > 0 new velocities.  Then ghosts have the reaction.

  template <class Space, class List>
  void exchange_in(Space &space, const Liquid::Loop<typename Space::Bubbles, List> &liquid,
                   const List &around, int nrows, double *const *acceleration, double dt);
  template <class Space> Liquid::BubbleColumns columns_in(Space &space)
  {
    Liquid::BubbleColumns all;
    for (int k = 0; k < Liquid::AT_BUBBLES; k++) all.at[k] = space.column(work, k);
    return all;
  }

 private:
  double We = 0.0;
};

template <class Space, class List>
void FixBubbleFlow::exchange_in(Space &space,
                                const Liquid::Loop<typename Space::Bubbles, List> &liquid,
                                const List &around, int nrows, double *const *acceleration,
                                double dt)
{
  using namespace Liquid;
  using B = typename Space::Bubbles;
  work.use(atom->nmax);
  const BubbleColumns at = columns_in(space);
  space.for_all(nrows, Interpolate<B, List>{liquid.b,
                                            around,
                                            liquid.c,
                                            at,
                                            liquid.set,
                                            {acceleration[0], acceleration[1], acceleration[2]}});
  Space ours(lmp, groupbit);
  ours.for_each(atom->nlocal, BubbleForces<B>{liquid.b, at, liquid.set, set});
  if (dt > 0.0) ours.for_each(atom->nlocal, MoveBubbles<B>{liquid.b, at, liquid.set, set, dt});
  comm->forward_comm(this);
}

}    // namespace LAMMPS_NS

#endif
#endif
