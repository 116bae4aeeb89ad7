// Finds when a vertex and a triangle, or two edges, first share a point while their vertices move straight: without
// rounding, and for any eight points (compare/meetings.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Kinds of faces that may meet.
enum class MeetingKind : std::uint8_t { vertex_triangle, edge_edge };

/// A vertex 0 and a triangle 1 2 3, or edges 0 1 and 2 3, on their way from time 0 to time 1. Coordinates are finite.
struct MovingPair {
  MeetingKind kind = MeetingKind::vertex_triangle;  ///< kind of the faces
  std::array<Vec3, 4> from{}, to{};                 ///< at time 0 and 1 [m]
};

/// The first time at which the closed faces share a point, 0 if they touch from the start; low ≤ time ≤ high, both
/// doubles, equal or next to each other.
struct MeetingTime {
  double low = 0, high = 0;  ///< shares of the motion
};

/// Returns that time; none if they share no point at any time in [0, 1]. Faces may be degenerate at any time, or always
/// in one plane.
std::optional<MeetingTime> first_meeting(const MovingPair& pair);

/// Returns true if the faces certainly share no point at any time in [0, 1]; false proves nothing. Computed in floating
/// point, for culling.
bool certainly_apart(const MovingPair& pair);

}  // namespace ogc::compare
