// Tests the whole topology against its definitions by brute force, because both contestants use edge numbers as names.
#include "compare/problem/mesh.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

struct Complex {
  const char* name;
  Index vertex_count;
  std::vector<Triangle> triangles;
  std::vector<Edge> loose_edges;
};

Edge ordered(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

// Returns distinct triangles on few vertices: many edges with three and more triangles, isolated vertices, several
// components.
Complex random_complex(unsigned seed, Index vertex_count, int triangle_count, int edge_count) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> vertex(0, vertex_count - 1);
  Complex complex{"random", vertex_count, {}, {}};
  std::set<std::set<Index>> seen;
  const auto draw = [&](std::size_t corners) {
    std::vector<Index> face;
    while (face.size() < corners) {
      const Index v = vertex(random);
      if (std::find(face.begin(), face.end(), v) == face.end()) face.push_back(v);
    }
    return face;
  };
  for (int i = 0; i < triangle_count; ++i) {
    const auto f = draw(3);
    if (seen.insert({f.begin(), f.end()}).second) complex.triangles.push_back({f[0], f[1], f[2]});
  }
  for (int i = 0; i < edge_count; ++i) {
    const auto f = draw(2);
    complex.loose_edges.push_back({f[0], f[1]});
  }
  return complex;
}

std::vector<Complex> complexes() {
  std::vector<Complex> all{
      {"empty", 0, {}, {}},
      {"isolated vertices", 3, {}, {}},
      {"one triangle", 3, {{2, 0, 1}}, {}},
      {"a strip and a yarn", 8, {{0, 1, 2}, {2, 1, 3}}, {{4, 5}, {6, 5}, {6, 7}}},
      {"two components that interleave", 6, {{0, 2, 4}, {5, 3, 1}}, {}},
      {"closed tetrahedron", 4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, {}},
      {"four sheets on one edge", 6, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {5, 1, 0}}, {}},
      {"edges alone", 4, {}, {{2, 1}, {1, 0}, {3, 2}}},
      {"a loose edge given twice and on a triangle", 4, {{0, 1, 2}}, {{1, 0}, {2, 3}, {3, 2}}},
  };
  for (unsigned seed = 1; seed <= 20; ++seed)
    all.push_back(random_complex(seed, 12 + static_cast<Index>(seed), 10 + 3 * static_cast<int>(seed), 6));
  return all;
}

std::vector<std::vector<Index>> rows(const CompressedRows& compressed) {
  std::vector<std::vector<Index>> result;
  for (std::size_t i = 0; i < compressed.rows(); ++i) result.emplace_back(compressed[i].begin(), compressed[i].end());
  return result;
}

bool contains(std::span<const Index> face, Index v) { return std::find(face.begin(), face.end(), v) != face.end(); }

std::vector<Edge> brute_force_edges(const Complex& complex) {
  std::set<Edge> edges;
  for (const auto& [a, b, c] : complex.triangles) edges.insert({ordered(a, b), ordered(b, c), ordered(c, a)});
  for (const auto& [a, b] : complex.loose_edges) edges.insert(ordered(a, b));
  return {edges.begin(), edges.end()};
}

// Returns rows; row i has all j for which `belongs(i, j)` is true.
template <class Belongs>
std::vector<std::vector<Index>> brute_force_rows(std::size_t row_count, std::size_t item_count,
                                                 const Belongs& belongs) {
  std::vector<std::vector<Index>> result(row_count);
  for (std::size_t i = 0; i < row_count; ++i) {
    for (std::size_t j = 0; j < item_count; ++j) {
      if (belongs(i, j)) result[i].push_back(static_cast<Index>(j));
    }
  }
  return result;
}

std::vector<Index> brute_force_components(const Topology& topology) {
  std::vector<Index> lowest(at(topology.vertex_count));
  for (std::size_t v = 0; v < lowest.size(); ++v) lowest[v] = static_cast<Index>(v);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : topology.edges) {
      const Index both = std::min(lowest[at(a)], lowest[at(b)]);
      changed = changed || lowest[at(a)] != both || lowest[at(b)] != both;
      lowest[at(a)] = lowest[at(b)] = both;
    }
  }
  std::map<Index, Index> numbers;
  for (Index& v : lowest) v = numbers.try_emplace(v, static_cast<Index>(numbers.size())).first->second;
  return lowest;
}

}  // namespace

TEST_CASE("edges are numbered by smaller, then larger vertex, without repetition", "[unit]") {
  for (const Complex& complex : complexes()) {
    INFO(complex.name);
    const Topology topology = build_topology(complex.vertex_count, complex.triangles, complex.loose_edges);
    CHECK(topology.edges == brute_force_edges(complex));
    CHECK(topology.triangles == complex.triangles);
    CHECK(topology.vertex_count == complex.vertex_count);
    REQUIRE(topology.triangle_edges.size() == complex.triangles.size());
    for (std::size_t t = 0; t < complex.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge expected = ordered(complex.triangles[t][k], complex.triangles[t][(k + 1) % 3]);
        CHECK(topology.edges[at(topology.triangle_edges[t][k])] == expected);
      }
    }
  }
}

