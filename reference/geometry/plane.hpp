// Stage plane: checks exactly whether the planes and balls of a contestant's answer keep all pairs apart, and whether
// they leave the vertices enough room (method.md §5.6).
#pragma once

#include "compare/stages/plane.hpp"

namespace ogc::reference {

/// A height n·x + o, given exactly by its parts n, x and o.
struct Height {
  compare::Vec3f normal, point;  ///< n, and x [m]
  double offset = 0;             ///< o [m] times the length of n
};

/// Returns the sign of a − b, exactly. All numbers must be finite.
int compared(const Height& a, const Height& b);

/// Returns whether an answer keeps all pairs apart, and how far it lets the vertices move. The answer's arrays must
/// have one entry for each vertex and its numbers must be finite. Throws like plane_guarantee.
compare::PlaneTruth plane(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Checks the guarantee for all pairs within r_q, in parallel. Throws InputError if the answer's arrays do not have one
/// entry for each vertex.
compare::PlaneGuarantee plane_guarantee(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Measures the room that the answer leaves to the vertices, in parallel. The arrays must have one entry for each
/// vertex.
compare::PlaneFreedom plane_freedom(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Returns whether n·x ≤ o.
bool keeps(const compare::VertexPlane& plane, const compare::Vec3f& x);

/// Counts the half-spaces that the positions [m] violate.
std::size_t broken_planes(const compare::VertexPlanes& planes, std::span<const compare::Vec3f> positions);

}  // namespace ogc::reference
