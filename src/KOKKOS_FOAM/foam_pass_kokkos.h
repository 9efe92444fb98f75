/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_PASS_KOKKOS_H
#define LMP_FOAM_PASS_KOKKOS_H

#include "foam_contact_blocks.h"
#include "foam_gas.h"
#include "foam_kokkos.h"

// One pass over the contacts, with what is summed in it

namespace LAMMPS_NS::FoamPass {

struct EnergyVirial {
  double energy = 0.0, virial[6] = {};
  KOKKOS_INLINE_FUNCTION void join(const EnergyVirial &other)
  {
    energy += other.energy;
    for (int k = 0; k < 6; k++) virial[k] += other.virial[k];
  }
};

// what is asked for of each pair; one end of it counts half

template <class DeviceType> struct KokkosTally {
  static constexpr bool ON = true;
  using AT = ArrayTypes<DeviceType>;
  EnergyVirial *all;
  bool e_atom, v_atom;
  typename AT::t_kkacc_1d eatom;
  typename AT::t_kkacc_1d_6 vatom;

  KOKKOS_INLINE_FUNCTION void pair(int i, int j, bool both, double energy, double F_over_r,
                                   const double *del) const
  {
    const double share = both ? 1.0 : 0.5;
    const double v[6] = {F_over_r * del[0] * del[0], F_over_r * del[1] * del[1],
                         F_over_r * del[2] * del[2], F_over_r * del[0] * del[1],
                         F_over_r * del[0] * del[2], F_over_r * del[1] * del[2]};
    all->energy += share * energy;
    for (int k = 0; k < 6; k++) all->virial[k] += share * v[k];
    if (e_atom) {
      eatom(i) += 0.5 * energy;
      if (both) eatom(j) += 0.5 * energy;
    }
    if (v_atom)
      for (int k = 0; k < 6; k++) {
        vatom(i, k) += 0.5 * v[k];
        if (both) vatom(j, k) += 0.5 * v[k];
      }
  }
};

// Bodies for a bubble or, where pairs occur once, for a chunk of them: row by row or, on processors with wide vectors,
// in blocks of pairs. Forces are written over if LAMMPS has not cleared them.

template <bool CHUNKS, class Loop, class Blocks> struct Pass {
  Loop loop;
  int chunk, nlocal;
  bool clear;

  template <class Tally> FOAM_ALWAYS_INLINE void operator()(int n, Tally &tally) const
  {
    if constexpr (CHUNKS)
      do_chunk(n, tally);
    else
      loop(n, tally);
  }
  KOKKOS_INLINE_FUNCTION int begin(int c) const { return c * chunk; }
  KOKKOS_INLINE_FUNCTION int end(int c) const
  {
    return (c + 1) * chunk < nlocal ? (c + 1) * chunk : nlocal;
  }

 private:
  template <class Tally> FOAM_ALWAYS_INLINE void do_chunk(int c, Tally &tally) const
  {
    const unsigned what = loop.asked();
    for (int i = begin(c); i < end(c); i++) {
      loop.sums.clear(i, what);
      if (clear && (what & Foam::FORCE))
        for (int k = 0; k < 3; k++) loop.b.f(i, k) = 0.0;
    }
    if constexpr (Blocks::POSSIBLE) {
      const auto &rows = loop.list;
      if (rows.owner.data() && !loop.sums.members.mask) {
        const int first = rows.first(begin(c));
        return Blocks{loop.b,
                      rows.owner.data() + first,
                      rows.partner.data() + first,
                      rows.first(end(c)) - first,
                      begin(c),
                      end(c),
                      loop.law,
                      loop.coefficients,
                      loop.sums}();
      }
    }
    for (int i = begin(c); i < end(c); i++) loop(i, tally);
  }
};

struct NoBlocks {
  static constexpr bool POSSIBLE = false;
};

template <class Pass> struct Contacts {
  static constexpr const char *NAME = "foam: contacts";
  Pass pass;
  KOKKOS_INLINE_FUNCTION void operator()(int n) const
  {
    Foam::NoTally none{};
    pass(n, none);
  }
};

// the sums over all bubbles that exchange through the liquid needs come with it

template <int D, class Pass> struct SummedContacts {
  static constexpr const char *NAME = "foam: contacts and free surface";
  Pass pass;
  Foam::LiquidLaw law;
  Foam::Walls walls;    // that cover bubbles
  KOKKOS_INLINE_FUNCTION void operator()(int n, Foam::FreeSurface &all) const
  {
    Foam::NoTally none{};
    pass(n, none);
    const auto b = pass.loop.b;
    const double *const area = pass.loop.sums.area;
    const Foam::Members member = pass.loop.sums.members;
    Foam::FreeSurface mine;
    for (int i = pass.begin(n); i < pass.end(n); i++)
      if (member(i)) mine.template add<D>(law, b, i, area, walls);
    all.join(mine);
  }
};

template <class Pass, class DeviceType> struct TalliedContacts {
  static constexpr const char *NAME = "foam: contacts, energy and virial";
  Pass pass;
  KokkosTally<DeviceType> tally;
  KOKKOS_INLINE_FUNCTION void operator()(int n, EnergyVirial &all) const
  {
    KokkosTally<DeviceType> mine = tally;
    mine.all = &all;
    pass(n, mine);
  }
};

}    // namespace LAMMPS_NS::FoamPass

#endif
