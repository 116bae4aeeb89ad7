// Which pairs the oracle asks about, and of which states.
#pragma once

#include <span>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// A pair of primitives, given by their vertices, is left out where they share a vertex or where all vertices carry one rigid group ≥ 0 (method.md §2).
/// `rigid_groups` may be empty.
bool left_out(std::span<const Index> first, std::span<const Index> second, std::span<const Index> rigid_groups);

/// Throws InputError where positions or groups (unless empty) have not one entry for each vertex, or a position is not finite: `who` begins the message.
void check_state(const char* who, const Topology& topology, std::span<const Vec3> positions, std::span<const Index> rigid_groups);

}  // namespace ogc::compare
