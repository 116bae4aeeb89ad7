// Isometric bending where it is wrong: on a rest shape that is not flat.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Rest angle of a hinge [degrees] up to which a rest shape counts as flat: six digits of a metre leave as much of a
/// flat sheet whose triangles are a millimetre high, 10⁻⁶ m over 10⁻³ m.
inline constexpr double flat_degrees = 0.1;

/// Of all bodies with `bending=isometric_quadratic` that bend at all the one whose rest shape is the least flat: how
/// many of its hinges are bent at rest, the largest rest angle (method.md §4.7) and where it is, and the model to take.
/// Empty where all are flat. The scene must be rounded and valid.
std::string curved_rest_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
