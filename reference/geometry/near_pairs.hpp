// Finds all pairs of primitives that are nearer to each other than a distance.
#pragma once

#include "compare/stages/plane.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/separation.hpp"
#include "reference/geometry/smallest.hpp"

namespace ogc::reference {

/// A vertex and a triangle.
struct FacetPair {
  compare::PrimitivePair name;  ///< kind of the pair, numbers of vertex and triangle
  std::array<Index, 1> first;   ///< the vertex's number
  std::array<Index, 3> second;  ///< the corners' numbers
  Vec3f point;                  ///< position of the vertex [m]
  Corners corners;              ///< positions of the corners [m]

  FacetPair(const Complex& mesh, Index v, Index t)
      : name{compare::PrimitivePair::Kind::vertex_triangle, v, t},
        first{v},
        second(mesh.triangle(t)),
        point(mesh.at(v)),
        corners{mesh.at(second[0]), mesh.at(second[1]), mesh.at(second[2])} {}

  /// Returns the feature of the triangle that is closest to the vertex.
  TriangleFeature closest() const { return closest_feature(corners, point); }
  /// Returns the gap of vertex and triangle.
  Margin gap() const { return feature_gap(corners, closest(), point); }
  /// Returns whether vertex and triangle are certainly farther apart than `distance` [m].
  bool surely_beyond(double distance) const {
    return surely_beyond_triangle({point, corners[0], corners[1], corners[2]}, distance);
  }
};

/// Two edges.
struct EdgesPair {
  compare::PrimitivePair name;         ///< kind of the pair, numbers of the edges
  std::array<Index, 2> first, second;  ///< the ends' numbers
  EdgePair ends;                       ///< positions of the ends [m]

  EdgesPair(const Complex& mesh, Index e, Index f)
      : name{compare::PrimitivePair::Kind::edge_edge, e, f},
        first(mesh.edge(e)),
        second(mesh.edge(f)),
        ends{{mesh.at(first[0]), mesh.at(first[1])}, {mesh.at(second[0]), mesh.at(second[1])}} {}

  /// Returns the features that hold the closest points of both edges.
  EdgeFeatures closest() const { return closest_features(ends); }
  /// Returns the gap of the edges.
  Margin gap() const { return feature_gap(ends, closest()); }
  /// Returns whether the edges are certainly farther apart than `distance` [m].
  bool surely_beyond(double distance) const {
    return surely_beyond_edge({ends.first[0], ends.first[1], ends.second[0], ends.second[1]}, distance);
  }
};

/// Lists all pairs of a mesh within `reach` [m], and some that are farther apart. Adjacent and excluded pairs are left
/// out. Threads share the work, so visitors must be safe to call concurrently.
class NearPairs {
 public:
  NearPairs(const Complex& mesh, const compare::ExclusionView& exclusions, double reach)
      : mesh_(mesh), exclusions_(exclusions), reach_(reach * search_margin) {}

  /// Calls visit(pair) for each pair, as a FacetPair or as an EdgesPair with e < f.
  template <class Visit>
  void each(Visit visit) const {
    facets(visit);
    edges(visit);
  }

 private:
  template <class Visit>
  void facets(Visit visit) const {
    std::vector<Box> points, triangles;
    for (Index v = 0; v < mesh_.topology.vertex_count; ++v) points.push_back(box_of(std::array{v}));
    for (const compare::Triangle& t : mesh_.topology.triangles) triangles.push_back(box_of(t));
    for_near(points, triangles, [&](Index v, Index t) {
      const compare::Triangle& c = mesh_.triangle(t);
      if (!mesh_.topology.on_surface(v) || !mesh_.topology.on_surface(c)) return;
      if (std::find(c.begin(), c.end(), v) != c.end()) return;
      if (!is_excluded(exclusions_, {&v, 1}, c)) visit(FacetPair(mesh_, v, t));
    });
  }

  template <class Visit>
  void edges(Visit visit) const {
    std::vector<Box> boxes;
    for (const compare::Edge& e : mesh_.topology.edges) boxes.push_back(box_of(e));
    for_near(boxes, boxes, [&](Index e, Index f) {
      const compare::Edge &a = mesh_.edge(e), &b = mesh_.edge(f);
      if (!mesh_.topology.on_surface(a) || !mesh_.topology.on_surface(b)) return;
      const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
      if (e < f && !adjacent && !is_excluded(exclusions_, a, b)) visit(EdgesPair(mesh_, e, f));
    });
  }

  template <class Vertices>
  Box box_of(const Vertices& vertices) const {
    Box box;
    for (const Index v : vertices) include(box, mesh_.at(v));
    return box;
  }

  template <class Visit>
  void for_near(const std::vector<Box>& queries, const std::vector<Box>& boxes, Visit visit) const {
    const BoxTree tree(boxes);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), 16),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          tree.query(widened(queries[i], reach_), [&](Index j) { visit(static_cast<Index>(i), j); });
                      });
  }

  const Complex& mesh_;
  const compare::ExclusionView& exclusions_;
  double reach_;
};

}  // namespace ogc::reference
