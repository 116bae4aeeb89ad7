// Which sums over the stencils of a vertex are compiled, and which of them a scene takes.
#pragma once

#include <cstddef>
#include <tuple>

#include "fast/kernels/sweep/gather.hpp"

namespace ogc::fast {

/// Sums from the most special one to one that gives everything.
template <class... Sums>
struct SumList {
  static constexpr int count = sizeof...(Sums);
  /// The sum of this number.
  template <std::size_t number>
  using At = std::tuple_element_t<number, std::tuple<Sums...>>;

  /// The first that gives all that is asked.
  static constexpr int first_that_gives(unsigned asked) {
    int number = 0, found = count;
    ((found = found == count && (asked & ~Sums::gives) == 0 ? number : found, ++number), ...);
    return found;
  }
  /// use(the sum of this number).
  template <class Use>
  static void with(int number, const Use& use) {
    int next = 0;
    ((next++ == number ? use(Sums{}) : void()), ...);
  }
};

/// The sums of scenes that have surfaces with the usual models alone, or solids alone.
using GatherSurfaces = Gather<OgcActivation, UsualTriangles, UsualHinges>;
using GatherSolids = Gather<OgcActivation, UsualTetrahedra>;

/// The sums of a device. There a part that a scene lacks costs registers and a warp of each block, so that a scene must
/// gain 5 % by each of them (fast/PERFORMANCE.md, Sums).
using DeviceSums = SumList<GatherSurfaces, Gather<OgcActivation, UsualTriangles, UsualHinges, Springs, VolumeContacts>,
                           GatherSolids, Gather<OgcActivation, Springs, UsualSegments>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts>, GatherAll>;
/// The sums of the host, whose packs leave out what a vertex does not have.
using HostSums = SumList<GatherAll>;

}  // namespace ogc::fast
