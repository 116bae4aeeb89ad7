// What to run a mesh of cloth, or a solid, with where nobody says: numbers that follow from its edges, its gaps, its
// weight and the height that it falls from, each with its reason. No search and no trial run: whoever asks gets the
// same answer at once.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// A number and the sentence that says where it comes from.
struct SuggestedNumber {
  double value = 0;    ///< in the unit of its setting
  std::string reason;  ///< for people
};

/// Values that are easy to say (two digits, or 1, 2, 5 times a power of ten), within the ranges of `setting_table` and
/// `material_table`.
struct Suggestion {
  double edge_length = 0;  ///< that all follows from: the median, or twice the tenth percentile if that is less [m]
  SuggestedNumber contact_radius;     ///< r [m]
  SuggestedNumber query_radius;       ///< the cap of r_q [m]
  SuggestedNumber contact_stiffness;  ///< k_c [N/m]
  SuggestedNumber time_step;          ///< h [s]
  SuggestedNumber iterations;         ///< sweeps a step [1]
  /// by which share those sweeps leave the extension of the mesh under its weight, hung by an end, larger than it
  /// should be (method.md §7.7)
  double excess_extension = 0;
};

/// For a valid mesh with triangles, `material`'s density, membrane (of a mesh with tetrahedra: its solid_… constants)
/// and g = 9.81 m/s². `fall`: from how high the mesh
/// falls before it meets something [m]; 0: it does not. The smallest gap is found exactly
/// (compare::smallest_distances), which takes a few seconds for a million triangles. Throws compare::InputError for a
/// mesh without a triangle.
Suggestion suggest(const compare::Mesh& mesh, const compare::Material& material, double fall);

/// Sets r, the cap of r_q, h and the iterations of the scene, and k_c of all its bodies.
void apply(const Suggestion& suggestion, compare::Scene& scene);

}  // namespace ogc::experiments
