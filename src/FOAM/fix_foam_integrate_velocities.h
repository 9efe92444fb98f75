/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_FOAM_INTEGRATE_VELOCITIES_H
#define LMP_FIX_FOAM_INTEGRATE_VELOCITIES_H

#include "fix_foam_integrate.h"

namespace LAMMPS_NS {

// How FixFoamIntegrate finds velocities: from drag, flow of the liquid, and the rates that follow

// The velocity of the liquid around the bubbles as they were evaluated last.  What one flow has to be asked on the
// host, all are.

template <class Space> void FixFoamIntegrate::take_flow(Space &space)
{
  flow.use(atom->nmax);
  const FoamBoxLater box(domain, evaluated_later);
  auto fill = [&](auto &where) {
    const Foam::FlowVelocity all{
        {where.column(flow, 0), where.column(flow, 1), where.column(flow, 2)}};
    where.for_each(atom->nlocal, Foam::ClearFlow{all});
    for (FixFoamFlow *one : flows) one->fill(where, flow);
  };
  bool host = false;
  for (const FixFoamFlow *one : flows) host = host || one->on_host();
  if (host) {
    host_reads();
    FoamHost there(lmp, groupbit);
    fill(there);
    space.bubbles();    // functors will write to them here, as was said before the host read
  } else
    fill(space);
}

template <int D, class Space>
Foam::Drag<D, typename Space::Bubbles> FixFoamIntegrate::drag_without_contacts(Space &space)
{
  const Foam::ContactSums sums = pair->contact_sums(space);
  Foam::Drag<D, typename Space::Bubbles> drag{space.bubbles(), pair->mu0};
  if (pair->neighbor_drag)
    drag.ambient = {sums.contacts, {sums.vsum[0], sums.vsum[1], sums.vsum[2]}};
  if (!flows.empty())
    for (int k = 0; k < 3; k++) drag.ambient.flow[k] = space.column(flow, k);
  return drag;
}

template <class Space> void FixFoamIntegrate::solve_drag_in(Space &space)
{
  using B = typename Space::Bubbles;
  if (!(pair->mu_c > 0.0)) return;
  if (!flows.empty()) take_flow(space);
  auto columns = [&](FoamColumns &from, double **to) {
    from.use(atom->nmax);
    for (int k = 0; k < 3; k++) to[k] = space.column(from, k);
  };
  const bool found = Foam::with_dimension(dim, [&]<int D>() {
    pair->make_room(Foam::DRAG | Foam::GIVEN);
    const Foam::ContactSums sums = pair->contact_sums(space);
    Foam::DragSystem<D, B> s{drag_without_contacts<D>(space),
                             pair->mu_c,
                             pair->neighbor_solve ? least_eigenvalue() : 0.0,
                             sums.contacts,
                             {sums.vsum[0], sums.vsum[1], sums.vsum[2]},
                             {},
                             {},
                             {}};
    columns(solved, s.w);
    columns(residual, s.r);
    columns(pair->given, s.p);
    auto gather = [&] {
      pair->send_given();
      pair->sum_given();
    };
    auto gather_ambient = [&] {    // the flow with the box is that of each image's own place
      if (!shear) return gather();
      const FoamBoxLater box(domain, evaluated_later);
      const Foam::AddAffine<D, B> affine{
          space.bubbles(), foam_affine_flow(domain), {s.p[0], s.p[1], s.p[2]}, 1.0};
      space.for_each(atom->nlocal, affine.reversed());
      pair->send_given();
      space.for_all(atom->nlocal + atom->nghost, affine);
      pair->sum_given();
    };
    auto all = [&](const auto &functor) {
      return foam_sum(space.template totals<Foam::DragTotals>(atom->nlocal, functor), world);
    };
    const Foam::DragMeans means{gather, gather_ambient, all};
    return Foam::solve_contact_drag(s, space, atom->nlocal, error_of_drag(), !flows.empty(), means);
  });
  if (!found) no_solution();
}

// Averaging over neighbors leaves a common velocity as it is, so with neighbor drag the foam
// as a whole may drift; the remedy goes on in the frame in which it is at rest.

template <int D, class Space>
Foam::Rates<D, typename Space::Bubbles> FixFoamIntegrate::rates(Space &space)
{
  using B = typename Space::Bubbles;
  if (!flows.empty() && !(pair->mu_c > 0.0)) take_flow(space);    // else solve_drag() has
  Foam::Drag<D, B> drag = drag_without_contacts<D>(space);
  if (pair->mu_c > 0.0)
    for (int k = 0; k < D; k++) drag.solved[k] = space.column(solved, k);
  drag.walls = pair->hub.walls_that(FoamHub::HOLD, space);
  if (drift_removed) {
    drag.drift = space.template sums<Foam::DriftTotals>(atom->nlocal, Foam::AddDrift<D, B>{drag});
    drag.drift_removed = true;
  }
  Foam::Rates<D, B> f{space.bubbles(), drag};
  f.variable = variable;
  f.grows = grows();
  if (gas) {
    f.gas = gas->exchange<D>(space, atom->nlocal);
    gas->note(f.gas);
  }
  return f;
}

template <class Space> void FixFoamIntegrate::shift_by_images_in(Space &space, double sign)
{
  using B = typename Space::Bubbles;
  auto before = [&](int k) {
    return has_history() ? space.column(columns, VX_BEFORE + k) : nullptr;
  };
  Foam::with_dimension(dim, [&]<int D>() {
    const Foam::ShiftByImages<D, B> functor{space.bubbles(),
                                            space.images(),
                                            foam_affine_flow(domain),
                                            {before(0), before(1), before(2)},
                                            sign};
    space.for_each(atom->nlocal, functor);
  });
}

}    // namespace LAMMPS_NS

#endif
