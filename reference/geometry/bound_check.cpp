// A distance rounded down times γ_p is exact in double and decides nearly always; exact numbers are asked only where b_v lies above that product. Pairs
// farther than r_q cannot matter: b_v ≤ γ_p r_q is asked first.
#include "reference/geometry/bound_check.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "compare/problem/error.hpp"
#include "reference/geometry/blocks.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {
namespace {

class BoundCheck {
 public:
  BoundCheck(const compare::DetectIn& in, float bound_relaxation, std::span<const float> bounds)
      : in_(in), mesh_{*in.topology, in.positions}, relaxation_(bound_relaxation), bounds_(bounds), above_(bounds.size()) {}

  std::vector<Index> run() {
    const double largest = static_cast<double>(relaxation_) * in_.query_radius;
    for (std::size_t v = 0; v < bounds_.size(); ++v) above_[v] = !(static_cast<double>(bounds_[v]) <= largest);
    check_triangles();
    check_edges();
    std::vector<Index> result;
    for (std::size_t v = 0; v < above_.size(); ++v) {
      if (above_[v]) result.push_back(static_cast<Index>(v));
    }
    return result;
  }

 private:
  template <class Vertices>
  Box box_of(const Vertices& vertices) const {
    Box box;
    for (const Index v : vertices) include(box, mesh_.at(v));
    return box;
  }

  /// One pair and the vertices whose bounds it limits.
  void limit(const Margin& gap, std::span<const Index> first, std::span<const Index> second) {
    const double below = static_cast<double>(relaxation_) * distance_below(gap);
    for (const auto vertices : {first, second}) {
      for (const Index v : vertices) {
        const float b = bounds_[static_cast<std::size_t>(v)];
        if (static_cast<double>(b) > below && scaled_distance_less(gap, relaxation_, b)) above_[static_cast<std::size_t>(v)] = true;
      }
    }
  }

  /// Calls visit(i, j) for all i in parallel and those j whose boxes come within r_q of box i.
  template <class Visit>
  void for_near(const std::vector<Box>& queries, const std::vector<Box>& boxes, Visit visit) const {
    const BoxTree tree(boxes);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), 16), [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        tree.query(widened(queries[i], in_.query_radius), [&](Index j) { visit(static_cast<Index>(i), j); });
      }
    });
  }

  void check_triangles() {
    std::vector<Box> points, triangles;
    for (Index v = 0; v < in_.topology->vertex_count; ++v) points.push_back(box_of(std::array{v}));
    for (const compare::Triangle& t : in_.topology->triangles) triangles.push_back(box_of(t));
    for_near(points, triangles, [&](Index v, Index t) {
      const compare::Triangle& c = mesh_.triangle(t);
      if (std::find(c.begin(), c.end(), v) != c.end() || in_one_group(in_.rigid_groups, {&v, 1}, c)) return;
      const Corners corners{mesh_.at(c[0]), mesh_.at(c[1]), mesh_.at(c[2])};
      limit(feature_gap(corners, closest_feature(corners, mesh_.at(v)), mesh_.at(v)), {&v, 1}, c);
    });
  }

  void check_edges() {
    std::vector<Box> boxes;
    for (const compare::Edge& e : in_.topology->edges) boxes.push_back(box_of(e));
    for_near(boxes, boxes, [&](Index e, Index f) {
      const compare::Edge &a = mesh_.edge(e), &b = mesh_.edge(f);
      const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
      if (f <= e || adjacent || in_one_group(in_.rigid_groups, a, b)) return;
      const EdgePair pair{{mesh_.at(a[0]), mesh_.at(a[1])}, {mesh_.at(b[0]), mesh_.at(b[1])}};
      limit(feature_gap(pair, closest_features(pair)), a, b);
    });
  }

  const compare::DetectIn& in_;
  Complex mesh_;
  float relaxation_;
  std::span<const float> bounds_;
  std::vector<std::atomic<bool>> above_;
};

}  // namespace

std::vector<Index> bounds_above_exact(const compare::DetectIn& in, float bound_relaxation, std::span<const float> bounds) {
  if (bounds.size() != in.positions.size()) {
    throw compare::InputError("bounds_above_exact: " + std::to_string(bounds.size()) + " bounds for " + std::to_string(in.positions.size()) +
                              " vertices; give one for each");
  }
  return BoundCheck(in, bound_relaxation, bounds).run();
}

}  // namespace ogc::reference
