// Fig. 19: a thin solid mat twisted by its two ends.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: the paper's, as far as the paper gives them. Thickness and contact radius are
/// proportional to the spacing along x: 8.333 mm and 2 mm on 88 × 87.
struct MatTwistSizes {
  /// number of vertices along x (the axis of the twist) and along z; along y, through the thickness, there are two
  compare::Index along = 88, across = 87;
  std::int64_t steps = 3840;  ///< 16 s
};

/// Returns the scene: the mat lies flat in the xz plane about the origin, without gravity. Its outermost columns, at x
/// = ±0.5 m, rotate about the x axis at ±π/2 rad/s.
compare::Scene mat_twist(const MatTwistSizes& sizes = {});

}  // namespace ogc::experiments
