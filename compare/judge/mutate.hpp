// Mutation of captured states: what a run never quite reaches, from where runs are.
#pragma once

#include <span>

#include "compare/judge/cases.hpp"
#include "compare/judge/random.hpp"

namespace ogc::compare {

/// Moves a few points, in one or more of these ways: next to another point, or halfway between two others, up to a rung
/// of their distance; onto another point; by a rung; one coordinate taken over from another point; all points to few
/// binary digits. Of a step its velocities, of a sweep xᵗ and the targets, of the rest shape as long as it stays legal.
/// Distances go to, or a rung beside, another distance, the radius or its half.
void mutate(Random& random, CaseData& data);

/// The same for points alone.
void mutate_points(Random& random, std::span<Vec3f> points);

}  // namespace ogc::compare
