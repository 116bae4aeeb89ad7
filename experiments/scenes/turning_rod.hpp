// A straight rod that turns freely about its middle: what an update of frames keeps of its angular momentum.
#pragma once

#include <cstdint>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// A tenth of a metre of the yarn of yarn_stretch by default.
struct TurningRodSizes {
  compare::Index segments = 100;  ///< of 1 mm each
  std::int64_t steps = 500;       ///< 0.2 s
  double rate = 10;               ///< about the z axis [rad/s]
};

/// Along the x axis, without gravity and far from everything.
compare::Scene turning_rod(const TurningRodSizes& sizes = {});

}  // namespace ogc::experiments
