/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_VECTORS_H
#define LMP_FOAM_VECTORS_H

#include "foam_physics.h"

#include <cstring>
#include <type_traits>

// Loops in vectors, on processors of which a vector has four numbers or more: GCC makes a version of a function for each
// width, and one is chosen when the program starts.  It needs to be told that nobody asks for errno or for traps of
// arithmetic, which changes no number.

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) && \
    defined(__NO_MATH_ERRNO__) && defined(__NO_TRAPPING_MATH__) &&                           \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__CUDACC__)
#define FOAM_WIDE_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#define FOAM_INDEPENDENT  _Pragma("GCC ivdep")
inline constexpr bool FOAM_MAKES_VECTORS = true;
inline bool foam_has_wide_vectors()
{
  return __builtin_cpu_supports("avx2");
}
#else
#define FOAM_WIDE_VECTORS
#define FOAM_INDEPENDENT
inline constexpr bool FOAM_MAKES_VECTORS = false;
inline bool foam_has_wide_vectors()
{
  return false;
}
#endif

// A loop has a copy of its functor that no pointer leads to, and all that it calls in it: so nothing has to be read again
// after each number that is written.

template <class Functor>
FOAM_FLAT void foam_loop_one_by_one(const Functor &functor, int begin, int end)
{
  const Functor own = functor;
  for (int i = begin; i < end; i++) own(i);
}

// Functors depend on settings that are the same for all bubbles, and the same in most foams that coarsen.  One that has
// is_plain() says where they are.  Below that question the compiler knows the answers, what depends on them is
// gone, and it does several bubbles at a time.  (GCC 12 does so only if the other loop is in the same function.)

template <class Functor>
FOAM_WIDE_VECTORS FOAM_FLAT void foam_loop_in_vectors(const Functor &functor, int begin, int end)
{
  const Functor own = functor;
  if (own.is_plain()) {
    FOAM_INDEPENDENT
    for (int i = begin; i < end; i++) own(i);
  } else {
    for (int i = begin; i < end; i++) own(i);
  }
}

template <class Functor>
auto foam_choose_loop(const Functor &functor, int begin, int end, int)
    -> decltype(functor.is_plain(), void())
{
  foam_has_wide_vectors() ? foam_loop_in_vectors(functor, begin, end)
                          : foam_loop_one_by_one(functor, begin, end);
}
template <class Functor> void foam_choose_loop(const Functor &functor, int begin, int end, long)
{
  foam_loop_one_by_one(functor, begin, end);
}

template <class Functor> void foam_loop(const Functor &functor, int begin, int end)
{
  foam_choose_loop(functor, begin, end, 0);
}

// Totals over bubbles.  Sums are made one by one, in the order of the bubbles, but where a functor first moves a bubble,
// move(i), and then judges it, it moves those of a block in vectors before it judges them.

template <class Move> struct FoamMoved {    // of a block; Move: a struct of numbers
  static constexpr int SIZE = 248, NUMBERS = sizeof(Move) / sizeof(double);
  static_assert(std::is_trivially_copyable_v<Move> && sizeof(Move) % sizeof(double) == 0);
  double number[NUMBERS][SIZE];
  void put(int m, const Move &move)
  {
    double each[NUMBERS];
    std::memcpy(each, &move, sizeof(Move));
    for (int k = 0; k < NUMBERS; k++) number[k][m] = each[k];
  }
  Move get(int m) const
  {
    double each[NUMBERS];
    for (int k = 0; k < NUMBERS; k++) each[k] = number[k][m];
    Move move;
    std::memcpy(&move, each, sizeof(Move));
    return move;
  }
};

template <class Functor> struct FoamMoves {
  Functor functor;
  FoamMoved<typename Functor::Move> *block;
  int first;
  void operator()(int i) const { block->put(i - first, functor.move(i)); }
  bool is_plain() const { return functor.is_plain(); }
};

template <class Totals, class Functor>
auto foam_totals_in_blocks(const Functor &functor, int begin, int end, Totals &all, int)
    -> decltype(functor.move(0), bool())
{
  if (!foam_has_wide_vectors() || !functor.is_plain()) return false;
  FoamMoved<typename Functor::Move> block;
  const auto judge = functor.judge;
  Totals mine = all;
  for (int i = begin; i < end; i += block.SIZE) {
    const int next = end - i < block.SIZE ? end : i + block.SIZE;
    foam_loop_in_vectors(FoamMoves<Functor>{functor, &block, i}, i, next);
    for (int m = 0; m < next - i; m++) judge(i + m, block.get(m), mine);
  }
  all = mine;
  return true;
}
template <class Totals, class Functor>
bool foam_totals_in_blocks(const Functor &, int, int, Totals &, long)
{
  return false;
}

template <class Totals, class Functor>
FOAM_FLAT void foam_totals_of(const Functor &functor, int begin, int end, Totals &all)
{
  if (foam_totals_in_blocks(functor, begin, end, all, 0)) return;
  const Functor own = functor;
  Totals mine = all;
  for (int i = begin; i < end; i++) own(i, mine);
  all = mine;
}

#endif
