// Fig. 11 and 1: a long strip with four overhand knots and coiled ends is pulled tight.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's. The contact radius is proportional to the spacing across the strip.
struct KnotSizes {
  compare::Index rows = 2400;     ///< vertices along the strip
  compare::Index columns = 20;    ///< vertices across the strip
  std::int64_t hold_steps = 150;  ///< 0.5 s in which the end rows rest before they are pulled
  std::int64_t steps = 10650;     ///< the hold and 35 s of pulling
};

/// Returns the scene: a strip of 961.3 cm × 4.5 cm along a centripetal Catmull–Rom curve, with rows at equal distances.
/// The rest shape is flat in the xz plane. There is no gravity; the first and last row move at ∓0.10 m/s along x. At
/// the registered sizes the start has no intersections, although the strip's outer edge is stretched up to 7.5 times.
/// At the paper's size the smallest gap at the start is 0.51 mm.
compare::Scene knot(const KnotSizes& sizes = {});

}  // namespace ogc::experiments
