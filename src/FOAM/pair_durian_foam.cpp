/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#include "pair_durian_foam.h"

#include "foam_half_list.h"
#include "foam_host.h"
#include "foam_contact_blocks.h"
#include "foam_contact_loops.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"

#include <cmath>
#include <algorithm>
#include <cstring>
#include <type_traits>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

PairDurianFoam::PairDurianFoam(LAMMPS *lmp) : PairFoam(lmp, "durian/foam"), sigma0(nullptr)
{
  single_enable = 1;
}

/* ---------------------------------------------------------------------- */

PairDurianFoam::~PairDurianFoam()
{
  if (copymode) return;
  if (neighbor && list && list->occasional) list->inum = 0;    // its rows are here

  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
    memory->destroy(sigma0);
  }
}

// over LAMMPS' half list, each pair once: ghosts collect their part, and send it home

void PairDurianFoam::gather(unsigned what)
{
  make_room(what);
  take_list();
  Foam::with_loop(
      law, what, evflag, domain->dimension,
      [&]<int D, unsigned WHAT>(const auto &chosen) { gather_in<D, WHAT>(chosen, what); });

  gathered = what & ~(Foam::FORCE | Foam::GIVEN);
  if (force->newton_pair && gathered) comm->reverse_comm(this);
}

/* ----------------------------------------------------------------------
   The list is LAMMPS' own, which LAMMPS makes, or, as an occasional list, is filled here: each bubble looks only as far
   as its own size says.  LAMMPS has to where anything is asked for that is not known here.
------------------------------------------------------------------------- */

bool PairDurianFoam::can_make_lists() const
{
  const bool excludes = neighbor->nex_type || neighbor->nex_group || neighbor->nex_mol;
  return (kokkosable || force->newton_pair) && neighbor->style == Neighbor::BIN && !excludes &&
         !neighbor->includegroup && atom->molecular == Atom::ATOMIC &&
         !utils::strmatch(force->pair_style, "^hybrid");
}

void PairDurianFoam::take_list()
{
  if (list_made.of(neighbor)) return;
  near_list.numneigh.clear();
  const bool makes_it =
      list->occasional && can_make_lists();    // fixes may exclude pairs, later than init_style()
  if (makes_it)
    Foam::with_dimension(domain->dimension, [&]<int D>() { fill_list<D>(); });
  else if (list->occasional)
    neighbor->build_one(list);
  if (!makes_it && range() > 1.0)
    near_list.take(list->inum, list->ilist, list->numneigh, list->firstneigh, atom->nlocal,
                   Foam::ComesNear<Foam::HostBubbles, Foam::ReachOfContact>{
                       FoamHost(lmp).bubbles(), {range()}, neighbor->skin});
}

Foam::Cells::Near PairDurianFoam::near() const
{
  return {range(), neighbor->skin};
}

template <int D> void PairDurianFoam::fill_list()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const Foam::HostBubbles b = FoamHost(lmp).bubbles();
  cells.sort<D>(b, nlocal, nall, near());

  list->grow(nlocal, nall);
  partners.clear();
  for (int i = 0; i < nlocal; i++) {
    const size_t before = partners.size();
    const int found = cells.find<D>(b, i, near(), found_near);
    for (int m = 0; m < found; m++)
      if (Foam::is_in_row<D>(b, i, found_near[m], nlocal)) partners.push_back(found_near[m]);
    list->ilist[i] = i;
    list->numneigh[i] = static_cast<int>(partners.size() - before);
  }
  int *row = partners.data();    // it moves no more
  for (int i = 0; i < nlocal; row += list->numneigh[i++]) list->firstneigh[i] = row;
  list->inum = nlocal;
  list->gnum = 0;
}

bool PairDurianFoam::Made::of(const Neighbor *neighbor)
{
  const bool same = ncalls == neighbor->ncalls && lastcall == neighbor->lastcall;
  ncalls = neighbor->ncalls;
  lastcall = neighbor->lastcall;
  return same;
}

double PairDurianFoam::memory_usage()
{
  return PairFoam::memory_usage() + near_list.bytes() + pairs.bytes() + cells.bytes() +
         sizeof(int) * double(found_near.capacity() + partners.capacity());
}

struct PairDurianFoam::Tally {
  static constexpr bool ON = true;
  PairDurianFoam *style;
  int nlocal, newton;
  void pair(int i, int j, bool, double energy, double F_over_r, const double *del)
  {
    style->ev_tally(i, j, nlocal, newton, energy, 0.0, F_over_r, del[0], del[1], del[2]);
  }
};

