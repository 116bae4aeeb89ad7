// Lists the compiled sums over the stencils of a vertex, and chooses the sum of a scene.
#pragma once

#include <cstddef>
#include <tuple>

#include "fast/kernels/sweep/gather.hpp"

namespace ogc::fast {

/// Lists sums, from the most special one to one that gives everything.
template <class... Sums>
struct SumList {
  static constexpr int count = sizeof...(Sums);
  /// The sum with this number.
  template <std::size_t number>
  using At = std::tuple_element_t<number, std::tuple<Sums...>>;

  /// Returns the number of the first sum that gives all features in `asked`; `count` if there is none.
  static constexpr int first_that_gives(unsigned asked) {
    int number = 0, found = count;
    ((found = found == count && (asked & ~Sums::gives) == 0 ? number : found, ++number), ...);
    return found;
  }
  /// Calls use(the sum with this number).
  template <class Use>
  static void with(int number, const Use& use) {
    int next = 0;
    ((next++ == number ? use(Sums{}) : void()), ...);
  }
};

/// The sums of scenes with only surfaces of default models, and of scenes with only solids.
using GatherSurfaces = Gather<OgcActivation, UsualTriangles, UsualHinges>;
using GatherSolids = Gather<OgcActivation, UsualTetrahedra>;

/// The sums of a device. Parts that a scene lacks cost registers and a warp of each block there, so each special sum
/// makes some scene at least 5 % faster (fast/PERFORMANCE.md, Sums).
using DeviceSums = SumList<GatherSurfaces, Gather<OgcActivation, UsualTriangles, UsualHinges, Springs, VolumeContacts>,
                           GatherSolids, Gather<OgcActivation, Springs, UsualSegments>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts>, GatherAll>;
/// The sums of the host, whose packs omit the parts that a vertex lacks.
using HostSums = SumList<GatherAll>;

}  // namespace ogc::fast
