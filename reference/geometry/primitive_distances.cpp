// Works in two rounds. The first measures only neighbours in the mesh, which are near in most states. The second
// searches each primitive's box, widened by the smallest distance found so far. The search of a primitive visits all of
// its pairs, so searches of two primitives do not depend on each other.
#include "reference/geometry/primitive_distances.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/separation.hpp"
#include "reference/geometry/smallest.hpp"

namespace ogc::reference {
namespace {

using compare::at;

template <class Work>
void for_each(std::size_t count, Work work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) work(static_cast<Index>(i));
  });
}

/// Holds the distances of vertices and triangles.
class Facets {
 public:
  explicit Facets(const compare::DetectIn& in)
      : in_(in),
        mesh_{*in.topology, in.positions},
        of_vertex_(in.positions.size(), in.query_radius),
        of_triangle_(in.topology->triangles.size(), in.query_radius) {}

  void search(PrimitiveDistances& result) {
    std::vector<Box> points(in_.positions.size()), boxes(in_.topology->triangles.size());
    for (std::size_t v = 0; v < points.size(); ++v) include(points[v], in_.positions[v]);
    for (std::size_t t = 0; t < boxes.size(); ++t)
      for (const Index v : in_.topology->triangles[t]) include(boxes[t], points[at(v)]);
    const BoxTree vertices(points), triangles(boxes);
    for_each(boxes.size(), [&](Index t) { meet_ring(t); });
    for_each(points.size(), [&](Index v) {
      triangles.query(widened(points[at(v)], double{of_vertex_.so_far(at(v))} * search_margin),
                      [&](Index t) { meet(v, t, of_vertex_.so_far(at(v))); });
    });
    for_each(boxes.size(), [&](Index t) {
      vertices.query(widened(boxes[at(t)], double{of_triangle_.so_far(at(t))} * search_margin),
                     [&](Index v) { meet(v, t, of_triangle_.so_far(at(t))); });
    });
    result.vertex = of_vertex_.take();
    result.triangle = of_triangle_.take();
  }

 private:
  /// Measures the distances between triangle t and the vertices opposite to its edges in the neighbouring triangles.
  void meet_ring(Index t) {
    for (const Index e : in_.topology->triangle_edges[at(t)])
      for (const Index other : mesh_.triangles_of(e))
        if (other != t) meet(mesh_.opposite(other, e), t, in_.query_radius);
  }

  /// Lowers the distances of vertex v and triangle t to the distance of the pair. Skips the pair if it is certainly
  /// farther apart than `known`.
  void meet(Index v, Index t, float known) {
    const compare::Triangle& corners = mesh_.triangle(t);
    if (!in_.topology->on_surface(v) || !in_.topology->on_surface(corners)) return;
    if (std::find(corners.begin(), corners.end(), v) != corners.end() || is_excluded(in_.exclusions, {&v, 1}, corners))
      return;
    const Corners places{mesh_.at(corners[0]), mesh_.at(corners[1]), mesh_.at(corners[2])};
    if (surely_beyond_triangle({mesh_.at(v), places[0], places[1], places[2]}, double{known})) return;
    const float d = distance_below(feature_gap(places, closest_feature(places, mesh_.at(v)), mesh_.at(v)));
    of_vertex_.lower(at(v), d);
    of_triangle_.lower(at(t), d);
  }

  const compare::DetectIn& in_;
  Complex mesh_;
  Smallest of_vertex_, of_triangle_;
};

/// Holds the distances of edges.
class Edges {
 public:
  explicit Edges(const compare::DetectIn& in)
      : in_(in), mesh_{*in.topology, in.positions}, of_edge_(in.topology->edges.size(), in.query_radius) {}

  void search(PrimitiveDistances& result) {
    std::vector<Box> boxes(in_.topology->edges.size());
    for (std::size_t e = 0; e < boxes.size(); ++e)
      for (const Index v : in_.topology->edges[e]) include(boxes[e], in_.positions[at(v)]);
    const BoxTree tree(boxes);
    for_each(boxes.size(), [&](Index e) { meet_ring(e); });
    for_each(boxes.size(), [&](Index e) {
      tree.query(widened(boxes[at(e)], double{of_edge_.so_far(at(e))} * search_margin),
                 [&](Index other) { meet(e, other, of_edge_.so_far(at(e))); });
    });
    result.edge = of_edge_.take();
  }

 private:
  /// Measures the distances between edge e and the edges at the vertices opposite to e in its triangles.
  void meet_ring(Index e) {
    for (const Index t : mesh_.triangles_of(e))
      for (const Index other : mesh_.edges_of(mesh_.opposite(t, e))) meet(e, other, of_edge_.so_far(at(e)));
  }

  /// Lowers the distances of both edges to the distance of the pair. Skips the pair if it is certainly farther apart
  /// than `known`. Puts the lower-numbered edge first, as the detection does, to get the same bits.
  void meet(Index e, Index other, float known) {
    const compare::Edge &a = mesh_.edge(std::min(e, other)), &b = mesh_.edge(std::max(e, other));
    if (!in_.topology->on_surface(a) || !in_.topology->on_surface(b)) return;
    const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
    if (adjacent || is_excluded(in_.exclusions, a, b)) return;
    const std::array<Vec3f, 4> x{mesh_.at(a[0]), mesh_.at(a[1]), mesh_.at(b[0]), mesh_.at(b[1])};
    if (surely_beyond_edge(x, double{known})) return;
    const EdgePair pair{std::array<Vec3f, 2>{x[0], x[1]}, std::array<Vec3f, 2>{x[2], x[3]}};
    const float d = distance_below(feature_gap(pair, closest_features(pair)));
    of_edge_.lower(at(e), d);
    of_edge_.lower(at(other), d);
  }

  const compare::DetectIn& in_;
  Complex mesh_;
  Smallest of_edge_;
};

}  // namespace

PrimitiveDistances primitive_distances(const compare::DetectIn& in) {
  PrimitiveDistances result;
  Facets(in).search(result);
  Edges(in).search(result);
  return result;
}

std::vector<float> exact_bounds(const compare::DetectIn& in, float bounds_relaxation) {
  const PrimitiveDistances distances = primitive_distances(in);
  return bound({in.topology, distances.vertex, distances.edge, distances.triangle, bounds_relaxation}).exact.bound;
}

}  // namespace ogc::reference
