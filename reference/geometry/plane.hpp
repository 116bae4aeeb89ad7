// Stage plane: checks whether an answer's planes and balls hold the vertices enough, and no more than that. Decides
// exactly, about any contestant's answer (method.md §5.6).
#pragma once

#include "compare/stages/plane.hpp"

namespace ogc::reference {

/// n·x + o of numbers that are known without error.
struct Height {
  compare::Vec3f normal, point;  ///< o [m] times the length of n
  double offset = 0;             ///< [m] times the length of n
};

/// Returns the sign of a − b, exactly. All numbers must be finite.
int compared(const Height& a, const Height& b);

/// Returns both parts of the truth about an answer whose arrays have one entry for each vertex and whose numbers are
/// finite. Throws like plane_guarantee.
compare::PlaneTruth plane(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Examines all pairs within r_q, in parallel. Throws InputError where the answer's arrays do not have one entry for
/// each vertex.
compare::PlaneGuarantee plane_guarantee(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Measures how much room the answer leaves to the vertices, in parallel. The arrays must have one entry for each
/// vertex.
compare::PlaneFreedom plane_freedom(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Returns whether n·x ≤ o.
bool keeps(const compare::VertexPlane& plane, const compare::Vec3f& x);

/// Counts the half-spaces that the positions [m] do not keep.
std::size_t broken_planes(const compare::VertexPlanes& planes, std::span<const compare::Vec3f> positions);

}  // namespace ogc::reference
