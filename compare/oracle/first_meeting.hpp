// When do a vertex and a triangle, or two edges, first share a point while their vertices move straight? Decided
// without rounding, and total: whatever the eight points are, there is an answer (compare/meetings.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Which faces may meet.
enum class MeetingKind : std::uint8_t { vertex_triangle, edge_edge };

/// A vertex 0 and a triangle 1 2 3, or edges 0 1 and 2 3, on their way from time 0 to time 1. Coordinates are finite.
struct MovingPair {
  MeetingKind kind = MeetingKind::vertex_triangle;  ///< which faces
  std::array<Vec3, 4> from{}, to{};                 ///< at time 0 and 1 [m]
};

/// The first time at which the closed faces share a point, 0 where they touch from the start; low ≤ time ≤ high, both
/// doubles, equal or next to each other.
struct MeetingTime {
  double low = 0, high = 0;  ///< shares of the motion
};

/// None where they share no point at any time in [0, 1]. Faces may be degenerate at any time, or always in one plane.
std::optional<MeetingTime> first_meeting(const MovingPair& pair);

/// True proves that the faces share no point at any time in [0, 1]; false says nothing. In floating point, for culling.
bool certainly_apart(const MovingPair& pair);

}  // namespace ogc::compare
