/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(foam/flow,FixFoamFlow);
// clang-format on
#else

#ifndef LMP_FIX_FOAM_FLOW_H
#define LMP_FIX_FOAM_FLOW_H

#include "fix.h"
#include "foam_flow.h"
#include "foam_host.h"
#include "foam_moving_box.h"
#include "pair_foam.h"

#include "atom.h"

#include <string>

namespace LAMMPS_NS {

// A flow of the liquid: it tells the integrator u_i, the velocity around each bubble of its group.  Where it goes
// with a box that deforms, it also says when this box is where.

class FixFoamFlow : public Fix {
 public:
  FixFoamFlow(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void pre_exchange() override;
  double compute_vector(int) override;
  double memory_usage() override;

  // u of the bubbles that this flow has, at their present places in the present box; others stay as they are

  template <class Space> void fill(Space &space, FoamColumns &u);
  bool on_host() const { return kind != Kind::SHEAR; }    // regions and variables

  // of a flow with the box

  bool moves_box() const { return kind == Kind::SHEAR; }
  void begin_run();    // takes the rates at which the box deforms
  void begin_step() { moved_by = 0.0; }
  void box_goes_on(double step);    // to the end of a step, where fix deform will find it

 protected:
  PairFoam *pair = nullptr;
  FoamColumnList all_columns;
  FoamColumns shown{all_columns, "velocities of a flow", 3};

  virtual void host_reads() {}
  virtual Foam::FlowTotals totals_there();
  template <class Space> Foam::FlowTotals totals_in(Space &);

 private:
  enum class Kind { REGION, SHEAR, FIELD } kind;
  double velocity[3] = {0.0, 0.0, 0.0};
  bool touching = false;
  std::string region_id, variable_name[3];    // empty: 0
  class Region *region = nullptr;

  double moved_by = 0.0;    // since fix deform has acted last
  double moved_tilts[3] = {0.0, 0.0, 0.0};

  Foam::FlowTotals last;
  bigint last_step = -1;

  class Fix *fix_deform() const;
  void check_foam();
  bool touches(double *x, double R);
  void fill_region(FoamColumns &);
  void fill_field(FoamColumns &);
  void fill_on_host(FoamColumns &u) { kind == Kind::REGION ? fill_region(u) : fill_field(u); }
};

template <class Space> void FixFoamFlow::fill(Space &space, FoamColumns &u)
{
  if (on_host()) {
    fill_on_host(u);
    return;
  }
  const Foam::FlowWithBox<typename Space::Bubbles> functor{
      space.bubbles(),
      space.members(groupbit),
      foam_affine_flow(domain),
      {{space.column(u, 0), space.column(u, 1), space.column(u, 2)}}};
  space.for_each(atom->nlocal, functor);
}

// all that is read on the host first, so that what lies elsewhere is not outdated by it

template <class Space> Foam::FlowTotals FixFoamFlow::totals_in(Space &space)
{
  shown.use(atom->nmax);
  space.groupbit = pair->hub.groupbit;
  auto flow = [&](auto &where) {
    return Foam::FlowVelocity{
        {where.column(shown, 0), where.column(shown, 1), where.column(shown, 2)}};
  };
  if (on_host()) {
    host_reads();
    FoamHost host(lmp, pair->hub.groupbit);
    host.for_each(atom->nlocal, Foam::ClearFlow{flow(host)});
    fill_on_host(shown);
  } else {
    space.for_each(atom->nlocal, Foam::ClearFlow{flow(space)});
    fill(space, shown);
  }
  return Foam::with_dimension(domain->dimension, [&]<int D>() {
    const Foam::AddFlow<D, typename Space::Bubbles> functor{space.bubbles(), flow(space),
                                                            pair->mu0};
    return space.template totals<Foam::FlowTotals>(atom->nlocal, functor);
  });
}

}    // namespace LAMMPS_NS

#endif
#endif
