// Warns of isometric bending on a rest shape that is not flat, where this model is wrong.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Largest rest angle of a hinge [degrees] at which a rest shape counts as flat. If a file rounds coordinates to 10⁻⁶
/// m, a flat sheet whose triangles are 1 mm high gets angles of about this size: 10⁻⁶ m over 10⁻³ m.
inline constexpr double flat_degrees = 0.1;

/// Returns a warning about the least flat rest shape among bodies with `bending=isometric_quadratic` and a bending
/// stiffness above 0. The warning gives the number of bent hinges, the largest rest angle (method.md §4.7), its place,
/// and the model to use instead. Empty if all rest shapes are flat. The scene must be rounded and valid.
std::string curved_rest_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
