// Fig. 12: a square cloth is twisted at its two ends until it coils.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the sizes; the defaults are the paper's. The contact radius is proportional to the spacing: 2 mm for a cloth
/// of 100 × 100 vertices.
struct TwistSizes {
  compare::Index vertices_a_side = 100;  ///< along each side of the cloth
  std::int64_t steps = 9600;             ///< 32 s: 8 rotations of one end relative to the other
};

/// Returns the scene: the cloth lies flat in the xz plane, without gravity. The columns at x = ±0.5 m rotate about the
/// x axis at ±π/4 rad/s.
compare::Scene twist(const TwistSizes& sizes = {});

}  // namespace ogc::experiments
