// Declares the sum over a vertex's stencils in packs. It is compiled for several machines and chosen at run time; all
// versions give the same bits.
#pragma once

#include <cstddef>
#include <new>

#include "fast/kernels/sweep/gather.hpp"
#include "fast/kernels/sweep/update_segment.hpp"

namespace ogc::fast {

/// The sums of a part that was computed item by item, one sum for each team lane; null if there are none.
struct TeamLaneSums {
  const ForceAndBlock* sums = nullptr;  ///< by team lane, W of them
  int count = 0;                        ///< items of the part; if there are fewer than W, the last sums are 0
};

/// Tells whether packs can compute a part of a sum (fast/kernels/kinds), at vertices where the part's `is_packed`
/// returns true.
template <class Part>
inline constexpr bool has_packs = requires(const SweepView& view, const SweepVertex& vertex) {
  Part::is_packed(view, vertex);
};

/// Computes the sum of GatherAll with a SerialTeam and the activation `ogc`. `alone` has one element for each part. The
/// sums of an element are null if packs compute the part, or if the vertex has no items of the part.
using GatherInPacks = ForceAndBlock (*)(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                        const TeamLaneSums* alone);
/// The kernels that run in packs: sums of vertices, and updates of rods' segments.
struct PackKernels {
  GatherInPacks gather_4, gather_8, gather_16;  ///< for W = 4, 8, 16 team lanes
  /// Updates segments begin … end − 1 as f(i) would.
  void (*update_segments)(const UpdateSegment& f, int begin, int end);

  /// Returns the kernel for W team lanes.
  template <int W>
  GatherInPacks gather() const {
    static_assert(W == 4 || W == 8 || W == 16);
    return W == 4 ? gather_4 : (W == 8 ? gather_8 : gather_16);
  }
};

/// The kernels compiled without and with AVX2. pack_kernels_avx2 must not be called if has_avx2() is false.
extern const PackKernels pack_kernels_baseline, pack_kernels_avx2;

/// Returns whether this machine can run pack_kernels_avx2.
bool has_avx2();
/// Returns the fastest kernels that this machine can run.
const PackKernels& pack_kernels();

/// Updates segments begin … end − 1 of a loop in this thread.
inline void run_range(const UpdateSegment& f, int begin, int end) { pack_kernels().update_segments(f, begin, end); }

/// Computes the same sum as Gather<AnyActivation, Parts...>. If the activation is `ogc` and W ≥ 4, parts that packs can
/// compute (has_packs) are computed in packs. All other parts are computed item by item.
template <class All>
struct PackedGather;
template <class... Parts>
struct PackedGather<Gather<AnyActivation, Parts...>> {
  using All = Gather<AnyActivation, Parts...>;
  static constexpr int parts = All::parts;  ///< parts of the sum; only devices read it
  static constexpr bool has_volumes = All::has_volumes;
  const PackKernels& kernels = pack_kernels();  ///< kernels of this machine

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W >= 4) {
      if (view.activation == ContactActivation::ogc) return in_packs<W>(view, slot, vertex, own);
    }
    return All{}(view, slot, vertex, own, team);
  }

 private:
  /// Memory for the sums of a part; the sums are constructed only if the part is computed item by item.
  template <int W>
  struct Room {
    alignas(ForceAndBlock) std::byte bytes[W * sizeof(ForceAndBlock)];

    /// Computes a part item by item. Returns the sums of all team lanes.
    template <class AnyPart>
    TeamLaneSums one_by_one(const AnyPart& part) {
      if (part.count == 0) return {};
      auto* const sums = new (bytes) ForceAndBlock[W];
      for (int k = 0; k < part.count; ++k) add_item(part, load_item(part, k), sums[k % W]);
      return {sums, part.count};
    }
  };

  template <int W, class Part>
  static TeamLaneSums alone(const SweepView& view, int slot, const SweepVertex& vertex, const OwnVertex& own,
                            Room<W>& room) {
    if constexpr (has_packs<Part>) {
      if (Part::is_packed(view, vertex)) return {};
    }
    return room.one_by_one(Part::part_of(view, slot, vertex, own));
  }

  template <int W>
  ForceAndBlock in_packs(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own) const {
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    Room<W> rooms[sizeof...(Parts)];
    Room<W>* room = rooms;
    const TeamLaneSums sums[] = {alone<W, Parts>(view, slot, vertex, at, *room++)...};
    return kernels.gather<W>()(view, slot, vertex, own, sums);
  }
};
/// The sum over a vertex's stencils for any scene, in packs.
using GatherPacked = PackedGather<GatherAll>;

}  // namespace ogc::fast
