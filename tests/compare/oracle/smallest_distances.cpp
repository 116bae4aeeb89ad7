#include "compare/oracle/smallest_distances.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

using Rational = boost::multiprecision::cpp_rational;
using Point = std::array<Rational, 3>;

Rational dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Returns the squared distance from the origin to offset + span(directions). The first `first_group` directions are
/// edges of one simplex, the others are edges of another simplex. Returns nothing if the nearest point lies outside a
/// simplex: a coefficient is negative, or the coefficients of a simplex add up to more than 1. Also returns nothing if
/// the directions are dependent.
std::optional<Rational> nearest_inside(const std::vector<Point>& directions, std::size_t first_group,
                                       const Point& offset) {
  const std::size_t n = directions.size();
  std::vector<std::vector<Rational>> rows(n, std::vector<Rational>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = dot(directions[i], directions[j]);
    rows[i][n] = -dot(directions[i], offset);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (rows[i][i] == 0) return std::nullopt;  // in a Gram matrix a zero pivot means dependent directions
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const Rational factor = rows[j][i] / rows[i][i];
      for (std::size_t k = i; k <= n; ++k) rows[j][k] -= factor * rows[i][k];
    }
  }
  Point nearest = offset;
  std::array<Rational, 2> sums;
  for (std::size_t i = 0; i < n; ++i) {
    const Rational weight = rows[i][n] / rows[i][i];
    if (weight < 0) return std::nullopt;
    sums[i < first_group ? 0 : 1] += weight;
    for (std::size_t k = 0; k < 3; ++k) nearest[k] += weight * directions[i][k];
  }
  if (sums[0] > 1 || sums[1] > 1) return std::nullopt;
  return dot(nearest, nearest);
}

/// Returns the squared distance of two convex hulls: the least distance over all pairs of their faces. Special cases
/// get no separate treatment.
Rational hull_distance(const std::vector<Point>& first, const std::vector<Point>& second) {
  std::optional<Rational> least;
  for (unsigned a = 1; a < 1u << first.size(); ++a) {
    for (unsigned b = 1; b < 1u << second.size(); ++b) {
      std::vector<Point> s, t, directions;
      for (std::size_t i = 0; i < first.size(); ++i)
        if (a >> i & 1) s.push_back(first[i]);
      for (std::size_t i = 0; i < second.size(); ++i)
        if (b >> i & 1) t.push_back(second[i]);
      for (std::size_t i = 1; i < s.size(); ++i) directions.push_back(minus(s[i], s[0]));
      for (std::size_t i = 1; i < t.size(); ++i) directions.push_back(minus(t[0], t[i]));
      const auto square = nearest_inside(directions, s.size() - 1, minus(s[0], t[0]));
      if (square && (!least || *square < *least)) least = square;
    }
  }
  return *least;
}

struct Nearest {
  std::optional<Rational> square;
  Index first = -1, second = -1;
};

template <class First, class Second>
Nearest all_pairs(const std::vector<Vec3>& positions, const std::vector<First>& firsts,
                  const std::vector<Second>& seconds, bool ordered) {
  const auto points = [&](const auto& vertices) {
    std::vector<Point> result;
    for (const Index v : vertices) {
      const Vec3& p = positions[static_cast<std::size_t>(v)];
      result.push_back({Rational(p.x), Rational(p.y), Rational(p.z)});
    }
    return result;
  };
  Nearest nearest;
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    for (std::size_t j = ordered ? i + 1 : 0; j < seconds.size(); ++j) {
      bool shared = false;
      for (const Index v : firsts[i])
        for (const Index w : seconds[j]) shared = shared || v == w;
      if (shared) continue;
      const Rational square = hull_distance(points(firsts[i]), points(seconds[j]));
      if (!nearest.square || square < *nearest.square) nearest = {square, static_cast<Index>(i), static_cast<Index>(j)};
    }
  }
  return nearest;
}

/// Returns whether `distance` is the largest double that does not exceed the root of `square`.
bool is_root_rounded_down(double distance, const Rational& square) {
  const double next = std::nextafter(distance, 1e300);
  return Rational(distance) * Rational(distance) <= square &&
         (square == 0 ? distance == 0 : Rational(next) * Rational(next) > square);
}

}  // namespace

