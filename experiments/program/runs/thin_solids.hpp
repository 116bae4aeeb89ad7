// Warns of solids that are thinner than the contact radius at rest.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Returns a warning about the thinnest solid whose rest shape is in contact with itself, with the number of contacts
/// and the smallest thickness [m]. Empty if there is no such solid.
std::string thin_solid_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