template <int D, unsigned WHAT, class Law>
void PairDurianFoam::gather_in(const Law &chosen, unsigned what)
{
  FoamHost space(lmp);
  const int nlocal = atom->nlocal, newton = force->newton_pair;
  const Foam::ContactSums sums = contact_sums(space);
  const int nall = nlocal + (newton ? atom->nghost : 0);
  for (int i = 0; i < nall; i++) sums.clear(i, what);

  auto loop = [&]<bool NEWTON, class T>(T tally) {
    using List = FoamHalfList<NEWTON>;
    const bool all = near_list.numneigh.empty();
    const List half{list->ilist, all ? list->numneigh : near_list.numneigh.data(),
                    all ? list->firstneigh : near_list.firstneigh.data(), nlocal};
    const Foam::ContactLoop<D, WHAT, false, Law, Foam::HostBubbles, List, T> functor{
        space.bubbles(), half, chosen, coefficients(), sums, true, what};
    using Blocks = Foam::ContactBlocks<D, WHAT, Law, Foam::HostBubbles>;
    if constexpr (Blocks::POSSIBLE) {
      if (foam_has_wide_vectors() && !sums.members.mask) {
        if (!pairs_made.of(neighbor)) pairs.take(list->inum, half);
        const int count = static_cast<int>(pairs.first.size());
        return Blocks{space.bubbles(),
                      pairs.first.data(),
                      pairs.second.data(),
                      count,
                      0,
                      nall,
                      chosen,
                      coefficients(),
                      sums}();
      }
    }
    for (int n = 0; n < list->inum; n++) functor(n, tally);
  };
  using T = std::conditional_t<(WHAT & Foam::TALLY) != 0, Tally, Foam::NoTally>;
  const T tally{this, nlocal, newton};
  newton ? loop.template operator()<true>(tally) : loop.template operator()<false>(tally);
}

/* ---------------------------------------------------------------------- */

double PairDurianFoam::init_one(int i, int j)
{
  if (setflag[i][j] == 0) sigma0[i][j] = mix_energy(sigma0[i][i], sigma0[j][j], 1.0, 1.0);
  sigma0[j][i] = sigma0[i][j];
  return 2.0 * range() * cutoff_radius;
}

double PairDurianFoam::stiffest() const
{
  double most = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) most = MAX(most, sigma0[i][j]);
  Foam::with_law(law, [&](const auto &chosen) { most = chosen.spring(most); });
  return most;
}

// the law acts at r < range (R_i + R_j)

double PairDurianFoam::range() const
{
  double factor = 1.0;
  Foam::with_law(law, [&](const auto &chosen) { factor = chosen.range(); });
  return factor;
}

void PairDurianFoam::init_style()
{
  Foam::with_law(law, [&](const auto &chosen) {
    if (chosen.ONLY_3D && domain->dimension == 2)
      error->all(FLERR,
                 "Pair style durian/foam: law {} is one of bubbles in 3D, but dimension is 2",
                 chosen.NAME);
  });
  list_made = pairs_made = Made();
  list_flags &= ~NeighConst::REQ_OCCASIONAL;
  if (can_make_lists()) list_flags |= NeighConst::REQ_OCCASIONAL;
  PairFoam::init_style();
}

/* ---------------------------------------------------------------------- */

double PairDurianFoam::single(int i, int j, int itype, int jtype, double rsq, double, double,
                              double &fforce)
{
  fforce = 0.0;
  const double Ri = atom->radius[i], Rj = atom->radius[j], reach = range() * (Ri + Rj);
  if (!(rsq < reach * reach) || !(Ri > 0.0) || !(Rj > 0.0)) return 0.0;
  const double r = std::sqrt(rsq), stiffness = sigma0[itype][jtype] * hub.record.rin;
  const double overlap = Ri + Rj - r;
  double energy = 0.0;
  Foam::with_law(law, [&](const auto &chosen) {
    if (r > 0.0) fforce = chosen.force(stiffness, overlap, Ri, Rj) / r;
    energy = chosen.energy(stiffness, overlap, Ri, Rj);
  });
  return energy;
}

void *PairDurianFoam::extract(const char *name, int &dim)
{
  dim = 2;
  if (strcmp(name, "sigma0") == 0) return sigma0;
  dim = 0;
  if (strcmp(name, "mu0") == 0) return &mu0;
  if (strcmp(name, "rin") == 0) return &hub.record.rin;
  return nullptr;
}
