/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(foam/bubble,ComputeFoamBubble);
// clang-format on
#else

#ifndef LMP_COMPUTE_FOAM_BUBBLE_H
#define LMP_COMPUTE_FOAM_BUBBLE_H

#include "compute.h"
#include "fix_foam_coarsen.h"
#include "foam_diagnostics.h"
#include "foam_host.h"

#include "atom.h"
#include "domain.h"

namespace LAMMPS_NS {

// Per-bubble quantities of the present state, one column for each name given.

class ComputeFoamBubble : public Compute {
 public:
  ComputeFoamBubble(class LAMMPS *, int, char **);
  ~ComputeFoamBubble() override;
  void init() override;
  void compute_peratom() override;
  double memory_usage() override;

 protected:
  Foam::Quantities wanted;
  PairFoam *pair;
  FixFoamCoarsen *gas;    // null: no gas is exchanged
  int nmax;
  double *vector;
  double **array;

  void find_foam();
  void gather();    // the sums of the pair style, of the present state

  // fills out[nlocal][wanted.count] from what the pair style has gathered

  template <class Space, class Masks> void fill(Space &space, const Masks &mask, double *out)
  {
    Foam::with_dimension(domain->dimension, [&]<int D>() { fill_in<D>(space, mask, out); });
  }

 private:
  template <int D, class Space, class Masks>
  void fill_in(Space &space, const Masks &mask, double *out)
  {
    using B = typename Space::Bubbles;
    space.groupbit = pair->hub.groupbit;
    auto gas_law = gas ? gas->exchange<D>(space, atom->nlocal) : Foam::Exchange<D>();
    gas_law.walls = pair->hub.walls_that(FoamHub::COVER, space);
    const Foam::FillDiagnostics<D, B, Masks> functor{
        space.bubbles(), mask,    groupbit | pair->hub.groupbit, out,
        wanted,          gas_law, pair->contact_sums(space)};
    space.for_all(atom->nlocal, functor);
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
