// Which faces share a point on the straight way between two states of a mesh (method.md §5.5): what a state can't tell
// of curves, and what proves a motion. compare/meetings.md has the construction.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/oracle/first_meeting.hpp"
#include "compare/problem/element_names.hpp"
#include "compare/problem/exclusions.hpp"

namespace ogc::compare {

/// A vertex and a triangle, or two edges, that share a point at some time of the motion.
struct Meeting {
  MeetingKind kind = MeetingKind::vertex_triangle;  ///< which faces
  Index first = -1, second = -1;                    ///< vertex and triangle, or edges, the smaller first
  double time = 0;                                  ///< of the first such point, in [0, 1], rounded down
  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

/// What a motion holds.
struct MeetingsResult {
  std::vector<Meeting> meetings;   ///< vertices first, then ascending
  std::size_t count = 0;           ///< of all meetings
  std::size_t pairs_tested = 0;    ///< whose swept boxes meet, without those left out
  std::size_t pairs_in_doubt = 0;  ///< of them, what no rounded direction parts: decided without rounding
};

/// Vertex v moves from from[v] at time 0 straight to to[v] at time 1 [m]; edges of triangles and loose ones alike.
/// Exact, on any number of threads; touching counts, also at time 0 and 1, so that a pair that touches in a state
/// counts in the motion to it and in the one from it. Left out as in `audit`: pairs with a common vertex, those of
/// `exclusions`, isolated vertices, and what is not on the surface. `limit`: lists at most so many. Throws InputError
/// where a position is not finite or sizes do not fit.
MeetingsResult meetings(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                        const ExclusionView& exclusions = {}, std::size_t limit = 1000);

/// What `meetings` of a way would take, by what a sample of at most 2,000 of its vertices and edges took.
struct MeetingsCost {
  double pairs = 0;       ///< of pairs_tested
  double seconds = 0;     ///< with the threads that asked
  std::size_t bytes = 0;  ///< of memory beside the mesh's own, at the most
};

/// As `meetings`, whose errors it throws.
MeetingsCost meetings_cost(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                           const ExclusionView& exclusions = {});

/// "edge (vertices 3, 7) meets edge (vertices 9, 10) after 0.25 of the motion".
std::string describe(const Meeting& meeting, const Topology& topology, const ElementNames& names = {});

}  // namespace ogc::compare
