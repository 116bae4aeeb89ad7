// Stage plane: is what holds the vertices enough, and no more than that? Decided exactly, about an answer of whomever
// (method.md §5.6).
#pragma once

#include "compare/stages/plane.hpp"

namespace ogc::reference {

/// n·x + o of numbers that are known without error.
struct Height {
  compare::Vec3f normal, point;  ///< n [1], x [m]
  double offset = 0;             ///< [m] times the length of n
};

/// The sign of a − b, exactly. All must be finite.
int compared(const Height& a, const Height& b);

/// Both parts of the truth about an answer whose arrays have one entry each vertex and whose numbers are finite.
compare::PlaneTruth plane(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Lists all pairs within r_q, in parallel. Throws InputError where the answer's arrays have not one entry each vertex.
compare::PlaneGuarantee plane_guarantee(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// What the answer leaves to the vertices; likewise.
compare::PlaneFreedom plane_freedom(const compare::PlaneIn& in, const compare::PlaneOut& out);

/// Whether n·x ≤ o.
bool keeps(const compare::VertexPlane& plane, const compare::Vec3f& x);

/// Half-spaces that the positions [m] do not keep.
std::size_t broken_planes(const compare::VertexPlanes& planes, std::span<const compare::Vec3f> positions);

}  // namespace ogc::reference
