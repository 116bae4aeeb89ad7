// The sum of a vertex in packs, compiled for several machines and chosen at run time, to the same bits.
#pragma once

#include "fast/kernels/contacts/frozen.hpp"
#include "fast/kernels/rods/sweep.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// A part of so many items that was computed one by one: the sums of all team lanes; null: none.
struct TeamLaneSums {
  const ForceAndBlock* sums = nullptr;  ///< by team lane, W of them
  int count = 0;                        ///< items of the part; where they are fewer than W the last sums are 0
};

/// Parts that are not computed in packs: triangles and hinges where they have sums here, springs, volumes, and
/// tetrahedra where they have.
struct OtherParts {
  /// null sums: packs compute the part, or there is none
  TeamLaneSums triangles, hinges, springs, tetrahedra, volumes;
};

/// As GatherDefault with a SerialTeam and, between hinges and contacts, springs, tetrahedra and volumes; or as
/// GatherSolids.
using GatherInPacks = ForceAndBlock (*)(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                        const OtherParts& other);
/// One function for each number W of team lanes.
struct GatherByLanes {
  GatherInPacks gather_4, gather_8, gather_16, gather_32;  ///< for W = 4, 8, 16, 32

  /// That of W.
  template <int W>
  GatherInPacks gather() const {
    static_assert(W >= 4);
    return W == 4 ? gather_4 : (W == 8 ? gather_8 : (W == 16 ? gather_16 : gather_32));
  }
};
/// Of scenes with surfaces, the second with weights of the iteration, and of those whose free vertices all belong to
/// solids; and of rods.
struct PackKernels {
  GatherByLanes surfaces, frozen_surfaces, solids;  ///< as GatherDefault, as GatherFrozenSurfaces, as GatherSolids
  /// As f for its items begin … end − 1.
  void (*update_segments)(const UpdateSegment& f, int begin, int end);
};

/// Compiled without and with AVX2. Where has_avx2() is false the latter must not be called.
extern const PackKernels pack_kernels_baseline, pack_kernels_avx2;

/// Whether this machine can run those for AVX2.
bool has_avx2();
/// The fastest that this machine can run.
const PackKernels& pack_kernels();

/// The segments of a loop that one thread runs.
inline void run_range(const UpdateSegment& f, int begin, int end) { pack_kernels().update_segments(f, begin, end); }

/// Sums of all team lanes of a part that is computed item by item.
template <class AnyPart, int W>
TeamLaneSums one_by_one(const AnyPart& part, ForceAndBlock (&sums)[W]) {
  for (int k = 0; k < part.count; ++k) add_item(part, load_item(part, k), sums[k % W]);
  return {sums, part.count};
}

/// As `Gather`, whose sums in packs are that member of PackKernels.
template <class Gather, GatherByLanes PackKernels::*in_packs>
struct GatherPackedSurfaces {
  static constexpr int parts = Gather::parts;   ///< of the sum; devices alone read it
  const PackKernels& kernels = pack_kernels();  ///< those of this machine

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W < 4)
      return Gather{}(view, slot, vertex, own, team);
    else
      return (kernels.*in_packs).template gather<W>()(view, slot, vertex, own, {});
  }
};
using GatherPacked = GatherPackedSurfaces<GatherDefault, &PackKernels::surfaces>;
using GatherPackedFrozen = GatherPackedSurfaces<GatherFrozenSurfaces, &PackKernels::frozen_surfaces>;

/// As GatherSolids: in packs but for tetrahedra that damp, which are computed one by one.
struct GatherPackedSolids {
  static constexpr int parts = GatherSolids::parts;  ///< of the sum; devices alone read it
  const PackKernels& kernels = pack_kernels();       ///< those of this machine

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W < 4) {
      return GatherSolids{}(view, slot, vertex, own, team);
    } else {
      const SolidMaterial material = view.solids[vertex.body];
      OtherParts other;
      ForceAndBlock damped[W];
      if (material.damping > 0)
        other.tetrahedra = one_by_one(tetrahedron_part(view, slot, AddTetrahedron{view, material, own}), damped);
      return kernels.solids.template gather<W>()(view, slot, vertex, own, other);
    }
  }
};

/// As GatherEveryModel, or as those with more: in packs but for springs, tetrahedra, volumes, and triangles and hinges
/// of bodies with other models than the default ones, which are computed one by one; as there with other activations.
template <class Gather>
struct GatherPackedModels {
  static constexpr int parts = Gather::parts;  ///< of the sum; devices alone read it
  /// whether tetrahedra are a part, and volumes
  static constexpr bool has_solids = std::is_same_v<Gather, GatherEverything> ||
                                     std::is_same_v<Gather, GatherEverythingAndVolumes>,
                        has_volumes = std::is_same_v<Gather, GatherVolumes> ||
                                      std::is_same_v<Gather, GatherEverythingAndVolumes>;
  const PackKernels& kernels = pack_kernels();  ///< those of this machine

  /// As Gather has it, where it has volumes.
  static bool lies_deep(const SweepView& view, int slot, const Vec& x) requires gathers_volumes<Gather> {
    return Gather::lies_deep(view, slot, x);
  }

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W >= 4) {
      if (view.activation == ContactActivation::ogc) return in_packs<W>(view, slot, vertex, own);
    }
    return Gather{}(view, slot, vertex, own, team);
  }

 private:
  template <int W>
  ForceAndBlock in_packs(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own) const {
    const SurfaceModels models = view.models[vertex.body];
    const SurfaceMaterial material = view.materials[vertex.body];
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    ForceAndBlock triangles[W], hinges[W], springs[W], tetrahedra[W], volumes[W];
    OtherParts other;
    if (!has_default_membrane(models)) {
      const auto add = [&](int i, ForceAndBlock& sum) {
        add_any_membrane(view, view.membrane[i], material, models, at, sum);
      };
      other.triangles = one_by_one(part(
                                       vertex.membrane_count, [&](int k) { return vertex.membrane_begin + k; }, add),
                                   triangles);
    }
    if (!has_default_bending(models)) {
      const auto add = [&](int i, ForceAndBlock& sum) {
        add_any_hinge(view, view.hinges[i], view.isometric != nullptr ? view.isometric[i] : IsometricStencil{},
                      material, models, at, sum);
      };
      other.hinges = one_by_one(part(
                                    vertex.hinge_count, [&](int k) { return vertex.hinge_begin + k; }, add),
                                hinges);
    }
    other.springs = one_by_one(spring_part(view, slot, models, at), springs);
    if constexpr (has_solids) {
      const AddAnyTetrahedron add{view, view.solids[vertex.body], models, at};
      other.tetrahedra = one_by_one(tetrahedron_part(view, slot, add), tetrahedra);
    }
    if constexpr (has_volumes) other.volumes = one_by_one(volume_part(view, slot, vertex.vertex, own), volumes);
    return kernels.surfaces.template gather<W>()(view, slot, vertex, own, other);
  }
};
using GatherPackedEveryModel = GatherPackedModels<GatherEveryModel>;
using GatherPackedEverything = GatherPackedModels<GatherEverything>;
using GatherPackedVolumes = GatherPackedModels<GatherVolumes>;
using GatherPackedEverythingAndVolumes = GatherPackedModels<GatherEverythingAndVolumes>;

}  // namespace ogc::fast
