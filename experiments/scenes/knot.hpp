// Fig. 11 and 1: a long strip, threaded four times through an overhand knot and through its own ends, pulled tight.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Defaults: the paper's. The contact radius follows the spacing across the strip.
struct KnotSizes {
  compare::Index rows = 2400;     ///< vertices along the strip
  compare::Index columns = 20;    ///< vertices across it
  std::int64_t hold_steps = 150;  ///< 0.5 s in which the end rows rest, before they are pulled
  std::int64_t steps = 10650;     ///< the hold and 35 s
};

/// A strip of 961.3 cm × 4.5 cm (rest shape: flat, in the xz plane), laid along a centripetal Catmull–Rom curve with
/// rows equally far apart on it. No gravity; the first and last row move at ∓0.10 m/s along x. The start is stretched
/// up to 7.5 times at the outer edge and free of intersections at the sizes that are registered; its smallest gap is
/// 0.51 mm in the paper's.
compare::Scene knot(const KnotSizes& sizes = {});

}  // namespace ogc::experiments
