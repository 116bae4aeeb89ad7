// All pairs of primitives within a distance, for what may not leave one out.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/smallest.hpp"

namespace ogc::reference {

/// The pairs of a mesh that are no farther apart than `reach` [m], and some that are; adjacent and excluded ones are
/// left out. Threads share the work: visitors must bear that.
class NearPairs {
 public:
  NearPairs(const Complex& mesh, const compare::ExclusionView& exclusions, double reach)
      : mesh_(mesh), exclusions_(exclusions), reach_(reach * search_margin) {}

  /// visit(v, t) for vertices and triangles.
  template <class Visit>
  void facets(Visit visit) const {
    std::vector<Box> points, triangles;
    for (Index v = 0; v < mesh_.topology.vertex_count; ++v) points.push_back(box_of(std::array{v}));
    for (const compare::Triangle& t : mesh_.topology.triangles) triangles.push_back(box_of(t));
    for_near(points, triangles, [&](Index v, Index t) {
      const compare::Triangle& c = mesh_.triangle(t);
      if (std::find(c.begin(), c.end(), v) == c.end() && !is_excluded(exclusions_, {&v, 1}, c)) visit(v, t);
    });
  }

  /// visit(e, f) for edges e < f.
  template <class Visit>
  void edges(Visit visit) const {
    std::vector<Box> boxes;
    for (const compare::Edge& e : mesh_.topology.edges) boxes.push_back(box_of(e));
    for_near(boxes, boxes, [&](Index e, Index f) {
      const compare::Edge &a = mesh_.edge(e), &b = mesh_.edge(f);
      const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
      if (e < f && !adjacent && !is_excluded(exclusions_, a, b)) visit(e, f);
    });
  }

 private:
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
