/* ----------------------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   https://www.lammps.org/, Sandia National Laboratories
   LAMMPS development team: developers@lammps.org

   This software is distributed under the GNU General Public License.
   Wet-foam package: see the README file of the package.
------------------------------------------------------------------------- */

#ifndef LMP_FOAM_KOKKOS_H
#define LMP_FOAM_KOKKOS_H

#include "foam_columns.h"
#include "foam_bubbles.h"
#include "foam_reduce.h"
#include "foam_vectors.h"

#include "atom_kokkos.h"
#include "atom_masks.h"
#include "kokkos_type.h"

#include <cstring>

#ifdef FOAM_POISON
#include "poisoned_storage.h"    // of the tests: unittest/poison
#endif

namespace LAMMPS_NS {

// Columns on host and device. Whoever asks for one side may write to it, so a change of sides
// copies the block: during a run nobody asks for the host's.

template <class DeviceType> class FoamKokkosStorage : public FoamStorage {
 public:
  void resize(int columns, int length) override
  {
    if (block.extent(0) == 0)
      block = Block("foam:columns", length, columns);
    else
      block.resize(length, columns);
  }
  double *on_host() override
  {
    block.sync_host();
    block.modify_host();
    return block.view_host().data();
  }
  double *on_device() override
  {
    block.sync_device();
    block.modify_device();
    return block.view_device().data();
  }

 private:
  using Block = Kokkos::DualView<double **, Kokkos::LayoutLeft, DeviceType>;
  Block block;
};

// Restart files match fixes by style: the name without suffix, so that runs go on with or without

inline void foam_strip_suffix(char *style)
{
  if (char *suffix = std::strstr(style, "/kk")) *suffix = '\0';
}

// LAMMPS' bubbles on the device, in its precision (KOKKOS_PREC): see Foam::HostBubbles. Where that
// is single, an integrator keeps what coordinates have beyond it in columns of its own.

template <class DeviceType> struct FoamKokkosBubbles {
  using AT = ArrayTypes<DeviceType>;
  typename AT::t_kkfloat_1d_3_lr x;
  typename AT::t_kkfloat_1d_3 v;
  typename AT::t_kkacc_1d_3 f;
  typename AT::t_kkfloat_1d radius;
  typename AT::t_int_1d type;
  typename AT::t_tagint_1d tag;
  typename AT::t_kkfloat_1d mass;    // none, where the atom style has none

  double *residual[3];    // what the first lacks of double precision

  static constexpr bool DOUBLE = std::is_same_v<KK_FLOAT, double>;

  KOKKOS_INLINE_FUNCTION double place(int i, int k) const
  {
    return DOUBLE || !residual[k] ? x(i, k) : x(i, k) + residual[k][i];
  }
  KOKKOS_INLINE_FUNCTION void put(int i, int k, double value) const
  {
    x(i, k) = value;
    if (!DOUBLE && residual[k]) residual[k][i] = value - x(i, k);
  }
};

// Reduction of what has a join(), to the host or, without waiting for it, to memory of the device

template <class Value, class Space> class FoamJoin {
 public:
  using reducer = FoamJoin;
  using value_type = Value;
  using result_view_type = Kokkos::View<Value, Space, Kokkos::MemoryUnmanaged>;

  KOKKOS_INLINE_FUNCTION explicit FoamJoin(Value *where) : result(where) {}
  KOKKOS_INLINE_FUNCTION void join(Value &to, const Value &from) const { to.join(from); }
  KOKKOS_INLINE_FUNCTION void init(Value &value) const { value = Value(); }
  KOKKOS_INLINE_FUNCTION Value &reference() const { return *result.data(); }
  KOKKOS_INLINE_FUNCTION result_view_type view() const { return result; }
  KOKKOS_INLINE_FUNCTION bool references_scalar() const    // of the host, so that Kokkos waits
  {
    return std::is_same_v<Space, Kokkos::HostSpace>;
  }

 private:
  result_view_type result;
};

// A functor for bubbles alone

template <class Functor> struct FoamEachBubble {
  Functor functor;
  Foam::Members member;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    if (member(i)) functor(i);
  }
};
template <class Functor, class Value> struct FoamReduceBubbles {
  Functor functor;
  Foam::Members member;
  KOKKOS_INLINE_FUNCTION void operator()(int i, Value &value) const
  {
    if (member(i)) functor(i, value);
  }
};

