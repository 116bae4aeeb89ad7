// Warns of solids that are thinner than the contact radius at rest.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Returns a warning about the thinnest solid among those whose rest shape is in contact with itself: the number of
/// pairs and the thickness there [m]. Empty if there is none.
std::string thin_solid_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
