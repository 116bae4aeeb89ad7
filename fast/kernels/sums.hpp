// Which sums over the stencils of a vertex are compiled, and which of them a scene takes.
#pragma once

#include "fast/kernels/gather.hpp"

namespace ogc::fast {

/// Sums from the most special one to one that gives everything.
template <class... Sums>
struct SumList {
  static constexpr int count = sizeof...(Sums);

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

/// Of scenes of surfaces with the usual models, of solids and of rods, each alone.
using GatherSurfaces = Gather<OgcActivation, UsualTriangles, UsualHinges>;
using GatherSolids = Gather<OgcActivation, UsualTetrahedra>;
using GatherRods = Gather<OgcActivation, UsualSegments>;

/// On a device.
using DeviceSums = SumList<GatherSurfaces, Gather<AnyActivation, Triangles, Hinges, Springs>, GatherSolids,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, VolumeContacts>,
                           Gather<AnyActivation, Triangles, Hinges, Springs, Tetrahedra, VolumeContacts>, GatherRods,
                           Gather<OgcActivation, Springs, UsualSegments>, GatherAll>;
/// On the host, whose packs leave out what a vertex does not have.
using HostSums = SumList<GatherAll>;

}  // namespace ogc::fast
