// Compares exact smallest distances with CGAL's squared distances in rational numbers over all pairs, and with
// fractions derived by hand.
#include "reference/definitions/nearest.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

using Rational = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Rational>;

Rational exact(float x) { return Rational(static_cast<double>(x)); }

Kernel::Point_3 point(const Surface& surface, Index v) {
  const Vec3f& x = surface.positions[static_cast<std::size_t>(v)];
  return {exact(x.x), exact(x.y), exact(x.z)};
}

/// The square of d_min, or r_q² if no pair is nearer, and the lowest-numbered partner at this distance.
struct Smallest {
  Rational square;
  Index partner = -1;
  void offer(Index other, const Rational& d) {
    if (d < square || (d == square && partner >= 0 && other < partner)) *this = {d, other};
  }
};

struct AllPairs {
  std::vector<Smallest> vertex, edge, triangle;
};

template <class A, class B>
bool share_a_vertex(const A& a, const B& b) {
  return std::any_of(a.begin(), a.end(), [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

AllPairs all_pairs(const Surface& surface, const compare::Topology& topology, float query_radius) {
  const Smallest none{exact(query_radius) * exact(query_radius)};
  AllPairs result{std::vector<Smallest>(surface.positions.size(), none),
                  std::vector<Smallest>(topology.edges.size(), none),
                  std::vector<Smallest>(topology.triangles.size(), none)};
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const auto& c = topology.triangles[t];
    const Kernel::Triangle_3 triangle(point(surface, c[0]), point(surface, c[1]), point(surface, c[2]));
    for (Index v = 0; v < topology.vertex_count; ++v) {
      if (share_a_vertex(std::array{v}, c)) continue;
      const Rational d = CGAL::squared_distance(point(surface, v), triangle);
      result.vertex[static_cast<std::size_t>(v)].offer(static_cast<Index>(t), d);
      result.triangle[t].offer(v, d);
    }
  }
  const auto segment = [&](const compare::Edge& e) {
    return Kernel::Segment_3(point(surface, e[0]), point(surface, e[1]));
  };
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    for (std::size_t f = 0; f < e; ++f) {
      if (share_a_vertex(topology.edges[e], topology.edges[f])) continue;
      const Rational d = CGAL::squared_distance(segment(topology.edges[e]), segment(topology.edges[f]));
      result.edge[e].offer(static_cast<Index>(f), d);
      result.edge[f].offer(static_cast<Index>(e), d);
    }
  }
  return result;
}

/// Returns the fraction as text; a Rational is in lowest terms.
std::string text(const Rational& q) {
  std::ostringstream stream;
  stream << numerator(q) << "/" << denominator(q);
  return stream.str();
}

void check(const std::vector<Smallest>& expected, const std::vector<reference::Nearest>& nearest,
           const std::vector<std::string>& squares) {
  REQUIRE(nearest.size() == expected.size());
  bool partners = true, fractions = true;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    partners = partners && nearest[i].partner == expected[i].partner;
    fractions = fractions && squares[i] == text(expected[i].square);
  }
  CHECK(partners);
  CHECK(fractions);
}

}  // namespace

