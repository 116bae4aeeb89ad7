// Culls pairs by boxes, then decides each remaining pair exactly. Each thread collects findings; these are sorted, so
// that the answer does not depend on threads.
#include "compare/oracle/audit.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "compare/oracle/box_tree.hpp"
#include "compare/oracle/exact_intersection.hpp"
#include "compare/oracle/pairs.hpp"

namespace ogc::compare {
namespace {

struct Findings {
  std::vector<Intersection> intersections;
  std::size_t pairs_tested = 0;
};

class Auditor {
 public:
  Auditor(const Topology& topology, std::span<const Vec3> positions, const ExclusionView& exclusions)
      : topology_(topology),
        positions_(positions),
        exclusions_(exclusions),
        tree_(triangle_boxes(topology, positions)),
        loose_(loose_edges(topology)),
        loose_tree_(edge_boxes(topology, loose_, positions)) {}

  Findings run() const {
    tbb::enumerable_thread_specific<Findings> shares;
    const std::size_t count = at(topology_.vertex_count) + topology_.edges.size();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) visit(static_cast<Index>(i), shares.local());
    });
    Findings all;
    for (const Findings& share : shares) {
      all.intersections.insert(all.intersections.end(), share.intersections.begin(), share.intersections.end());
      all.pairs_tested += share.pairs_tested;
    }
    std::sort(all.intersections.begin(), all.intersections.end());
    // Removes copies: an edge pair is found once for each triangle that contains one of the two edges.
    const auto [first, last] = std::ranges::unique(all.intersections);
    all.intersections.erase(first, last);
    return all;
  }

 private:
  static std::vector<Box> triangle_boxes(const Topology& topology, std::span<const Vec3> positions) {
    std::vector<Box> boxes;
    boxes.reserve(topology.triangles.size());
    for (const Triangle& t : topology.triangles)
      boxes.push_back(box_of({positions[at(t[0])], positions[at(t[1])], positions[at(t[2])]}));
    return boxes;
  }

  static std::vector<Index> loose_edges(const Topology& topology) {
    std::vector<Index> loose;
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      if (topology.edge_triangles[e].empty()) loose.push_back(static_cast<Index>(e));
    return loose;
  }

  static std::vector<Box> edge_boxes(const Topology& topology, std::span<const Index> edges,
                                     std::span<const Vec3> positions) {
    std::vector<Box> boxes;
    boxes.reserve(edges.size());
    for (const Index e : edges) {
      const auto& [a, b] = topology.edges[at(e)];
      boxes.push_back(box_of({positions[at(a)], positions[at(b)]}));
    }
    return boxes;
  }

  void visit(Index i, Findings& found) const {
    if (i < topology_.vertex_count) {
      if (!topology_.vertex_edges[at(i)].empty() && topology_.on_surface(i))
        test({i, i}, IntersectionKind::vertex_triangle, i, found);
    } else {
      const Index edge = i - topology_.vertex_count;
      if (topology_.on_surface(topology_.edges[at(edge)]))
        test(topology_.edges[at(edge)], IntersectionKind::edge_triangle, edge, found);
      if (topology_.edge_triangles[at(edge)].empty()) test_loose(edge, found);
    }
  }

  void test(const Edge& edge, IntersectionKind kind, Index name, Findings& found) const {
    const std::array<Vec3, 2> segment{positions_[at(edge[0])], positions_[at(edge[1])]};
    const Box box = box_of({segment[0], segment[1]});
    tree_.for_each_meeting(box, [&](Index number) {
      const Triangle& t = topology_.triangles[at(number)];
      if (!topology_.on_surface(t)) return;
      const auto is_common = [&](Index v) { return v == edge[0] || v == edge[1]; };
      const std::array<bool, 3> common{is_common(t[0]), is_common(t[1]), is_common(t[2])};
      if (const int count = common[0] + common[1] + common[2]; count > 0) {
        if (count == 1 && kind == IntersectionKind::edge_triangle)
          test_opposite(name, box, common[0] ? Edge{t[1], t[2]} : Edge{t[0], common[1] ? t[2] : t[1]}, found);
        return;
      }
      if (is_excluded(edge, t, exclusions_)) return;
      if (kind == IntersectionKind::edge_triangle) ++found.pairs_tested;
      const std::array<Vec3, 3> corners{positions_[at(t[0])], positions_[at(t[1])], positions_[at(t[2])]};
      if (segment_meets_triangle(segment, corners)) found.intersections.push_back({kind, name, number});
    });
  }

  std::array<Vec3, 2> segment(const Edge& e) const { return {positions_[at(e[0])], positions_[at(e[1])]}; }

  /// Tests whether an edge that shares a vertex with a triangle meets `side`, the triangle's edge opposite to that
  /// vertex. If the edges cross, no vertex lies on a triangle, so no other test finds this intersection.
  void test_opposite(Index edge, const Box& box, const Edge& side, Findings& found) const {
    const std::array<Vec3, 2> others = segment(side);
    if (!box.meets(box_of({others[0], others[1]}))) return;
    const Edge& own = topology_.edges[at(edge)];
    if (is_excluded(own, side, exclusions_)) return;
    ++found.pairs_tested;
    if (!segments_meet(segment(own), others)) return;
    const Index other = find_edge(topology_, side[0], side[1]);
    found.intersections.push_back({IntersectionKind::edge_edge, std::min(edge, other), std::max(edge, other)});
  }

  /// Returns whether two edges meet. If they share a vertex, they meet only if the other end of one edge lies on the
  /// other edge.
  bool meet(const Edge& first, const Edge& second) const {
    const auto lies_on = [&](Index v, const Edge& other) {
      return v != other[0] && v != other[1] && segments_meet(segment({v, v}), segment(other));
    };
    if (std::ranges::find_first_of(first, second) == first.end()) return segments_meet(segment(first), segment(second));
    return lies_on(first[0], second) || lies_on(first[1], second) || lies_on(second[0], first) ||
           lies_on(second[1], first);
  }

  void test_loose(Index edge, Findings& found) const {
    const Edge& own = topology_.edges[at(edge)];
    const std::array<Vec3, 2> ends = segment(own);
    loose_tree_.for_each_meeting(box_of({ends[0], ends[1]}), [&](Index i) {
      const Index other = loose_[at(i)];
      const Edge& partner = topology_.edges[at(other)];
      if (other <= edge || is_excluded(own, partner, exclusions_)) return;
      ++found.pairs_tested;
      if (meet(own, partner)) found.intersections.push_back({IntersectionKind::edge_edge, edge, other});
    });
  }

  const Topology& topology_;
  std::span<const Vec3> positions_;
  ExclusionView exclusions_;
  BoxTree tree_;
  std::vector<Index> loose_;
  BoxTree loose_tree_;
};

}  // namespace

