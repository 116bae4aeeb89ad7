// Fig. 11 and 1: a long strip, threaded four times through an overhand knot and through its own ends, pulled tight.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's. The contact radius follows the spacing across the strip.
struct KnotSizes {
  compare::Index rows = 2400;     ///< vertices along the strip
  compare::Index columns = 20;    ///< vertices across it
  std::int64_t hold_steps = 150;  ///< 0.5 s in which the end rows rest before they are pulled
  std::int64_t steps = 10650;     ///< the hold and 35 s
};

/// Returns the scene: a strip of 961.3 cm × 4.5 cm (rest shape: flat, in the xz plane), laid along a centripetal
/// Catmull–Rom curve with its rows at equal distances on it. No gravity; the first and last row move at ∓0.10 m/s along
/// x. The start is stretched up to 7.5 times at the outer edge and free of intersections at the registered sizes; its
/// smallest gap is 0.51 mm at the paper's size.
compare::Scene knot(const KnotSizes& sizes = {});

}  // namespace ogc::experiments
