// What can be checked of a problem without geometry beyond lengths and areas being non-zero; the oracle asks about intersections.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// One thing that is wrong with a mesh or scene: where it stands ("triangle 17", "motion 'left', vertex 3") and what to do.
struct Problem {
  std::string where, what, remedy;
};

/// Index out of range, repeated vertex in a triangle, duplicate face, NaN or infinity, coordinate or edge length that is neither zero nor
/// within 2⁻²⁰ … 2²⁰ m, zero-length edge, zero-area triangle (decided exactly), isolated vertex. At most `limit` entries of each sort are listed, then a count.
std::vector<Problem> validate(const Mesh& mesh, std::size_t limit = 10);

/// The mesh, its rest positions, bodies that do not cover it, motions of unknown, fixed or doubly prescribed vertices, settings out of range,
/// negative stiffness, density or friction.
std::vector<Problem> validate(const Scene& scene, std::size_t limit = 10);

/// All of them as one message; empty if there are none.
std::string describe(const std::vector<Problem>& problems);

}  // namespace ogc::compare