AuditResult audit(const Topology& topology, std::span<const Vec3> positions, const ExclusionView& exclusions,
                  const AuditOptions& options) {
  check_state("audit", topology, positions, exclusions);
  Findings found = Auditor(topology, positions, exclusions).run();
  AuditResult result;
  result.count = found.intersections.size();
  result.pairs_tested = found.pairs_tested;
  found.intersections.resize(std::min(options.limit, found.intersections.size()));
  result.intersections = std::move(found.intersections);
  return result;
}

std::vector<Edge> vertex_pairs(const AuditResult& result, const Topology& topology) {
  std::vector<Edge> pairs;
  const auto add = [&](std::span<const Index> first, std::span<const Index> second) {
    for (const Index a : first)
      for (const Index b : second)
        if (a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const Intersection& found : result.intersections) {
    switch (found.kind) {
      case IntersectionKind::edge_triangle:
        add(topology.edges[at(found.first)], topology.triangles[at(found.second)]);
        break;
      case IntersectionKind::vertex_triangle: add({&found.first, 1}, topology.triangles[at(found.second)]); break;
      case IntersectionKind::edge_edge: add(topology.edges[at(found.first)], topology.edges[at(found.second)]); break;
    }
  }
  std::ranges::sort(pairs);
  const auto [first, last] = std::ranges::unique(pairs);
  pairs.erase(first, last);
  return pairs;
}

std::string describe(const Intersection& pair, const Topology& topology, const ElementNames& names) {
  if (pair.kind == IntersectionKind::edge_edge)
    return names.edge(topology.edges[at(pair.first)]) + " meets " + names.edge(topology.edges[at(pair.second)]);
  const std::string triangle = names.triangle(pair.second, topology.triangles[at(pair.second)]);
  if (pair.kind == IntersectionKind::vertex_triangle) return names.vertex(pair.first) + " lies on " + triangle;
  return names.edge(topology.edges[at(pair.first)]) + " meets " + triangle;
}

std::string describe(const AuditResult& result, const Topology& topology, const ElementNames& names) {
  std::string text;
  for (const Intersection& pair : result.intersections) text += describe(pair, topology, names) + "\n";
  if (result.count > result.intersections.size())
    text += "and " + std::to_string(result.count - result.intersections.size()) + " more\n";
  return text;
}

}  // namespace ogc::compare
