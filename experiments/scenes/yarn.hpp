// Fig. 15 and 16: a plain knit of one yarn is pulled apart along its wales (columns of loops), or twisted about their
// direction.
#pragma once

#include <cstdint>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's.
struct YarnSizes {
  compare::Index rows = 40, loops = 33;  ///< number of rows, and of loops in each row
  std::int64_t rest_steps = 1250;        ///< yarn_stretch: steps before the pull, 0.5 s
  std::int64_t steps = 16250;            ///< steps of the run
  double pull = 0.25;                    ///< yarn_stretch: speed of each edge [m/s]
  double turns = 5;                      ///< yarn_twist: revolutions of the lower edge
};

/// Returns the pulled knit. It lies horizontally, with gravity along −y, and is first at rest. Then both edges are
/// pulled apart.
compare::Scene yarn_stretch(const YarnSizes& sizes = {});

/// Returns the twisted knit. It hangs vertically with its upper edge held. Its lower edge rotates about the vertical at
/// π rad/s for `turns` turns and is then held.
compare::Scene yarn_twist(const YarnSizes& sizes = {.steps = 27500});

}  // namespace ogc::experiments
