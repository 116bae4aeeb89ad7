// Suggests settings for a mesh of cloth, or for a solid. They follow from its edges, its gaps, its weight and the
// height of its fall, and each has a reason. There is no search and no trial run, so that the same mesh gets the same
// answer at once.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds a number and a sentence that explains its origin.
struct SuggestedNumber {
  double value = 0;    ///< in the unit of its setting
  std::string reason;  ///< text for people
};

/// Holds the suggested values, rounded to two digits or to 1, 2 or 5 times a power of ten, within the ranges of
/// `setting_table` and `material_table`.
struct Suggestion {
  /// length from which all follows: the median edge, or twice the tenth percentile if that is less [m]
  double edge_length = 0;
  SuggestedNumber contact_radius;     ///< r [m]
  SuggestedNumber query_radius;       ///< the cap of r_q [m]
  SuggestedNumber contact_stiffness;  ///< k_c [N/m]
  SuggestedNumber time_step;          ///< h [s]
  SuggestedNumber iterations;         ///< sweeps a step [1]
  /// excess of the extension of the mesh under its weight, hung by an end, that those sweeps leave, as a share
  /// (method.md §7.7)
  double excess_extension = 0;
};

/// Returns the suggestion for a valid mesh with triangles, with `material`'s density and membrane (for a mesh with
/// tetrahedra its solid_… constants) and g = 9.81 m/s². `fall`: height from which the mesh falls onto something [m]; 0:
/// it does not fall. The smallest gap is found exactly (compare::smallest_distances), which takes a few seconds for a
/// million triangles. Throws compare::InputError for a mesh without a triangle.
Suggestion suggest(const compare::Mesh& mesh, const compare::Material& material, double fall);

/// Sets r, the cap of r_q, h and the iterations of the scene, and k_c of all its bodies.
void apply(const Suggestion& suggestion, compare::Scene& scene);

}  // namespace ogc::experiments
