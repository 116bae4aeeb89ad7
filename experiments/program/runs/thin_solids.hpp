// Solids that are thinner than the contact radius at rest.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Which solid's own faces are in contact at rest, by the contact sets of its rest shape alone: how many pairs, and how
/// thin it is there [m]. Of several solids the thinnest. Empty where none is.
std::string thin_solid_warning(const compare::Scene& scene);

}  // namespace ogc::experiments
