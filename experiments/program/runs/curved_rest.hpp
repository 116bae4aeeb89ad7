// Warns of isometric bending where it is wrong: on a rest shape that is not flat.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Rest angle of a hinge [degrees] up to which a rest shape counts as flat. A flat sheet with triangles 1 mm high has
/// angles of this size if its file has six digits of a metre: 10⁻⁶ m over 10⁻³ m.
inline constexpr double flat_degrees = 0.1;

/// Returns a warning about the body whose rest shape is the least flat, among bodies with `bending=isometric_quadratic`
/// and a bending stiffness above 0. It names the number of hinges that are bent at rest, the largest rest angle
/// (method.md §4.7) and its place, and the model to take instead. Empty if all are flat. The scene must be rounded and
/// valid.
std::string curved_rest_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
