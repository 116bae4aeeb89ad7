// Finds when a vertex and a triangle, or two edges, first share a point while their vertices move along straight lines.
// The result is exact for any eight points (compare/meetings.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Kinds of pairs of faces.
enum class MeetingKind : std::uint8_t { vertex_triangle, edge_edge };

/// Vertex 0 and triangle 1 2 3, or edges 0 1 and 2 3, which move from time 0 to time 1. Coordinates must be finite.
struct MovingPair {
  MeetingKind kind = MeetingKind::vertex_triangle;  ///< kind of the faces
  std::array<Vec3, 4> from{}, to{};                 ///< at time 0 and 1 [m]
};

/// The first time t at which the closed faces share a point; 0 if they touch at the start. low ≤ t ≤ high are equal or
/// adjacent doubles.
struct MeetingTime {
  double low = 0, high = 0;  ///< fractions of the motion
};

/// Returns the first time at which the faces share a point; none if they share no point at any time in [0, 1]. Faces
/// may be degenerate at any time, or always in one plane.
std::optional<MeetingTime> first_meeting(const MovingPair& pair);

/// Returns true if the faces certainly share no point at any time in [0, 1]; false proves nothing. Computed in floating
/// point, for culling.
bool certainly_apart(const MovingPair& pair);

}  // namespace ogc::compare
