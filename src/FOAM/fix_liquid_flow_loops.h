/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_LIQUID_FLOW_LOOPS_H
#define LMP_FIX_LIQUID_FLOW_LOOPS_H

#include "fix_bubble_flow.h"
#include "fix_liquid_flow.h"
#include "foam_reduce.h"

#include "atom.h"
#include "update.h"

#include <type_traits>

// The loops of a step of the liquid, in the order of liquid_operators.h, for each space

namespace LAMMPS_NS {

template <class Space> void FixLiquidFlow::advance_in(Space &space, double dt)
{
  using B = typename Space::Bubbles;
  space.for_each(atom->nlocal, Liquid::Advance<B>{space.bubbles(), walls, dt});
}

template <class Space> void FixLiquidFlow::look_in(Space &space)
{
  using B = typename Space::Bubbles;
  speeds = space.template totals<Liquid::SpeedTotals>(
      atom->nlocal, Liquid::LookAtSpeeds<B>{space.bubbles(), set});
}

template <class Space> void FixLiquidFlow::keep_pressure_in(Space &space)
{
  space.for_each(atom->nlocal,
                 Liquid::Copy{space.column(work, Liquid::SOLUTION), space.column(state, PRESSURE)});
}

template <class Space> void FixLiquidFlow::move_in(Space &space, double dt)
{
  using B = typename Space::Bubbles;
  speeds = space.template totals<Liquid::SpeedTotals>(
      atom->nlocal,
      Liquid::Move<B>{space.bubbles(),
                      walls,
                      columns_in(space),
                      set,
                      space.column(state, PRESSURE),
                      space.column(state, OLDER),
                      {space.column(state, ACCELERATION), space.column(state, ACCELERATION + 1),
                       space.column(state, ACCELERATION + 2)},
                      space.column(state, SMOOTHING),
                      level,
                      dt});
}

// The rows of neighbors, in a room that grows until all are in

template <class Space, class Rows, class Room>
void FixLiquidFlow::find_close_in(Space &space, const Rows &near, Room &room)
{
  using namespace Liquid;
  using B = typename Space::Bubbles;
  const auto list = near.rows(PairLiquidSPH::LIQUID);
  using List = std::remove_const_t<decltype(list)>;
  for (;;) {
    const auto close = room.close(atom->nlocal, row_width);
    space.for_all(
        near.nrows(PairLiquidSPH::LIQUID),
        FindClose<B, List, Room::BY_ROWS>{space.bubbles(), list, space.column(work, H), close});
    const Foam::FoamMax all =
        space.template totals<Foam::FoamMax>(atom->nlocal, LongestRow{close.size});
    const int longest = static_cast<int>(all);
    if (longest <= row_width) break;
    row_width = longest + longest / 8;
  }
}

template <class Space, class Rows, class Room>
auto FixLiquidFlow::close_loop_in(Space &space, const Rows &near, Room &room)
{
  const auto list = near.rows(PairLiquidSPH::LIQUID);
  using List = std::remove_const_t<decltype(list)>;
  return loop_in(space,
                 Liquid::CloseList<List, Room::BY_ROWS>{list, room.close(atom->nlocal, row_width)});
}

template <class Space, class Rows, class Room>
void FixLiquidFlow::gather_in(Space &space, const Rows &near, Room &room, double dt)
{
  using namespace Liquid;
  using B = typename Space::Bubbles;
  const Columns c = columns_in(space);
  const int nrows = near.nrows(PairLiquidSPH::LIQUID);

  space.for_all(atom->nlocal + atom->nghost, WithoutGas{c, set});
  if (gas) {
    const auto bubbles = loop_in(space, near.rows(PairLiquidSPH::BUBBLES_OF_LIQUID));
    using Bubbles = std::remove_const_t<decltype(bubbles.list)>;
    space.for_all(nrows, TakeGas<B, Bubbles>{bubbles, space.column(state, SMOOTHING)});
    send(work, ALPHA, 2);
  }
  find_close_in(space, near, room);
  const auto loop = close_loop_in(space, near, room);
  using List = std::remove_const_t<decltype(loop.list)>;
  space.for_all(nrows, Gather<B, List>{loop});
  if (set.shifts || gas) {
    send(work, SURFACE, 7);    // and raw normals
    space.for_all(nrows, Smooth<B, List>{loop});
  }
  if (gas) {
    space.for_each(atom->nlocal, Curl{c});
    send(work, VORTEX, 5);
    send(state, ACCELERATION, 3);
    if (gas->set.surface) send(work, SURFACE, 4);    // and normals
    double *const acceleration[3] = {space.column(state, ACCELERATION),
                                     space.column(state, ACCELERATION + 1),
                                     space.column(state, ACCELERATION + 2)};
    gas->exchange_in(space, loop, near.rows(PairLiquidSPH::LIQUID_OF_BUBBLES),
                     near.nrows(PairLiquidSPH::LIQUID_OF_BUBBLES), acceleration, dt);
    send(gas->work, REACTION, AT_BUBBLES - REACTION);
    const auto bubbles = near.rows(PairLiquidSPH::BUBBLES_OF_LIQUID);
    using Bubbles = std::remove_const_t<decltype(bubbles)>;
    space.for_all(nrows, TakeReaction<B, Bubbles>{loop.b, bubbles, c, gas->columns_in(space)});
  }
  totals = space.template totals<GatherTotals>(atom->nlocal, Account{c, set});
}

// dot products and ghosts for the solver

template <bool BY_ROWS, class Space>
Liquid::Solved FixLiquidFlow::solve_in(Space &space, const Liquid::Matrix<BY_ROWS> &matrix)
{
  using namespace Liquid;
  const int n = atom->nlocal;
  const Vectors w{space.column(work, SOLUTION), space.column(vectors, 0), space.column(vectors, 1),
                  space.column(vectors, 2),     space.column(vectors, 3), space.column(vectors, 4),
                  space.column(vectors, 5),     space.column(vectors, 6)};
  auto ghosts = [&](const double *vector) {
    if (vector == w.x) send(work, SOLUTION, 1);
    if (vector == w.p) send(vectors, 3, 1);
    if (vector == w.s) send(vectors, 5, 1);
  };
  auto all = [&](const auto &functor) {
    return foam_sum(space.template totals<Products>(n, functor), world);
  };
  auto each = [&](const auto &functor) {
    space.for_each(n, functor);
  };
  return Liquid::solve(matrix, w, tolerance, most_iterations, Means{ghosts, all, each});
}

template <class Space, class Rows, class Room>
void FixLiquidFlow::project_in(Space &space, const Rows &near, Room &room, double dt)
{
  using namespace Liquid;
  using B = typename Space::Bubbles;
  const auto loop = close_loop_in(space, near, room);
  using List = std::remove_const_t<decltype(loop.list)>;
  const int nrows = near.nrows(PairLiquidSPH::LIQUID);
  send(work, DIFFUSES, 1);
  space.for_all(nrows, Predict<B, List>{loop, space.column(state, SMOOTHING), dt});
  send(work, STAR, 3);

  const auto matrix = room.matrix(loop.list.close);
  using M = std::remove_const_t<decltype(matrix)>;
  const double *const before = space.column(state, PRESSURE);
  double *const pressure = space.column(work, SOLUTION);
  space.for_all(atom->nlocal, Extrapolate{before, space.column(state, OLDER), pressure,
                                          now.done_dt > 0.0 ? dt / now.done_dt : 0.0});
  space.for_all(nrows, Assemble<B, List, M>{loop, matrix, before, space.column(vectors, 0), dt});
  solved = solve_in(space, matrix);
  level = 0.0;
  if (without_level) {
    const auto sum =
        foam_sum(space.template totals<Products>(atom->nlocal, SumAndCount{pressure}), world);
    if (sum.b > 0.0) level = sum.a / sum.b;
  }
  send(work, SOLUTION, 1);
  space.for_all(nrows, Project<B, List>{loop});
}

}    // namespace LAMMPS_NS

#endif