// On the host a thread has a slice of consecutive bubbles. It works with a copy of the functor, and of what it sums,
// that no pointer leads to: neither has to be read again after each number that is written (see FoamHost).

template <class Functor, class Value> struct FoamSlices {
  Functor functor;
  int n, slice;
  void operator()(int t) const
  {
    const int begin = t * slice, end = begin + slice < n ? begin + slice : n;
    foam_loop(functor, begin, end);
  }
  FOAM_FLAT void operator()(int t, Value &all) const
  {
    const int begin = t * slice, end = begin + slice < n ? begin + slice : n;
    Value mine;
    foam_totals_of(functor, begin, end, mine);
    all.join(mine);
  }
};

// The space in which KOKKOS styles run: see FoamHost

template <class DeviceType> class FoamKokkos : protected Pointers {
 public:
  static constexpr ExecutionSpace SPACE = ExecutionSpaceFromDevice<DeviceType>::space;
  static constexpr bool ON_HOST = std::is_same_v<DeviceType, LMPHostType>;

  // On the host, in double precision, arrays are laid out as without KOKKOS, and pointers to them
  // are faster than Views.

  static constexpr bool AS_WITHOUT = ON_HOST && FoamKokkosBubbles<DeviceType>::DOUBLE &&
                                     !DAT::ttransform_kkacc_1d_3::NEED_TRANSFORM;
  using Bubbles = std::conditional_t<AS_WITHOUT, Foam::HostBubbles, FoamKokkosBubbles<DeviceType>>;

  // changes: masks of LAMMPS' arrays that functors may write to

  FoamKokkos(LAMMPS *lmp, uint64_t changes)
      : Pointers(lmp), written(changes), sums_there("foam:sums")
  {
  }

  Bubbles bubbles() const
  {
    atomKK->sync(SPACE, X_MASK | V_MASK | F_MASK | RADIUS_MASK | TYPE_MASK | TAG_MASK | RMASS_MASK);
    atomKK->modified(SPACE, written);
    const auto x = atomKK->k_x.view<DeviceType>();
    const auto v = atomKK->k_v.view<DeviceType>();
    const auto f = atomKK->k_f.view<DeviceType>();
    const auto radius = atomKK->k_radius.view<DeviceType>();
    const auto type = atomKK->k_type.view<DeviceType>();
    const auto tag = atomKK->k_tag.view<DeviceType>();
    const auto mass = atomKK->k_rmass.view<DeviceType>();
    if constexpr (AS_WITHOUT) {
      return {{x.data()},    {v.data()},   {f.data()},   {radius.data()},
              {type.data()}, {tag.data()}, {mass.data()}};
    } else {
      auto residual = [&](int k) {
        return residuals ? residuals->on_device(k) : nullptr;
      };
      return {x, v, f, radius, type, tag, mass, {residual(0), residual(1), residual(2)}};
    }
  }
  Foam::Members members(int group) const
  {
    if (group == Foam::GROUP_ALL) return {};
    atomKK->sync(SPACE, MASK_MASK);
    return {atomKK->k_mask.view<DeviceType>().data(), group};
  }
  const imageint *images() const
  {
    atomKK->sync(SPACE, IMAGE_MASK);
    return atomKK->k_image.view<DeviceType>().data();
  }
  static double *column(FoamColumns &columns, int c) { return columns.on_device(c); }
  static void keep(const FoamColumnList &all)
  {
    for (FoamColumns *columns : all)
#ifdef FOAM_POISON
      columns->keep_in(foam_poisoned_storage(columns->name));
#else
      columns->keep_in(std::make_unique<FoamKokkosStorage<DeviceType>>());
#endif
  }

  template <class Functor> void for_all(int n, const Functor &functor) const
  {
    loop(Functor::NAME, n, functor);
  }
  template <class Functor> void for_each(int n, const Functor &functor) const
  {
    if (groupbit == Foam::GROUP_ALL)
      loop(Functor::NAME, n, functor);
    else
      loop(Functor::NAME, n, FoamEachBubble<Functor>{functor, members(groupbit)});
  }

  // the host waits for these

  template <class Value, class Functor> Value reduce(int n, const Functor &functor) const
  {
    Value mine;
    const FoamJoin<Value, Kokkos::HostSpace> join(&mine);
    if (groupbit == Foam::GROUP_ALL)
      loop(Functor::NAME, n, functor, join);
    else
      loop(Functor::NAME, n, FoamReduceBubbles<Functor, Value>{functor, members(groupbit)}, join);
    return mine;
  }
  template <class Totals, class Functor> Totals totals(int n, const Functor &functor) const
  {
    return reduce<Totals>(n, functor);
  }

  // Sums over all ranks. Those of a single rank with a device stay there.

  template <class Totals, class Functor>
  Foam::Sums<Totals> sums(int n, const Functor &functor) const
  {
    int nprocs;
    MPI_Comm_size(world, &nprocs);
    if (nprocs > 1) return {foam_sum(reduce<Totals>(n, functor), world)};
    const Foam::Sums<Totals> mine = own_sums<Totals>(n, functor);
    return mine.on_device ? mine : Foam::Sums<Totals>{foam_sum(mine.known, world)};
  }

  // of this rank: those of a device stay there

  template <class Totals, class Functor>
  Foam::Sums<Totals> own_sums(int n, const Functor &functor) const
  {
    if (ON_HOST) return {reduce<Totals>(n, functor)};
    static_assert(SLOT_SIZE * Totals::SLOT * sizeof(double) + sizeof(Totals) <=
                  SLOTS * SLOT_SIZE * sizeof(double));
    auto *const there = reinterpret_cast<Totals *>(sums_there.data() + SLOT_SIZE * Totals::SLOT);
    Kokkos::parallel_reduce(Functor::NAME, Kokkos::RangePolicy<DeviceType>(0, n),
                            FoamReduceBubbles<Functor, Totals>{functor, members(groupbit)},
                            FoamJoin<Totals, typename DeviceType::memory_space>(there));
    return {{}, there};
  }
  template <class Totals> static bool reads(const Foam::Sums<Totals> &)
  {
    return true;
  }
  template <class Totals> static Totals fetch(const Totals *there)
  {
    using Here = Kokkos::View<Totals, Kokkos::HostSpace, Kokkos::MemoryUnmanaged>;
    using There =
        Kokkos::View<const Totals, typename DeviceType::memory_space, Kokkos::MemoryUnmanaged>;
    Totals all;
    Kokkos::deep_copy(Here(&all), There(there));
    return all;
  }

  FoamColumns *residuals = nullptr;    // see FoamKokkosBubbles; of an integrator
  int groupbit = Foam::GROUP_ALL;      // of the bubbles

 private:
  // On the host over slices, one of each thread. n: bubbles, or chunks of them

  template <class Functor> static void loop(const char *name, int n, const Functor &functor)
  {
    using Range = Kokkos::RangePolicy<DeviceType>;
    if constexpr (ON_HOST) {
      const int threads = slices(n), slice = threads > 0 ? (n + threads - 1) / threads : 0;
      Kokkos::parallel_for(name, Range(0, threads), FoamSlices<Functor, int>{functor, n, slice});
    } else
      Kokkos::parallel_for(name, Range(0, n), functor);
  }
  template <class Functor, class Join>
  static void loop(const char *name, int n, const Functor &functor, const Join &join)
  {
    using Range = Kokkos::RangePolicy<DeviceType>;
    if constexpr (ON_HOST) {
      const int threads = slices(n), slice = threads > 0 ? (n + threads - 1) / threads : 0;
      Kokkos::parallel_reduce(name, Range(0, threads),
                              FoamSlices<Functor, typename Join::value_type>{functor, n, slice},
                              join);
    } else
      Kokkos::parallel_reduce(name, Range(0, n), functor, join);
  }
  static int slices(int n)
  {
    const int threads = DeviceType().concurrency();
    return n < threads ? n : threads;
  }

  uint64_t written;
  static constexpr int SLOTS = 2, SLOT_SIZE = 4;
  Kokkos::View<double[SLOTS * SLOT_SIZE], DeviceType> sums_there;
};

}    // namespace LAMMPS_NS

#endif
