// Warns of solids that are thinner than the contact radius at rest.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Returns a warning about the thinnest solid whose own faces are in contact at rest, by the contact sets of its rest
/// shape alone: the number of pairs and the thickness there [m]. Empty if there is none.
std::string thin_solid_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
