// A straight rod turns freely about its middle. The scene shows how much of its angular momentum an update of frames
// keeps.
#pragma once

#include <cstdint>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: a tenth of a metre of the yarn of yarn_stretch.
struct TurningRodSizes {
  compare::Index segments = 100;  ///< of 1 mm each
  std::int64_t steps = 500;       ///< 0.2 s
  double rate = 10;               ///< about the z axis [rad/s]
};

/// Returns the scene: the rod lies along the x axis, without gravity and far from everything.
compare::Scene turning_rod(const TurningRodSizes& sizes = {});

}  // namespace ogc::experiments
