// Culls pairs by boxes and the smallest distance found so far, then by intervals. The remaining pairs are compared in
// exact numbers; in a regular stack these are most pairs, since many distances are equal. Threads share the smallest
// distance found so far. It only decides how early a pair is culled, so the result does not depend on the threads.
#include "compare/oracle/smallest_distances.hpp"

#include <CGAL/Gmpq.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

#include "compare/oracle/box_tree.hpp"
#include "compare/oracle/pairs.hpp"
#include "compare/oracle/squared_distance.hpp"

namespace ogc::compare {
namespace {

using Rational = CGAL::Gmpq;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns whether two primitives are certainly farther apart than √limit.
template <std::size_t A, std::size_t B>
bool certainly_beyond(const std::array<Vec3, A>& first, const std::array<Vec3, B>& second, double limit) {
  const CGAL::Protect_FPU_rounding<true> upward;
  SquareBelow below;
  offer_distance(widen<Interval>(first), widen<Interval>(second), below);
  return below.value > limit;
}

/// Returns the largest double whose square is not above `square`.
double root_rounded_down(const Rational& square) {
  double root = std::sqrt(CGAL::to_interval(square).first);
  while (Rational(root) * Rational(root) > square) root = std::nextafter(root, 0.0);
  for (double next = std::nextafter(root, infinity); root > 0 && Rational(next) * Rational(next) <= square;
       next = std::nextafter(root, infinity))
    root = next;
  return root;
}

/// Returns a double that is at least the square of the distance.
double square_above(const LeastSquare& square) {
  return CGAL::to_interval(Rational(square.numerator) / Rational(square.denominator)).second;
}

struct Nearest {
  LeastSquare square;
  Index first = -1, second = -1;

  /// Returns whether this pair is nearer than the pair (i, j), or is equally near and has smaller indices. `other` is
  /// the squared distance of (i, j).
  bool keeps(const LeastSquare& other, Index i, Index j) const {
    if (first < 0) return false;
    const Exact difference = other.numerator * square.denominator - square.numerator * other.denominator;
    return may_be_positive(difference) || (!may_be_negative(difference) && std::pair(first, second) < std::pair(i, j));
  }
  double distance() const {
    return first < 0 ? infinity : root_rounded_down(Rational(square.numerator) / Rational(square.denominator));
  }
};

/// Searches for the nearest pair on all threads. The threads share `limit_`: a pair farther apart than √limit_ is not
/// the nearest.
class Search {
 public:
  template <std::size_t A, std::size_t B>
  void offer(Index first, Index second, const std::array<Vec3, A>& a, const std::array<Vec3, B>& b) {
    if (certainly_beyond(a, b, limit_.load(std::memory_order_relaxed))) return;
    LeastSquare square;
    offer_distance(widen<Exact>(a), widen<Exact>(b), square);
    Nearest& nearest = shares_.local();
    if (nearest.keeps(square, first, second)) return;
    const bool nearer = nearest.first < 0 ||
                        square.numerator * nearest.square.denominator < nearest.square.numerator * square.denominator;
    nearest = {square, first, second};
    if (nearer) lower(square_above(square));
  }

  /// Returns `box` grown by at least the smallest distance found so far. The root and each sum have an error of at most
  /// half a unit in the last place; moving each outwards to the next double covers more than that.
  Box search_box(Box box) const {
    const double reach = std::nextafter(std::sqrt(limit_.load(std::memory_order_relaxed)), infinity);
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::nextafter(box.low[k] - reach, -infinity);
      box.high[k] = std::nextafter(box.high[k] + reach, infinity);
    }
    return box;
  }

  Nearest nearest() const {
    Nearest all;
    for (const Nearest& share : shares_)
      if (share.first >= 0 && !all.keeps(share.square, share.first, share.second)) all = share;
    return all;
  }

 private:
  void lower(double limit) {
    double known = limit_.load();
    while (limit < known && !limit_.compare_exchange_weak(known, limit)) {}
  }
  std::atomic<double> limit_{infinity};
  tbb::enumerable_thread_specific<Nearest> shares_;
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

template <class Visit>
Nearest nearest_of(std::size_t count, Visit visit) {
  Search search;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) visit(search, static_cast<Index>(i));
  });
  return search.nearest();
}

Nearest nearest_vertex_triangle(const Topology& topology, std::span<const Vec3> positions,
                                const ExclusionView& exclusions) {
  const BoxTree tree = tree_over(positions, topology.triangles);
  return nearest_of(at(topology.vertex_count), [&](Search& search, Index v) {
    if (topology.vertex_edges[at(v)].empty() || !topology.on_surface(v)) return;
    const std::array<Index, 1> vertex{v};
    tree.for_each_meeting(search.search_box(box_of_corners(positions, vertex)), [&](Index t) {
      const Triangle& triangle = topology.triangles[at(t)];
      if (topology.on_surface(triangle) && !left_out(vertex, triangle, exclusions))
        search.offer(v, t, corners(positions, vertex), corners(positions, triangle));
    });
  });
}

Nearest nearest_edge_edge(const Topology& topology, std::span<const Vec3> positions, const ExclusionView& exclusions) {
  const BoxTree tree = tree_over(positions, topology.edges);
  return nearest_of(topology.edges.size(), [&](Search& search, Index e) {
    const Edge& edge = topology.edges[at(e)];
    if (!topology.on_surface(edge)) return;
    tree.for_each_meeting(search.search_box(box_of_corners(positions, edge)), [&](Index other) {
      if (other <= e) return;
      const Edge& partner = topology.edges[at(other)];
      if (topology.on_surface(partner) && !left_out(edge, partner, exclusions))
        search.offer(e, other, corners(positions, edge), corners(positions, partner));
    });
  });
}

}  // namespace

SmallestDistances smallest_distances(const Topology& topology, std::span<const Vec3> positions,
                                     const ExclusionView& exclusions) {
  check_state("smallest distances", topology, positions, exclusions);
  const Nearest facet = nearest_vertex_triangle(topology, positions, exclusions),
                edges = nearest_edge_edge(topology, positions, exclusions);
  return {facet.distance(), facet.first, facet.second, edges.distance(), edges.first, edges.second};
}

}  // namespace ogc::compare
