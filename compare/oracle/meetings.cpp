// The box of a swept face contains all of its positions, since corners move along straight lines; so every pair that
// meets is visited. A proof in floating point then excludes most pairs, and the others are decided exactly.
#include "compare/oracle/meetings.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "compare/oracle/box_tree.hpp"
#include "compare/oracle/pairs.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

class MotionAuditor {
 public:
  MotionAuditor(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                const ExclusionView& exclusions)
      : topology_(topology),
        from_(from),
        to_(to),
        exclusions_(exclusions),
        triangles_(tree_over(topology.triangles)),
        edges_(tree_over(topology.edges)) {}

  /// Returns the number of searches: one per vertex and one per edge.
  std::size_t asking() const { return at(topology_.vertex_count) + topology_.edges.size(); }

  /// Returns the meetings of every `stride`-th vertex or edge.
  MeetingsResult run(std::size_t stride = 1) const {
    tbb::enumerable_thread_specific<MeetingsResult> shares;
    const std::size_t count = (asking() + stride - 1) / stride;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k)
        if (const auto i = static_cast<Index>(k * stride); i < topology_.vertex_count)
          ask_vertex(i, shares.local());
        else
          ask_edge(i - topology_.vertex_count, shares.local());
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

  void ask_vertex(Index v, MeetingsResult& found) const {
    if (topology_.vertex_edges[at(v)].empty() || !topology_.on_surface(v)) return;
    const std::array<Index, 1> vertex{v};
    triangles_.for_each_meeting(swept(vertex), [&](Index t) {
      const Triangle& c = topology_.triangles[at(t)];
      if (!topology_.on_surface(c) || left_out(vertex, c, exclusions_)) return;
      decide({MeetingKind::vertex_triangle, v, t}, {v, c[0], c[1], c[2]}, found);
    });
  }

  void ask_edge(Index e, MeetingsResult& found) const {
    const Edge& edge = topology_.edges[at(e)];
    if (!topology_.on_surface(edge)) return;
    edges_.for_each_meeting(swept(edge), [&](Index other) {
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
  BoxTree triangles_, edges_;
};

constexpr std::size_t sample_size = 2000;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

MeetingsResult meetings(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                        const ExclusionView& exclusions, std::size_t limit) {
  check_state("meetings", topology, from, exclusions);
  check_state("meetings", topology, to, exclusions);
  MeetingsResult result = MotionAuditor(topology, from, to, exclusions).run();
  result.meetings.resize(std::min(limit, result.meetings.size()));
  return result;
}

MeetingsCost meetings_cost(const Topology& topology, std::span<const Vec3> from, std::span<const Vec3> to,
                           const ExclusionView& exclusions) {
  check_state("meetings", topology, from, exclusions);
  check_state("meetings", topology, to, exclusions);
  const auto start = std::chrono::steady_clock::now();
  const MotionAuditor auditor(topology, from, to, exclusions);
  const double trees = seconds_since(start);
  const std::size_t stride = std::max<std::size_t>(1, auditor.asking() / sample_size);
  const MeetingsResult sample = auditor.run(stride);
  const auto of_all = [&](double of_sample) { return of_sample * static_cast<double>(stride); };
  return {of_all(static_cast<double>(sample.pairs_tested)), trees + of_all(seconds_since(start) - trees),
          BoxTree::bytes(topology.triangles.size()) + BoxTree::bytes(topology.edges.size()) +
              (from.size() + to.size()) * sizeof(Vec3) + stride * sample.count * sizeof(Meeting)};
}

std::string describe(const Meeting& meeting, const Topology& topology, const ElementNames& names) {
  const bool edges = meeting.kind == MeetingKind::edge_edge;
  const std::string first = edges ? names.edge(topology.edges[at(meeting.first)]) : names.vertex(meeting.first);
  const std::string second = edges ? names.edge(topology.edges[at(meeting.second)])
                                   : names.triangle(meeting.second, topology.triangles[at(meeting.second)]);
  return first + " meets " + second + " after " + shortest(meeting.time) + " of the motion";
}

}  // namespace ogc::compare