TEST_CASE("nearest: partners and fractions are those of CGAL's rational squared distances over all pairs",
          "[agreement]") {
  std::mt19937 random(51);
  std::vector<Surface> surfaces{folded(5, 0.4f, random, 0.3f), grid(4), together(grid(3), grid(3, 0.5f)),
                                soup(14, 12, random)};
  surfaces.push_back(mapped(together(grid(3), mapped(grid(3, 1), turned)), [](Vec3f x) {
    return Vec3f{x.x / 3, x.y / 7, x.z / 5};
  }));
  surfaces.back().loose_edges = {{0, 10}, {1, 12}};
  for (const Surface& surface : surfaces) {
    const auto topology = surface.topology();
    for (const float r_q : {0.4f, 1.5f}) {
      const auto in = question(surface, topology, r_q, r_q);
      const AllPairs expected = all_pairs(surface, topology, r_q);
      const auto nearest = reference::nearest_primitives(in);
      const auto squares = reference::exact_squares(in, 0.45f);
      check(expected.vertex, nearest.vertex, squares.vertex);
      check(expected.edge, nearest.edge, squares.edge);
      check(expected.triangle, nearest.triangle, squares.triangle);
      for (std::size_t v = 0; v < expected.vertex.size(); ++v) {
        Rational smallest = expected.vertex[v].square;
        for (const Index e : topology.vertex_edges[v])
          smallest = std::min(smallest, expected.edge[static_cast<std::size_t>(e)].square);
        for (const Index t : topology.vertex_triangles[v])
          smallest = std::min(smallest, expected.triangle[static_cast<std::size_t>(t)].square);
        CHECK(squares.bound[v] == text(exact(0.45f) * exact(0.45f) * smallest));
      }
    }
  }
}

TEST_CASE("nearest: fractions by hand", "[unit]") {
  // The vertex is 3/4 above the middle of the triangle's long side. No edge has another edge near it, so d_min,e is r_q
  // = 2.
  const Surface surface = with_vertex({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}, {}, {}}, {2, 2, 0.75f});
  const auto topology = surface.topology();
  const auto squares = reference::exact_squares(question(surface, topology, 1, 2), 0.5f);
  CHECK(squares.vertex == std::vector<std::string>{"4/1", "4/1", "4/1", "9/16"});
  CHECK(squares.edge == std::vector<std::string>{"4/1", "4/1", "4/1"});
  CHECK(squares.triangle == std::vector<std::string>{"9/16"});
  CHECK(squares.bound == std::vector<std::string>{"9/64", "9/64", "9/64", "9/64"});
}

TEST_CASE("nearest: of equally near partners the lowest-numbered, whatever the threads do", "[property]") {
  const Surface surface = together(grid(6), grid(6, 0.5f));
  const auto topology = surface.topology();
  const auto in = question(surface, topology, 1, 1);
  const auto first = reference::nearest_primitives(in);
  // Vertex 14 lies 1/2 below a vertex of six triangles, all equally near.
  const auto around = topology.vertex_triangles[14 + 36];
  CHECK(first.vertex[14].partner == *std::min_element(around.begin(), around.end()));
  for (int k = 0; k < 5; ++k) {
    const auto again = reference::nearest_primitives(in);
    for (std::size_t t = 0; t < first.triangle.size(); ++t)
      CHECK(again.triangle[t].partner == first.triangle[t].partner);
    for (std::size_t e = 0; e < first.edge.size(); ++e) CHECK(again.edge[e].partner == first.edge[e].partner);
  }
}

TEST_CASE(
    "nearest: Eq. 21–26, the detections' distances are these rounded down, and their bounds are below these, on every "
    "mesh of the zoo",
    "[property]") {
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    const auto in = question(specimen.surface, topology, specimen.radius, 2 * specimen.radius);
    const auto nearest = reference::nearest_primitives(in);
    const auto facets = reference::detect_vertex_facet(in).exact;
    const auto edges = reference::detect_edge_edge(in).exact;
    const auto rounded = [](const std::vector<reference::Nearest>& all) {
      std::vector<float> distances;
      for (const auto& one : all) distances.push_back(reference::distance_below(one.gap));
      return distances;
    };
    const bool same = rounded(nearest.vertex) == facets.d_min_vertex &&
                      rounded(nearest.triangle) == facets.d_min_triangle && rounded(nearest.edge) == edges.d_min_edge;
    CHECK(same);
    const auto bounds = reference::bound(
                            {in.topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, 0.45f})
                            .exact.bound;
    const auto limits = reference::limiting_distances(topology, nearest);
    bool none_above = true;
    for (std::size_t v = 0; v < bounds.size(); ++v)
      none_above = none_above && !reference::scaled_distance_less(limits[v], 0.45f, bounds[v]);
    CHECK(none_above);
  }
}