TEST_CASE("adjacency around vertices and edges is what the definitions say", "[unit]") {
  for (const Complex& complex : complexes()) {
    INFO(complex.name);
    const Topology topology = build_topology(complex.vertex_count, complex.triangles, complex.loose_edges);
    const auto& triangles = complex.triangles;
    const auto& edges = topology.edges;
    const std::size_t vertices = at(complex.vertex_count);
    const auto holds = [&](std::size_t t, std::size_t e) {
      return contains(triangles[t], edges[e][0]) && contains(triangles[t], edges[e][1]);
    };
    const auto is_end = [&](std::size_t v, std::size_t e) { return contains(edges[e], static_cast<Index>(v)); };
    CHECK(rows(topology.vertex_triangles) ==
          brute_force_rows(vertices, triangles.size(), [&](std::size_t v, std::size_t t) {
            return contains(triangles[t], static_cast<Index>(v));
          }));
    CHECK(rows(topology.vertex_edges) == brute_force_rows(vertices, edges.size(), is_end));
    CHECK(rows(topology.vertex_neighbours) == brute_force_rows(vertices, vertices, [&](std::size_t v, std::size_t u) {
            return std::binary_search(edges.begin(), edges.end(),
                                      ordered(static_cast<Index>(v), static_cast<Index>(u)));
          }));
    CHECK(rows(topology.edge_triangles) ==
          brute_force_rows(edges.size(), triangles.size(), [&](std::size_t e, std::size_t t) { return holds(t, e); }));
    CHECK(rows(topology.edge_opposite) == brute_force_rows(edges.size(), vertices, [&](std::size_t e, std::size_t v) {
            if (is_end(v, e)) return false;
            for (std::size_t t = 0; t < triangles.size(); ++t) {
              if (holds(t, e) && contains(triangles[t], static_cast<Index>(v))) return true;
            }
            return false;
          }));
    CHECK(topology.component == brute_force_components(topology));
  }
}

TEST_CASE("boundary, hinges and non-manifold edges are those with one, two and more triangles", "[unit]") {
  for (const Complex& complex : complexes()) {
    INFO(complex.name);
    const Topology topology = build_topology(complex.vertex_count, complex.triangles, complex.loose_edges);
    std::vector<Index> boundary, hinged, non_manifold;
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const std::size_t count = topology.edge_triangles[e].size();
      if (count == 1) boundary.push_back(static_cast<Index>(e));
      if (count == 2) hinged.push_back(static_cast<Index>(e));
      if (count > 2) non_manifold.push_back(static_cast<Index>(e));
    }
    CHECK(topology.boundary_edges == boundary);
    CHECK(topology.non_manifold_edges == non_manifold);
    REQUIRE(topology.hinges.size() == hinged.size());
    for (std::size_t i = 0; i < hinged.size(); ++i) {
      const Hinge& hinge = topology.hinges[i];
      CHECK(hinge.edge == hinged[i]);
      CHECK(hinge.triangles[0] < hinge.triangles[1]);
      for (std::size_t k = 0; k < 2; ++k) {
        std::multiset<Index> parts(topology.edges[at(hinge.edge)].begin(), topology.edges[at(hinge.edge)].end());
        parts.insert(hinge.opposite[k]);
        const Triangle& corners = complex.triangles[at(hinge.triangles[k])];
        CHECK(parts == std::multiset<Index>(corners.begin(), corners.end()));
      }
    }
  }
}

TEST_CASE("find_edge finds every edge from both ends and nothing else", "[unit]") {
  for (const Complex& complex : complexes()) {
    INFO(complex.name);
    const Topology topology = build_topology(complex.vertex_count, complex.triangles, complex.loose_edges);
    for (Index a = 0; a < complex.vertex_count; ++a) {
      for (Index b = 0; b < complex.vertex_count; ++b) {
        const auto found = std::find(topology.edges.begin(), topology.edges.end(), ordered(a, b));
        const auto expected = found == topology.edges.end() ? -1 : static_cast<Index>(found - topology.edges.begin());
        CHECK(find_edge(topology, a, b) == expected);
      }
    }
  }
}

TEST_CASE("build_topology refuses indices that are out of range or repeated", "[unit]") {
  const std::vector<Triangle> too_large{{0, 1, 2}, {1, 2, 3}}, negative{{0, -1, 2}}, repeated{{0, 1, 0}};
  const std::vector<Edge> bad_edge{{0, 3}}, loop{{1, 1}};
  CHECK_THROWS_AS(build_topology(3, too_large), std::out_of_range);
  CHECK_THROWS_AS(build_topology(3, negative), std::out_of_range);
  CHECK_THROWS_AS(build_topology(3, repeated), std::out_of_range);
  CHECK_THROWS_AS(build_topology(3, {}, bad_edge), std::out_of_range);
  CHECK_THROWS_AS(build_topology(3, {}, loop), std::out_of_range);
}

TEST_CASE("a fan around one vertex costs no more than a sheet of the same size", "[unit]") {
  constexpr Index count = 200'000;
  std::vector<Triangle> fan;
  for (Index i = 1; i < count - 1; ++i) fan.push_back({0, i, i + 1});
  const Topology topology = build_topology(count, fan);
  CHECK(topology.edges.size() == 2 * fan.size() + 1);
  CHECK(topology.vertex_triangles[0].size() == fan.size());
  CHECK(topology.hinges.size() == fan.size() - 1);
}
