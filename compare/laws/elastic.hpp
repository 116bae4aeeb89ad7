// The elastic energy of cloth for laws of energy, written from method.md once more.
#pragma once

#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::compare::law_measures {

/// Of what holds cloth together, somewhere, as it moves.
struct Elastic {
  double energy = 0;  ///< U(x) [J]
  double change = 0;  ///< ∇U(x)·d [J]
};

/// Of all that is not fixed: St. Venant–Kirchhoff membranes (method.md §4.6) and discrete hinges (§4.7). `along`: d by
/// vertex [m]. Throws InputError where a body has another model of either.
Elastic elastic(const Scene& scene, const std::vector<Vec3>& x, const std::vector<Vec3>& along);

}  // namespace ogc::compare::law_measures
