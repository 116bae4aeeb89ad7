// Tells whether several parts can divide a scene (fast/kernels/parts.hpp).
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::fast {

/// Throws compare::InputError, which names what is in the way, if the scene cannot be divided.
void expect_divisible(const compare::Scene& scene);

}  // namespace ogc::fast
