// Checks meshes and scenes: indices, numbers, lengths, areas and volumes. The audit of the reference finds
// intersections.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// One thing that is wrong with a mesh or scene: its place ("face 18 (line 40)", "motion 'left', vertex 3 of body
/// 'sheet'") and the remedy.
struct Problem {
  std::string where, what, remedy;  ///< which element, what is wrong, what to do
};

/// Returns a mesh's problems: index out of range, repeated vertex in a triangle, duplicate face, NaN or infinity,
/// coordinate beyond 2²⁰ m, edge length that is not within 2⁻²⁰ … 2²⁰ m, zero-length edge, zero-area triangle (decided
/// exactly), isolated vertex, face of three tetrahedra, face whose two tetrahedra lie on the same side of the face. At
/// most `limit` entries of each kind are listed, then a count. `names` names the elements.
std::vector<Problem> validate(const Mesh& mesh, std::size_t limit = 10, const ElementNames& names = {});

/// Returns a scene's problems: those of the mesh and its rest positions, tetrahedra that are flat or inverted at rest,
/// bodies that do not cover the scene, motions of unknown, fixed or doubly prescribed vertices, settings out of range,
/// negative stiffness, density or friction, rods that can't be simulated (compare/problem/rods.hpp). Elements are named
/// by body and by their number within the body.
std::vector<Problem> validate(const Scene& scene, std::size_t limit = 10);
/// Returns the same problems; `names` can name elements by the numbers and lines of mesh files.
std::vector<Problem> validate(const Scene& scene, std::size_t limit, const ElementNames& names);

/// Returns all problems as one message; empty if there are none.
std::string describe(const std::vector<Problem>& problems);

}  // namespace ogc::compare
