// The sum of a vertex in packs, compiled for several machines and chosen at run time, to the same bits.
#pragma once

#include <cstddef>
#include <new>

#include "fast/kernels/sweep/gather.hpp"
#include "fast/kernels/sweep/update_segment.hpp"

namespace ogc::fast {

/// A part of so many items that was computed one by one: the sums of all team lanes; null: none.
struct TeamLaneSums {
  const ForceAndBlock* sums = nullptr;  ///< by team lane, W of them
  int count = 0;                        ///< items of the part; where they are fewer than W the last sums are 0
};

/// Parts that are not computed in packs. Null sums: packs compute the part, or there is none.
struct OtherParts {
  TeamLaneSums triangles, hinges, springs, tetrahedra, volumes, segments;
};

/// As GatherAll with a SerialTeam and the activation `ogc`.
using GatherInPacks = ForceAndBlock (*)(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                        const OtherParts& other);
/// Sums of vertices, and segments of rods.
struct PackKernels {
  GatherInPacks gather_4, gather_8, gather_16;  ///< for W = 4, 8, 16 team lanes
  /// As f for its items begin … end − 1.
  void (*update_segments)(const UpdateSegment& f, int begin, int end);

  /// That of W.
  template <int W>
  GatherInPacks gather() const {
    static_assert(W == 4 || W == 8 || W == 16);
    return W == 4 ? gather_4 : (W == 8 ? gather_8 : gather_16);
  }
};

/// Compiled without and with AVX2. Where has_avx2() is false the latter must not be called.
extern const PackKernels pack_kernels_baseline, pack_kernels_avx2;

/// Whether this machine can run those for AVX2.
bool has_avx2();
/// The fastest that this machine can run.
const PackKernels& pack_kernels();

/// The segments of a loop that one thread runs.
inline void run_range(const UpdateSegment& f, int begin, int end) { pack_kernels().update_segments(f, begin, end); }

/// As GatherAll: in packs where there are any of a part's models, the other parts item by item; with other activations
/// all of it.
struct GatherPacked {
  static constexpr int parts = GatherAll::parts;  ///< of the sum; devices alone read it
  static constexpr bool has_volumes = GatherAll::has_volumes;
  const PackKernels& kernels = pack_kernels();  ///< those of this machine

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W >= 4) {
      if (view.activation == ContactActivation::ogc) return in_packs<W>(view, slot, vertex, own);
    }
    return GatherAll{}(view, slot, vertex, own, team);
  }

 private:
  /// Room for the sums of a part, none of which is there before it is needed.
  template <int W>
  struct Room {
    alignas(ForceAndBlock) std::byte bytes[W * sizeof(ForceAndBlock)];

    /// Sums of all team lanes of a part that is computed item by item.
    template <class AnyPart>
    TeamLaneSums one_by_one(const AnyPart& part) {
      if (part.count == 0) return {};
      auto* const sums = new (bytes) ForceAndBlock[W];
      for (int k = 0; k < part.count; ++k) add_item(part, load_item(part, k), sums[k % W]);
      return {sums, part.count};
    }
  };

  template <int W>
  ForceAndBlock in_packs(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own) const {
    const SurfaceModels models = view.models[vertex.body];
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    Room<W> triangles, hinges, springs, tetrahedra, volumes, segments;
    OtherParts other;
    if (!has_default_membrane(models))
      other.triangles = triangles.one_by_one(Triangles::part_of(view, slot, vertex, at));
    if (!has_default_bending(models)) other.hinges = hinges.one_by_one(Hinges::part_of(view, slot, vertex, at));
    other.springs = springs.one_by_one(Springs::part_of(view, slot, vertex, at));
    const bool has_tetrahedra = view.tetrahedron_rows != nullptr;
    if (has_tetrahedra && (view.solids[vertex.body].damping > 0 || !damps_strain(models.damping)))
      other.tetrahedra = tetrahedra.one_by_one(Tetrahedra::part_of(view, slot, vertex, at));
    other.volumes = volumes.one_by_one(VolumeContacts::part_of(view, slot, vertex, at));
    other.segments = segments.one_by_one(Segments::part_of(view, slot, vertex, at));
    return kernels.gather<W>()(view, slot, vertex, own, other);
  }
};

}  // namespace ogc::fast
