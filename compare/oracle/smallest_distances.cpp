// A pair is first measured in interval arithmetic, which says for nearly all of them that they are further apart than the nearest so far; what is left
// is measured in rational numbers. The search box of each primitive is its own box, grown by the nearest distance so far.
#include "compare/oracle/smallest_distances.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <cmath>
#include <optional>

#include "compare/oracle/box_tree.hpp"
#include "compare/oracle/pairs.hpp"

namespace ogc::compare {
namespace {

using Rational = CGAL::Exact_rational;
using Interval = CGAL::Interval_nt<true>;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Squared distance of a vertex and a triangle (one and three corners) or of two edges (two and two), in the number type N.
template <class N, std::size_t A, std::size_t B>
N squared_distance(const std::array<Vec3, A>& first, const std::array<Vec3, B>& second) {
  using Kernel = CGAL::Simple_cartesian<N>;
  const auto point = [](const Vec3& v) { return typename Kernel::Point_3(N(v.x), N(v.y), N(v.z)); };
  if constexpr (A == 1)
    return CGAL::squared_distance(point(first[0]), typename Kernel::Triangle_3(point(second[0]), point(second[1]), point(second[2])));
  else
    return CGAL::squared_distance(typename Kernel::Segment_3(point(first[0]), point(first[1])),
                                  typename Kernel::Segment_3(point(second[0]), point(second[1])));
}

/// Certainly further apart than `limit`; false where interval arithmetic can't tell.
template <std::size_t A, std::size_t B>
bool certainly_beyond(const std::array<Vec3, A>& first, const std::array<Vec3, B>& second, double limit) {
  try {
    return squared_distance<Interval>(first, second).inf() > limit;
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return false;
  }
}

/// The largest double whose square is not above `square`.
double root_rounded_down(const Rational& square) {
  double root = std::sqrt(CGAL::to_interval(square).first);
  while (Rational(root) * Rational(root) > square) root = std::nextafter(root, 0.0);
  for (double next = std::nextafter(root, infinity); root > 0 && Rational(next) * Rational(next) <= square; next = std::nextafter(root, infinity)) root = next;
  return root;
}

/// The nearest pair so far.
class Nearest {
 public:
  template <std::size_t A, std::size_t B>
  void offer(Index first, Index second, const std::array<Vec3, A>& a, const std::array<Vec3, B>& b) {
    if (certainly_beyond(a, b, square_limit_)) return;
    const Rational square = squared_distance<Rational>(a, b);
    if (square_ && (square > *square_ || (square == *square_ && std::pair(first, second) > std::pair(first_, second_)))) return;
    square_ = square;
    square_limit_ = CGAL::to_interval(square).second;
    first_ = first;
    second_ = second;
  }
  /// `box` grown by no less than the nearest distance: the root and the sums are each off by half a unit in the last place at most, two steps outwards
  /// are more than that.
  Box search_box(Box box) const {
    const double reach = std::nextafter(std::sqrt(square_limit_), infinity);
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::nextafter(box.low[k] - reach, -infinity);
      box.high[k] = std::nextafter(box.high[k] + reach, infinity);
    }
    return box;
  }
  double distance() const { return square_ ? root_rounded_down(*square_) : infinity; }
  Index first() const { return first_; }
  Index second() const { return second_; }

 private:
  std::optional<Rational> square_;
  double square_limit_ = infinity;
  Index first_ = -1, second_ = -1;
};

template <std::size_t N>
std::array<Vec3, N> corners(std::span<const Vec3> positions, const std::array<Index, N>& vertices) {
  std::array<Vec3, N> result;
  for (std::size_t k = 0; k < N; ++k) result[k] = positions[at(vertices[k])];
  return result;
}

template <std::size_t N>
Box box_of_corners(std::span<const Vec3> positions, const std::array<Index, N>& vertices) {
  Box box;
  for (const Index v : vertices) box.add(positions[at(v)]);
  return box;
}

template <std::size_t N>
BoxTree tree_over(std::span<const Vec3> positions, const std::vector<std::array<Index, N>>& primitives) {
  std::vector<Box> boxes;
  for (const auto& vertices : primitives) boxes.push_back(box_of_corners(positions, vertices));
  return BoxTree(boxes);
}

Nearest nearest_vertex_triangle(const Topology& topology, std::span<const Vec3> positions, std::span<const Index> rigid_groups) {
  const BoxTree tree = tree_over(positions, topology.triangles);
  Nearest nearest;
  for (Index v = 0; v < topology.vertex_count; ++v) {
    const std::array<Index, 1> vertex{v};
    tree.for_each_meeting(nearest.search_box(box_of_corners(positions, vertex)), [&](Index t) {
      const Triangle& triangle = topology.triangles[at(t)];
      if (!left_out(vertex, triangle, rigid_groups)) nearest.offer(v, t, corners(positions, vertex), corners(positions, triangle));
    });
  }
  return nearest;
}

Nearest nearest_edge_edge(const Topology& topology, std::span<const Vec3> positions, std::span<const Index> rigid_groups) {
  const BoxTree tree = tree_over(positions, topology.edges);
  Nearest nearest;
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const Edge& edge = topology.edges[e];
    tree.for_each_meeting(nearest.search_box(box_of_corners(positions, edge)), [&](Index other) {
      if (at(other) <= e) return;
      const Edge& partner = topology.edges[at(other)];
      if (!left_out(edge, partner, rigid_groups)) nearest.offer(static_cast<Index>(e), other, corners(positions, edge), corners(positions, partner));
    });
  }
  return nearest;
}

}  // namespace

SmallestDistances smallest_distances(const Topology& topology, std::span<const Vec3> positions, std::span<const Index> rigid_groups) {
  check_state("smallest distances", topology, positions, rigid_groups);
  const Nearest facet = nearest_vertex_triangle(topology, positions, rigid_groups), edges = nearest_edge_edge(topology, positions, rigid_groups);
  return {facet.distance(), facet.first(), facet.second(), edges.distance(), edges.first(), edges.second()};
}

}  // namespace ogc::compare
