// The sum of a vertex in packs, compiled for several machines and chosen at run time, to the same bits.
#pragma once

#include "fast/kernels/sweep_models.hpp"

namespace ogc::fast {

/// Of a part that was computed one by one the sums of the first `count` lanes; those behind up to a whole pack are zero.
struct LaneSums {
  const ForceAndBlock* lane = nullptr;
  int count = 0;
};

/// As GatherDefault with a SerialTeam of so many lanes and, between hinges and contacts, the springs.
using GatherInPacks = ForceAndBlock (*)(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const LaneSums& springs);
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

/// As GatherEveryModel: in packs for vertices of bodies with default models, springs one by one; as there for all others.
struct GatherPackedEveryModel {
  static constexpr int parts = GatherEveryModel::parts;
  const PackKernels& kernels = pack_kernels();

  template <int W>
  ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own, const SerialTeam<W>& team) const {
    const SurfaceModels models = view.models[vertex.body];
    if constexpr (W >= 4) {
      if (are_default(models) && view.activation == ContactActivation::ogc) {
        const auto springs = spring_part(view, slot, models, {own, own - view.start[vertex.vertex]});
        ForceAndBlock lane[W];
        for (int k = 0; k < springs.count; ++k) add_item(springs, load_item(springs, k), lane[k % W]);
        return kernels.template gather<W>()(view, slot, vertex, own, {lane, springs.count});
      }
    }
    return GatherEveryModel{}(view, slot, vertex, own, team);
  }
};

}  // namespace ogc::fast