TEST_CASE("smallest distances of a triangle above a triangle, by hand", "[unit]") {
  std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 3}, {9, 9, 9}, {9, 8, 9}};
  const Topology topology = build_topology(6, std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}});
  const SmallestDistances above = smallest_distances(topology, positions);
  CHECK(above.vertex_triangle == 3);  // vertex 3 is straight above the triangle's interior
  CHECK(above.vertex == 3);
  CHECK(above.triangle == 0);
  CHECK(above.edge_edge > 3);
  positions[3] = {2, -2, 0};
  positions[4] = {2, -9, 1};
  positions[5] = {2, -9, 2};
  CHECK(smallest_distances(topology, positions).vertex_triangle == 2);  // vertex 3 is beside edge 0–1
  CHECK(smallest_distances(topology, positions).edge_edge == 2);
  positions[3] = {1, 1, 0};
  CHECK(smallest_distances(topology, positions).vertex_triangle == 0);
}

TEST_CASE(
    "left out are pairs inside a rigid group and pairs that share a vertex; without a pair the distance is infinite",
    "[unit]") {
  const std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 3}, {9, 9, 9}, {9, 8, 9}};
  const Topology two = build_topology(6, std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}});
  CHECK(smallest_distances(two, positions, std::vector<Index>(6, 1)).vertex == -1);
  CHECK(smallest_distances(two, positions, std::vector<Index>(6, -1)).vertex_triangle == 3);
  const SmallestDistances one = smallest_distances(build_topology(3, std::vector<Triangle>{{0, 1, 2}}),
                                                   std::span(positions).first(3));
  CHECK(std::isinf(one.vertex_triangle));
  CHECK(std::isinf(one.edge_edge));
  CHECK(one.edge == -1);
  CHECK_THROWS_AS(smallest_distances(two, std::vector<Vec3>(6, Vec3{NAN, 0, 0})), InputError);
}

TEST_CASE("the nearest pairs and their distances are those of brute force in rational numbers", "[property]") {
  std::mt19937 random(9);
  for (const int size : {1, 3, 1 << 20}) {
    std::uniform_int_distribution<int> coordinate(0, size);
    for (int trial = 0; trial < 4; ++trial) {
      std::vector<Vec3> positions(10);
      for (Vec3& p : positions) p = {0.1 * coordinate(random), 0.1 * coordinate(random), 0.1 * coordinate(random)};
      const Topology topology = build_topology(10, std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {6, 5, 0}},
                                               std::vector<Edge>{{7, 8}, {8, 9}});
      std::vector<std::array<Index, 1>> vertices;
      for (Index v = 0; v < 10; ++v) vertices.push_back({v});
      const Nearest facet = all_pairs(positions, vertices, topology.triangles, false),
                    edges = all_pairs(positions, topology.edges, topology.edges, true);
      const SmallestDistances found = smallest_distances(topology, positions);
      REQUIRE(is_root_rounded_down(found.vertex_triangle, *facet.square));
      REQUIRE(is_root_rounded_down(found.edge_edge, *edges.square));
      REQUIRE(std::array{found.vertex, found.triangle, found.edge, found.other_edge} ==
              std::array{facet.first, facet.second, edges.first, edges.second});
    }
  }
}

TEST_CASE("nearly parallel edges have the distance of rational arithmetic, down to an angle of 1e-12", "[property]") {
  const Topology topology = build_topology(4, {}, std::vector<Edge>{{0, 1}, {2, 3}});
  for (double angle = 0.1; angle > 5e-13; angle /= 10) {
    // The edges cross above the origin.
    const std::vector<Vec3> positions{{-1, 0, 0}, {1, 0, 0}, {-1, -angle, 0.25}, {1, angle, 0.25}};
    CHECK(smallest_distances(topology, positions).edge_edge == 0.25);
  }
}

TEST_CASE("two equal layers 5 mm apart are nowhere further apart than that", "[property]") {
  const Index n = 40;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (Index layer = 0; layer < 2; ++layer) {
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const double x = double(float(i) / float(n - 1)), z = double(float(j) / float(n - 1));
        positions.push_back({x, double(layer ? 0.005f : 0) + 0.1 * std::sin(7 * x), z});
        const Index v = (layer * n + i) * n + j;
        if (i + 1 < n && j + 1 < n)
          triangles.insert(triangles.end(), {Triangle{v, v + n, v + n + 1}, Triangle{v, v + n + 1, v + 1}});
      }
    }
  }
  const Topology topology = build_topology(2 * n * n, triangles);
  const auto begin = std::chrono::steady_clock::now();
  const SmallestDistances found = smallest_distances(topology, positions);
  WARN("smallest distances of " << positions.size() << " vertices: "
                                << std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()
                                << " s");
  CHECK(found.vertex_triangle > 0.003);
  CHECK(found.vertex_triangle <= 0.005);
  CHECK(found.edge_edge >= 0.003);
}
