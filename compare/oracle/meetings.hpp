// Finds the faces that share a point on the straight motion between two states of a mesh (method.md §5.5). Two states
// cannot show that curves passed through each other between them. compare/meetings.md explains the method.
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
  MeetingKind kind = MeetingKind::vertex_triangle;  ///< kind of the faces
  Index first = -1, second = -1;                    ///< vertex and triangle, or edges, the smaller first
  double time = 0;                                  ///< time of the first common point, in [0, 1], rounded down
  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

/// The meetings of a motion.
struct MeetingsResult {
  std::vector<Meeting> meetings;  ///< pairs with vertices first, then ascending
  std::size_t count = 0;          ///< number of all meetings
  std::size_t pairs_tested = 0;   ///< pairs whose swept boxes meet, without excluded pairs
  /// tested pairs that first_meeting_filter.cpp cannot prove to be apart, so that exact arithmetic decides them
  std::size_t pairs_in_doubt = 0;
};

/// Finds all pairs of faces that share a point during a motion; also tests loose edges. Each vertex v moves straight
/// from from[v] at time 0 to to[v] at time 1 [m]. The answer is exact and does not depend on the number of threads.
/// Touching counts, also at times 0 and 1. So a pair that touches in a state counts in the motion before it and in the
/// motion after it. Pairs with a common vertex, pairs of `exclusions`, isolated vertices and everything off the surface
/// are left out, as in `audit`. At most `limit` meetings are listed. Throws InputError if a position is not finite or
/// sizes do not match.
MeetingsResult meetings(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                        const ExclusionView& exclusions = {}, std::size_t limit = 1000);

/// Estimated cost of `meetings` for a motion, from a sample of at most 2,000 of its vertices and edges.
struct MeetingsCost {
  double pairs = 0;       ///< estimate of pairs_tested
  double seconds = 0;     ///< estimated time with the caller's threads [s]
  std::size_t bytes = 0;  ///< largest memory that `meetings` needs besides the mesh
};

/// Estimates the cost of `meetings`; throws the same errors.
MeetingsCost meetings_cost(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                           const ExclusionView& exclusions = {});

/// Returns "edge (vertices 3, 7) meets edge (vertices 9, 10) after 0.25 of the motion".
std::string describe(const Meeting& meeting, const Topology& topology, const ElementNames& names = {});

}  // namespace ogc::compare
