// A plain knit of one yarn (Fig. 15 and 16) is pulled apart at its two edges across the wales, or twisted between them.
#pragma once

#include <cstdint>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's.
struct YarnSizes {
  compare::Index rows = 40, loops = 33;  ///< rows, and loops in each of them
  std::int64_t rest_steps = 1250;        ///< of yarn_stretch, before the pull: 0.5 s
  std::int64_t steps = 16250;            ///< of the run
  double pull = 0.25;                    ///< of yarn_stretch: speed of each edge [m/s]
  double turns = 5;                      ///< of yarn_twist
};

/// Returns the pulled knit: it lies horizontally, gravity along −y, first at rest; then both edges are pulled apart.
compare::Scene yarn_stretch(const YarnSizes& sizes = {});

/// Returns the twisted knit: it hangs vertically, its upper edge is held; the lower one turns about the vertical at π
/// rad/s and is then held.
compare::Scene yarn_twist(const YarnSizes& sizes = {.steps = 27500});

}  // namespace ogc::experiments
