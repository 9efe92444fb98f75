/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(bubble/rise,FixBubbleRise);
// clang-format on
#else

#ifndef LMP_FIX_BUBBLE_RISE_H
#define LMP_FIX_BUBBLE_RISE_H

#include "bubble_liquid.h"
#include "foam_columns.h"

#include "atom.h"
#include "fix.h"

#include <string>

namespace LAMMPS_NS {

// The liquid around bubbles with inertia: buoyancy, drag, and the mass that is added to that of the gas

class FixBubbleRise : public Fix {
 public:
  FixBubbleRise(class LAMMPS *, int, char **);
  static FixBubbleRise *of(class LAMMPS *);    // the one in use, or none
  int setmask() override;
  void init() override;
  void setup_pre_reverse(int, int) override;
  void post_force(int) override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

  Bubble::Liquid liquid;
  bool implicit = false;    // the integrator may treat the drag implicitly

  // force of the drag per speed of each bubble, at the last evaluation

  template <class Space> const double *stiffness(Space &space)
  {
    return implicit ? space.column(columns, STIFFNESS) : nullptr;
  }

  enum { DRAG, BUOYANCY = DRAG + 3, LOOKS = BUOYANCY + 3 };
  FoamColumns &look();    // forces as things are now
  void check_place(const char *style, int kokkosable, int execution_space) const;    // or an error

 protected:
  virtual void act();
  virtual void fill_looks();
  virtual double kinetic();
  virtual void host_reads() {}
  template <class Space> void act_in(Space &space);
  template <class Space> void fill_looks_in(Space &space);
  template <class Space> double kinetic_in(Space &space);

  FoamColumnList all_columns;
  enum { STIFFNESS, VX, VY, VZ, NCOLUMNS };
  FoamColumns columns{all_columns, "liquid around bubbles", NCOLUMNS};
  FoamColumns looks{all_columns, "forces of the liquid", LOOKS};

 private:
  std::string flow[3];    // variables of style atom
  bool flows = false;
  Bubble::LiquidTotals totals;                            // of this rank
  double work[2] = {0.0, 0.0}, before[2] = {0.0, 0.0};    // by buoyancy and drag; powers
  enum { WORK_BUOYANCY, WORK_DRAG, POWER_BUOYANCY, POWER_DRAG, KINETIC, ALL };
  double all[ALL] = {};
  bool reduced = false;

  void push();
  void prepare();
  void take_flow();
  template <class Space> Bubble::Rise<typename Space::Bubbles> functor(Space &space);
  void reduce();
};

template <class Space> Bubble::Rise<typename Space::Bubbles> FixBubbleRise::functor(Space &space)
{
  auto along = [&](int k) -> const double * {
    return flow[k].empty() ? nullptr : space.column(columns, VX + k);
  };
  return {space.bubbles(), liquid, {along(0), along(1), along(2)}, nullptr};
}

template <class Space> void FixBubbleRise::act_in(Space &space)
{
  auto rise = functor(space);
  if (implicit) {
    rise.stiffness = space.column(columns, STIFFNESS);
    space.for_all(atom->nlocal, Bubble::ClearColumn{rise.stiffness});    // of all
  }
  totals = space.template totals<Bubble::LiquidTotals>(atom->nlocal, rise);
}

template <class Space> void FixBubbleRise::fill_looks_in(Space &space)
{
  for (int k = 0; k < LOOKS; k++)
    space.for_all(atom->nlocal, Bubble::ClearColumn{space.column(looks, k)});
  auto rise = functor(space);
  rise.moves = false;
  for (int k = 0; k < 3; k++) {
    rise.drag_of[k] = space.column(looks, DRAG + k);
    rise.buoyancy_of[k] = space.column(looks, BUOYANCY + k);
  }
  space.template totals<Bubble::LiquidTotals>(atom->nlocal, rise);
}

template <class Space> double FixBubbleRise::kinetic_in(Space &space)
{
  using B = typename Space::Bubbles;
  return space
      .template totals<Bubble::KineticEnergy>(atom->nlocal,
                                              Bubble::AddKinetic<B>{space.bubbles(), liquid})
      .sum;
}

}    // namespace LAMMPS_NS

#endif
#endif
