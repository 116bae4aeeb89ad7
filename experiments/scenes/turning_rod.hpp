// Builds a straight rod that rotates freely about its middle. It shows how much angular momentum an update of the
// segments' orientations keeps.
#pragma once

#include <cstdint>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; defaults: a tenth of a metre of yarn_stretch's yarn.
struct TurningRodSizes {
  compare::Index segments = 100;  ///< segments of 1 mm each
  std::int64_t steps = 500;       ///< 0.2 s
  double rate = 10;               ///< angular velocity about the z axis [rad/s]
};

/// Returns the scene: the rod lies along the x axis, without gravity or contact.
compare::Scene turning_rod(const TurningRodSizes& sizes = {});

}  // namespace ogc::experiments
