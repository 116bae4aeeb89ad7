// Which pairs the oracle leaves out, and which states it refuses.
#pragma once

#include <span>

#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

/// A pair of primitives, given by their vertices, is left out where they share a vertex, where all vertices carry one
/// group ≥ 0, or where a vertex of one is an excluded partner of a vertex of the other (method.md §2.3).
bool left_out(std::span<const Index> first, std::span<const Index> second, const ExclusionView& exclusions);

/// Throws InputError where positions or groups (unless empty) have not one entry for each vertex, or a position is not
/// finite: `who` begins the message.
void check_state(const char* who, const Topology& topology, std::span<const Vec3> positions,
                 const ExclusionView& exclusions);

}  // namespace ogc::compare
