// The sum of a vertex in packs, compiled for several machines and chosen at run time, to the same bits.
#pragma once

#include "fast/kernels/sweep_models.hpp"

namespace ogc::fast {

/// A part of so many items that was computed one by one: the sums of all team lanes; null: none.
struct TeamLaneSums {
  const ForceAndBlock* sums = nullptr;
  int count = 0;
};

/// Parts that are not computed in packs: triangles and hinges where they have sums here, and springs.
struct OtherParts {
  TeamLaneSums triangles, hinges, springs;
};

/// As GatherDefault with a SerialTeam and, between hinges and contacts, springs.
using GatherInPacks = ForceAndBlock (*)(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                        const OtherParts& other);
/// One function for each number W of team lanes.
struct PackKernels {
  GatherInPacks gather_4, gather_8, gather_16, gather_32;

  /// That of W.
  template <int W>
  GatherInPacks gather() const {
    static_assert(W >= 4);
    return W == 4 ? gather_4 : (W == 8 ? gather_8 : (W == 16 ? gather_16 : gather_32));
  }
};

extern const PackKernels pack_kernels_baseline, pack_kernels_avx2;

/// Whether this machine can run those for AVX2.
bool has_avx2();
/// The fastest that this machine can run.
const PackKernels& pack_kernels();

/// As GatherDefault.
struct GatherPacked {
  static constexpr int parts = GatherDefault::parts;
  const PackKernels& kernels = pack_kernels();

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W < 4)
      return GatherDefault{}(view, slot, vertex, own, team);
    else
      return kernels.template gather<W>()(view, slot, vertex, own, {});
  }
};

/// As GatherEveryModel: in packs but for springs and for triangles and hinges of bodies with other models than the
/// default ones, which are computed one by one; as there with other activations.
struct GatherPackedEveryModel {
  static constexpr int parts = GatherEveryModel::parts;
  const PackKernels& kernels = pack_kernels();

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                           const SerialTeam<W>& team) const {
    if constexpr (W >= 4) {
      if (view.activation == ContactActivation::ogc) {
        const SurfaceModels models = view.models[vertex.body];
        const SurfaceMaterial material = view.materials[vertex.body];
        const OwnVertex at{own, own - view.start[vertex.vertex]};
        ForceAndBlock triangles[W], hinges[W], springs[W];
        OtherParts other;
        if (!has_default_membrane(models)) {
          const auto add = [&](int i, ForceAndBlock& sum) {
            add_any_membrane(view, view.membrane[i], material, models, at, sum);
          };
          other.triangles = one_by_one(
              part(
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
        return kernels.template gather<W>()(view, slot, vertex, own, other);
      }
    }
    return GatherEveryModel{}(view, slot, vertex, own, team);
  }

 private:
  template <class AnyPart, int W>
  static TeamLaneSums one_by_one(const AnyPart& part, ForceAndBlock (&sums)[W]) {
    for (int k = 0; k < part.count; ++k) add_item(part, load_item(part, k), sums[k % W]);
    return {sums, part.count};
  }
};

}  // namespace ogc::fast
