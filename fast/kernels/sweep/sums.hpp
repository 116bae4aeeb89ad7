// Lists the compiled sums over the stencils of a vertex, and chooses the sum of a scene.
#pragma once

#include <cstddef>
#include <tuple>

#include "fast/kernels/sweep/gather.hpp"

namespace ogc::fast {

/// Lists sums from the most special one to the most general one.
template <class... Sums>
struct SumList {
  static constexpr int count = sizeof...(Sums);
  /// The sum with this index in the list.
  template <std::size_t number>
  using At = std::tuple_element_t<number, std::tuple<Sums...>>;

  /// Returns the index of the first sum that computes all features in `asked`; `count` if no sum does.
  static constexpr int first_that_gives(unsigned asked) {
    int number = 0, found = count;
    ((found = found == count && (asked & ~Sums::gives) == 0 ? number : found, ++number), ...);
    return found;
  }
  /// Calls use(sum) with the sum that has the index `number`.
  template <class Use>
  static void with(int number, const Use& use) {
    int next = 0;
    ((next++ == number ? use(Sums{}) : void()), ...);
  }
};

/// The sums for scenes with only surfaces of the default models, with only surfaces that bend by another model, with
/// only solids.
using GatherSurfaces = Gather<OgcActivation, UsualTriangles, UsualHinges>;
using GatherBentSurfaces = Gather<OgcActivation, UsualTriangles, Hinges>;
using GatherSolids = Gather<OgcActivation, UsualTetrahedra>;

/// Sums that are compiled for a device. There are several, because each part that a scene does not need costs registers
/// and one warp per block. Each special sum makes some scene at least 5 % faster (fast/PERFORMANCE.md, Sums).
using DeviceSums = SumList<GatherSurfaces, GatherBentSurfaces,
                           Gather<OgcActivation, UsualTriangles, UsualHinges, Springs, VolumeContacts>, GatherSolids,
                           Gather<OgcActivation, Springs, UsualSegments>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts>, GatherAll>;
/// Sums that are compiled for the host. One sum suffices, because the host skips the kinds of elements that a vertex
/// does not have.
using HostSums = SumList<GatherAll>;

}  // namespace ogc::fast
