// The sum of a vertex in packs, compiled for several machines and chosen at run time, to the same bits.
#pragma once

#include "fast/kernels/sweep_models.hpp"

namespace ogc::fast {

/// Of a part that was computed one by one the sums of the first `count` lanes; those behind up to a whole pack are zero.
struct LaneSums {
  const ForceAndBlock* lane = nullptr;
  int count = 0;
};

/// Parts that are not computed in packs.
struct OtherParts {
  bool has_triangles = false;  ///< in place of those of GatherDefault
  LaneSums triangles, springs;
};

/// As GatherDefault with a SerialTeam of so many lanes and, between hinges and contacts, springs.
using GatherInPacks = ForceAndBlock (*)(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const OtherParts& other);
struct PackKernels {
  GatherInPacks gather_4, gather_8, gather_16, gather_32;

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
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const SerialTeam<W>& team) const {
    if constexpr (W < 4) return GatherDefault{}(view, slot, vertex, own, team);
    else return kernels.template gather<W>()(view, slot, vertex, own, {});
  }
};

/// As GatherEveryModel: in packs but for springs and stable Neo-Hookean triangles, which are computed one by one; as there for vertices of bodies with isometric bending
/// or damping by vertex, and for other activations.
struct GatherPackedEveryModel {
  static constexpr int parts = GatherEveryModel::parts;
  const PackKernels& kernels = pack_kernels();

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const SerialTeam<W>& team) const {
    const SurfaceModels models = view.models[vertex.body];
    const bool in_packs = view.activation == ContactActivation::ogc && models.damping == compare::DampingForm::strain &&
                          models.bending != compare::BendingModel::isometric_quadratic;
    if constexpr (W >= 4) {
      if (in_packs) {
        const OwnVertex at{own, own - view.start[vertex.vertex]};
        OtherParts other;
        ForceAndBlock triangles[W], springs[W];
        other.springs = one_by_one(spring_part(view, slot, models, at), springs);
        if (models.membrane == compare::MembraneModel::stable_neo_hookean) {
          const SurfaceMaterial material = view.materials[vertex.body];
          other.has_triangles = true;
          other.triangles = one_by_one(part(vertex.membrane_count, [&](int k) { return view.membrane[vertex.membrane_begin + k]; },
                                            [&](const MembraneIncidence& membrane, ForceAndBlock& sum) { add_any_membrane(view, membrane, material, models, at, sum); }),
                                       triangles);
        }
        return kernels.template gather<W>()(view, slot, vertex, own, other);
      }
    }
    return GatherEveryModel{}(view, slot, vertex, own, team);
  }

 private:
  template <class Part, int W>
  static LaneSums one_by_one(const Part& part, ForceAndBlock (&lane)[W]) {
    for (int k = 0; k < part.count; ++k) add_item(part, load_item(part, k), lane[k % W]);
    return {lane, part.count};
  }
};

}  // namespace ogc::fast
