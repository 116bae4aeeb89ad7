// Decides which pairs the oracle leaves out, and which states it rejects.
#pragma once

#include <span>

#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

/// Returns whether a pair of primitives, given by their vertices, is excluded (method.md §2.3): all vertices have the
/// same group ≥ 0, or a vertex of one primitive is an excluded partner of a vertex of the other.
bool is_excluded(std::span<const Index> first, std::span<const Index> second, const ExclusionView& exclusions);
/// Returns whether the pair is excluded or shares a vertex.
bool left_out(std::span<const Index> first, std::span<const Index> second, const ExclusionView& exclusions);

/// Throws InputError if positions or groups (unless empty) do not have one entry for each vertex, or if a position is
/// not finite. `who` begins the message.
void check_state(const char* who, const Topology& topology, std::span<const Vec3> positions,
                 const ExclusionView& exclusions);

}  // namespace ogc::compare
