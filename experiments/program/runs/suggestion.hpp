// Suggests settings for a mesh of cloth or for a solid. They follow from its edges, its gaps, its weight and the height
// of its fall; each comes with a reason. No search or trial run is needed, so the answer is immediate and reproducible.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds a number and a sentence that explains it.
struct SuggestedNumber {
  double value = 0;    ///< value in the unit of its setting
  std::string reason;  ///< text for people
};

/// Holds the suggested values. They are rounded to two digits or to 1, 2 or 5 times a power of ten, and lie within the
/// ranges of `setting_table` and `material_table`.
struct Suggestion {
  /// length from which all numbers are derived [m]: the median edge, or twice the tenth percentile of the edges if this
  /// is less
  double edge_length = 0;
  SuggestedNumber contact_radius;     ///< r [m]
  SuggestedNumber query_radius;       ///< cap of r_q [m]
  SuggestedNumber contact_stiffness;  ///< k_c [N/m]
  SuggestedNumber time_step;          ///< h [s]
  SuggestedNumber iterations;         ///< sweeps in each step [1]
  /// relative excess of the extension after `iterations` sweeps, if the mesh hangs by one end under its weight
  /// (method.md §7.7)
  double excess_extension = 0;
};

/// Returns the suggestion for a valid mesh with triangles. `material`: density and constants of the membrane; for
/// tetrahedra, density and the solid_… constants. `fall`: height from which the mesh falls [m]; 0 if it does not fall.
/// g = 9.81 m/s². Finds the mesh's smallest gap exactly (compare::smallest_distances), in a few seconds for a million
/// triangles. Throws compare::InputError for a mesh without triangles.
Suggestion suggest(const compare::Mesh& mesh, const compare::Material& material, double fall);

/// Sets r, the cap of r_q, h and the number of iterations of the scene, and k_c of all its bodies.
void apply(const Suggestion& suggestion, compare::Scene& scene);

}  // namespace ogc::experiments
