// Computes the elastic energy of cloth from method.md. The laws judge the energy that a solver reports, so they do not
// use the solver's code.
#pragma once

#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::compare::law_measures {

/// The elastic energy U at a state x, and its rate along a direction d.
struct Elastic {
  double energy = 0;  ///< U(x) [J]
  double change = 0;  ///< ∇U(x)·d [J]
};

/// Returns the energy of all bodies that are not fixed, and its rate along the direction d: St. Venant–Kirchhoff
/// membranes (method.md §4.6) and discrete hinges (§4.7). `along` holds d by vertex [m]. Throws InputError if a body
/// has another membrane or bending model.
Elastic elastic(const Scene& scene, const std::vector<Vec3>& x, const std::vector<Vec3>& along);

}  // namespace ogc::compare::law_measures
