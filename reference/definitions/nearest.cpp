// Compares distances that are rounded down. If both are the same number, compares the distances as exact fractions. The
// result does not depend on the order of threads: the comparison is exact, and the lowest index wins a tie.
#include "reference/definitions/nearest.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {
namespace {

/// Holds the nearest partner of each primitive; many threads offer partners.
class NearestOfEach {
 public:
  NearestOfEach(std::size_t count, float query_radius)
      : items_(count, Nearest{-1, gap_points({}, {query_radius, 0, 0})}), below_(count, query_radius) {}

  /// Stores the partner if it is nearer than the stored partner. `below` is its distance, rounded down. The initial
  /// value is r_q, so a partner at r_q or farther is not stored.
  void offer(Index primitive, Index partner, const Margin& gap, float below) {
    const auto i = static_cast<std::size_t>(primitive);
    const std::atomic_ref<float> smallest(below_[i]);
    if (below > smallest.load(std::memory_order_relaxed)) return;
    const std::lock_guard lock(locks_[i % locks_.size()]);
    if (!is_nearer(partner, gap, below, items_[i], smallest.load(std::memory_order_relaxed))) return;
    items_[i] = {partner, gap};
    smallest.store(below, std::memory_order_relaxed);
  }
  std::vector<Nearest> take() { return std::move(items_); }

 private:
  static bool is_nearer(Index partner, const Margin& gap, float below, const Nearest& known, float known_below) {
    if (below != known_below || known.partner < 0) return below < known_below;
    const int order = compare_distances(gap, known.gap);
    return order < 0 || (order == 0 && partner < known.partner);
  }

  std::vector<Nearest> items_;
  std::vector<float> below_;
  std::array<std::mutex, 1024> locks_;
};

class Search {
 public:
  explicit Search(const compare::DetectIn& in) : in_(in), mesh_{*in.topology, in.positions} {}

  NearestPrimitives run() {
    NearestPrimitives result;
    find_facets(result);
    find_edges(result);
    return result;
  }

 private:
  template <class Vertices>
  Box box_of(const Vertices& vertices) const {
    Box box;
    for (const Index v : vertices) include(box, mesh_.at(v));
    return box;
  }

  /// Calls visit(i, j) if queries[i] and boxes[j] are within r_q of each other; in parallel over i.
  template <class Visit>
  void for_near(const std::vector<Box>& queries, const std::vector<Box>& boxes, Visit visit) const {
    const BoxTree tree(boxes);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, queries.size(), 16), [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            tree.query(widened(queries[i], in_.query_radius), [&](Index j) { visit(static_cast<Index>(i), j); });
          }
        });
  }

  void find_facets(NearestPrimitives& result) const {
    std::vector<Box> points, triangles;
    for (Index v = 0; v < in_.topology->vertex_count; ++v) points.push_back(box_of(std::array{v}));
    for (const compare::Triangle& t : in_.topology->triangles) triangles.push_back(box_of(t));
    NearestOfEach of_vertex(points.size(), in_.query_radius), of_triangle(triangles.size(), in_.query_radius);
    for_near(points, triangles, [&](Index v, Index t) {
      const compare::Triangle& c = mesh_.triangle(t);
      if (!in_.topology->on_surface(v) || !in_.topology->on_surface(c)) return;
      if (std::find(c.begin(), c.end(), v) != c.end() || is_excluded(in_.exclusions, {&v, 1}, c)) return;
      const Corners corners{mesh_.at(c[0]), mesh_.at(c[1]), mesh_.at(c[2])};
      const Margin gap = feature_gap(corners, closest_feature(corners, mesh_.at(v)), mesh_.at(v));
      const float below = distance_below(gap);
      of_vertex.offer(v, t, gap, below);
      of_triangle.offer(t, v, gap, below);
    });
    result.vertex = of_vertex.take();
    result.triangle = of_triangle.take();
  }

  void find_edges(NearestPrimitives& result) const {
    std::vector<Box> boxes;
    for (const compare::Edge& e : in_.topology->edges) boxes.push_back(box_of(e));
    NearestOfEach of_edge(boxes.size(), in_.query_radius);
    for_near(boxes, boxes, [&](Index e, Index f) {
      const compare::Edge &a = mesh_.edge(e), &b = mesh_.edge(f);
      const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
      if (!in_.topology->on_surface(a) || !in_.topology->on_surface(b)) return;
      if (f <= e || adjacent || is_excluded(in_.exclusions, a, b)) return;
      const EdgePair pair{{mesh_.at(a[0]), mesh_.at(a[1])}, {mesh_.at(b[0]), mesh_.at(b[1])}};
      const Margin gap = feature_gap(pair, closest_features(pair));
      const float below = distance_below(gap);
      of_edge.offer(e, f, gap, below);
      of_edge.offer(f, e, gap, below);
    });
    result.edge = of_edge.take();
  }

  const compare::DetectIn& in_;
  Complex mesh_;
};

std::vector<std::string> squares(const std::vector<Nearest>& nearest) {
  std::vector<std::string> texts(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) texts[i] = squared_distance(nearest[i].gap);
  return texts;
}

}  // namespace

NearestPrimitives nearest_primitives(const compare::DetectIn& in) { return Search(in).run(); }

std::vector<Margin> limiting_distances(const compare::Topology& topology, const NearestPrimitives& nearest) {
  std::vector<Margin> limits;
  limits.reserve(nearest.vertex.size());
  for (std::size_t v = 0; v < nearest.vertex.size(); ++v) {
    Margin smallest = nearest.vertex[v].gap;
    const auto consider = [&](const Nearest& other) {
      if (compare_distances(other.gap, smallest) < 0) smallest = other.gap;
    };
    for (const Index e : topology.vertex_edges[v]) consider(nearest.edge[static_cast<std::size_t>(e)]);
    for (const Index t : topology.vertex_triangles[v]) consider(nearest.triangle[static_cast<std::size_t>(t)]);
    limits.push_back(smallest);
  }
  return limits;
}

ExactSquares exact_squares(const compare::DetectIn& in, float bounds_relaxation) {
  const NearestPrimitives nearest = nearest_primitives(in);
  ExactSquares result{squares(nearest.vertex), squares(nearest.edge), squares(nearest.triangle), {}};
  for (const Margin& limit : limiting_distances(*in.topology, nearest))
    result.bound.push_back(squared_distance(limit, bounds_relaxation));
  return result;
}

}  // namespace ogc::reference
