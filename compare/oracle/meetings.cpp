// Boxes of swept faces hold every position of theirs, since corners move straight: what meets is visited. Then a proof
// in floating point that a pair stays apart; what has none is decided exactly.
#include "compare/oracle/meetings.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "compare/oracle/box_tree.hpp"
#include "compare/oracle/pairs.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class MotionAuditor {
 public:
  MotionAuditor(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                const ExclusionView& exclusions)
      : topology_(topology), from_(from), to_(to), exclusions_(exclusions) {}

  MeetingsResult run() const {
    const BoxTree triangles = tree_over(topology_.triangles), edges = tree_over(topology_.edges);
    tbb::enumerable_thread_specific<MeetingsResult> shares;
    const std::size_t count = at(topology_.vertex_count) + topology_.edges.size();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        if (static_cast<Index>(i) < topology_.vertex_count)
          ask_vertex(static_cast<Index>(i), triangles, shares.local());
        else
          ask_edge(static_cast<Index>(i) - topology_.vertex_count, edges, shares.local());
    });
    MeetingsResult all;
    for (const MeetingsResult& share : shares) {
      all.meetings.insert(all.meetings.end(), share.meetings.begin(), share.meetings.end());
      all.pairs_tested += share.pairs_tested;
      all.pairs_in_doubt += share.pairs_in_doubt;
    }
    std::sort(all.meetings.begin(), all.meetings.end());
    all.count = all.meetings.size();
    return all;
  }

 private:
  template <std::size_t N>
  Box swept(const std::array<Index, N>& vertices) const {
    Box box;
    for (const Index v : vertices) box.add(from_[at(v)]), box.add(to_[at(v)]);
    return box;
  }

  template <std::size_t N>
  BoxTree tree_over(const std::vector<std::array<Index, N>>& faces) const {
    std::vector<Box> boxes;
    boxes.reserve(faces.size());
    for (const auto& face : faces) boxes.push_back(swept(face));
    return BoxTree(boxes);
  }

  void ask_vertex(Index v, const BoxTree& triangles, MeetingsResult& found) const {
    if (topology_.vertex_edges[at(v)].empty() || !topology_.on_surface(v)) return;
    const std::array<Index, 1> vertex{v};
    triangles.for_each_meeting(swept(vertex), [&](Index t) {
      const Triangle& c = topology_.triangles[at(t)];
      if (!topology_.on_surface(c) || left_out(vertex, c, exclusions_)) return;
      decide({MeetingKind::vertex_triangle, v, t}, {v, c[0], c[1], c[2]}, found);
    });
  }

  void ask_edge(Index e, const BoxTree& edges, MeetingsResult& found) const {
    const Edge& edge = topology_.edges[at(e)];
    if (!topology_.on_surface(edge)) return;
    edges.for_each_meeting(swept(edge), [&](Index other) {
      if (other <= e) return;
      const Edge& partner = topology_.edges[at(other)];
      if (!topology_.on_surface(partner) || left_out(edge, partner, exclusions_)) return;
      decide({MeetingKind::edge_edge, e, other}, {edge[0], edge[1], partner[0], partner[1]}, found);
    });
  }

  void decide(Meeting meeting, const std::array<Index, 4>& vertices, MeetingsResult& found) const {
    MovingPair pair{.kind = meeting.kind};
    for (std::size_t k = 0; k < 4; ++k) pair.from[k] = from_[at(vertices[k])], pair.to[k] = to_[at(vertices[k])];
    ++found.pairs_tested;
    if (certainly_apart(pair)) return;
    ++found.pairs_in_doubt;
    const std::optional<MeetingTime> time = first_meeting(pair);
    if (!time) return;
    meeting.time = time->low;
    found.meetings.push_back(meeting);
  }

  const Topology& topology_;
  std::span<const Vec3> from_, to_;
  ExclusionView exclusions_;
};

}  // namespace

MeetingsResult meetings(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                        const ExclusionView& exclusions, std::size_t limit) {
  check_state("meetings", topology, from, exclusions);
  check_state("meetings", topology, to, exclusions);
  MeetingsResult result = MotionAuditor(topology, from, to, exclusions).run();
  result.meetings.resize(std::min(limit, result.meetings.size()));
  return result;
}

std::string describe(const Meeting& meeting, const Topology& topology, const ElementNames& names) {
  const bool edges = meeting.kind == MeetingKind::edge_edge;
  const std::string first = edges ? names.edge(topology.edges[at(meeting.first)]) : names.vertex(meeting.first);
  const std::string second = edges ? names.edge(topology.edges[at(meeting.second)])
                                   : names.triangle(meeting.second, topology.triangles[at(meeting.second)]);
  return first + " meets " + second + " after " + shortest(meeting.time) + " of the motion";
}

}  // namespace ogc::compare
