// A plain knit of one yarn (Fig. 15 and 16): pulled apart at its two edges across the wales, or twisted between them.
#pragma once

#include <cstdint>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// The paper's sizes by default.
struct YarnSizes {
  compare::Index rows = 40, loops = 33;  ///< rows of so many loops
  std::int64_t rest_steps = 1250;        ///< of yarn_stretch, before it is pulled: 0.5 s
  std::int64_t steps = 16250;            ///< of the run
  double pull = 0.25;                    ///< of yarn_stretch: speed of each edge [m/s]
  double turns = 5;                      ///< of yarn_twist
};

/// Horizontal, gravity along −y: at rest, then both edges apart.
compare::Scene yarn_stretch(const YarnSizes& sizes = {});

/// Vertical, its upper edge held, the lower one turned about the vertical at π rad/s, then held.
compare::Scene yarn_twist(const YarnSizes& sizes = {.steps = 27500});

}  // namespace ogc::experiments
