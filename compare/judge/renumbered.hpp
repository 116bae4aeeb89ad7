// Numbers of vertices and triangles mean nothing to contact sets and bounds: the same mesh under other numbers, and its
// answer under the old ones.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/judge/cases.hpp"
#include "compare/problem/contestant.hpp"

namespace ogc::compare {

/// Whether the stage's answers do not depend on the numbering: the two detections and bound.
bool is_free_of_order(Stage stage);

/// Of each case whether vertices, triangles and each triangle's corners in another order give the same contacts, or the
/// same bits of bounds. What is defined by numbers (owners, generating edges) is left out, and smallest distances,
/// which are rounded in the order of corners and edges. Cases with collapsed triangles or edges have ties that a
/// contestant may break by order: not for them.
std::vector<bool> same_when_renumbered(Stage stage, std::span<const TestCase> cases, const Contestant& contestant);

}  // namespace ogc::compare
