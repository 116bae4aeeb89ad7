#include "compare/oracle/audit.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "tests/catch.hpp"
#include "tests/compare/oracle/rational_intersection.hpp"

using namespace ogc::compare;

namespace {

using Kind = IntersectionKind;

/// A horizontal triangle 0 1 2, and a triangle 3 4 5 that hangs above it with `tip` as its first corner.
struct TwoTriangles {
  std::vector<Vec3> positions;
  Topology topology = build_topology(6, std::array{Triangle{0, 1, 2}, Triangle{3, 4, 5}});
  explicit TwoTriangles(Vec3 tip) : positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, tip, {1, 1, 5}, {2, 1, 5}} {}
  AuditResult audit(std::span<const Index> groups = {}) const {
    return ogc::compare::audit(topology, positions, groups);
  }
};

Intersection edge_meets(const Topology& topology, Index a, Index b, Index triangle) {
  return {Kind::edge_triangle, find_edge(topology, a, b), triangle};
}

/// Returns the intersections of all pairs by rational brute force; isolated vertices belong to no surface.
std::vector<Intersection> all_pairs(const Topology& topology, const std::vector<Vec3>& positions) {
  std::vector<Intersection> found;
  const auto at = [&](Index v) { return positions[static_cast<std::size_t>(v)]; };
  const auto test = [&](Kind kind, Index name, Edge e) {
    for (std::size_t i = 0; i < topology.triangles.size(); ++i) {
      const Triangle& t = topology.triangles[i];
      const bool adjacent = std::any_of(t.begin(), t.end(), [&](Index v) { return v == e[0] || v == e[1]; });
      if (!adjacent && ogc::tests::hulls_meet({at(e[0]), at(e[1])}, {at(t[0]), at(t[1]), at(t[2])}))
        found.push_back({kind, name, static_cast<Index>(i)});
    }
  };
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    test(Kind::edge_triangle, static_cast<Index>(e), topology.edges[e]);
  for (Index v = 0; v < topology.vertex_count; ++v)
    if (topology.vertex_edges[static_cast<std::size_t>(v)].size() > 0) test(Kind::vertex_triangle, v, {v, v});
  // Adds intersections of an edge and a triangle with one common vertex, if the edge meets the opposite edge of the
  // triangle.
  std::vector<Intersection> sides;
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    for (const Triangle& t : topology.triangles) {
      std::vector<Index> others;
      const auto& [a, b] = topology.edges[e];
      std::ranges::copy_if(t, std::back_inserter(others), [&](Index v) { return v != a && v != b; });
      if (others.size() != 2) continue;
      const Index side = find_edge(topology, others[0], others[1]), edge = static_cast<Index>(e);
      if (ogc::tests::hulls_meet({at(a), at(b)}, {at(others[0]), at(others[1]), at(others[1])}))
        sides.push_back({Kind::edge_edge, std::min(edge, side), std::max(edge, side)});
    }
  std::ranges::sort(sides);
  found.insert(found.end(), sides.begin(), std::ranges::unique(sides).begin());
  return found;
}

/// An n × n grid on the unit square, rolled up to a spiral whose layers do not touch. `shear` tilts it against the
/// coordinate planes.
struct RolledSheet {
  std::vector<Vec3> positions;
  Topology topology;
  explicit RolledSheet(Index n, double shear = 0) {
    std::vector<Triangle> triangles;
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const double angle = 6 * double(i) / double(n - 1) * 3.141592653589793, radius = 0.1 + 0.02 * angle,
                     z = double(j) / double(n - 1);
        positions.push_back({radius * std::cos(angle) + shear * z, radius * std::sin(angle), z});
        const Index v = i * n + j;
        if (i + 1 < n && j + 1 < n)
          triangles.insert(triangles.end(), {Triangle{v, v + n, v + n + 1}, Triangle{v, v + n + 1, v + 1}});
      }
    }
    topology = build_topology(n * n, triangles);
  }
};

}  // namespace

TEST_CASE("two triangles apart are clean", "[unit]") {
  const AuditResult result = TwoTriangles({1, 1, 0x1p-60}).audit();
  CHECK(result.count == 0);
  CHECK(result.intersections.empty());
}

TEST_CASE("an isolated vertex on a triangle is no intersection: files of other programs hold unused ones", "[unit]") {
  const Topology topology = build_topology(5, std::vector<Triangle>{{0, 1, 2}}, std::vector<Edge>{{0, 4}});
  const std::vector<Vec3> positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {1, 1, 0}};
  CHECK(audit(topology, positions).intersections == std::vector{Intersection{Kind::vertex_triangle, 4, 0}});
}

TEST_CASE("edges that pierce a triangle are listed, and edges that they cross on the way too", "[unit]") {
  const TwoTriangles mesh({1, 1, -1});
  const AuditResult result = mesh.audit();
  CHECK(result.intersections == std::vector{edge_meets(mesh.topology, 3, 4, 0), edge_meets(mesh.topology, 3, 5, 0)});
  CHECK(result.count == 2);
  CHECK(result.pairs_tested >= 2);
}

TEST_CASE("a vertex that lies on a triangle is listed, and so are its edges, which touch it", "[unit]") {
  for (const Vec3 tip : {Vec3{1, 1, 0}, Vec3{0.5, 0.25, 0}}) {
    const TwoTriangles mesh(tip);
    const AuditResult result = mesh.audit();
    CHECK(result.intersections == std::vector{edge_meets(mesh.topology, 3, 4, 0), edge_meets(mesh.topology, 3, 5, 0),
                                              Intersection{Kind::vertex_triangle, 3, 0}});
  }
}

TEST_CASE("a vertex on an edge of another component touches the triangle, and that edge touches the vertex's triangle",
          "[unit]") {
  const TwoTriangles mesh({2, 0, 0});
  CHECK(mesh.audit().intersections ==
        std::vector{edge_meets(mesh.topology, 0, 1, 1), edge_meets(mesh.topology, 3, 4, 0),
                    edge_meets(mesh.topology, 3, 5, 0), Intersection{Kind::vertex_triangle, 3, 0}});
}

TEST_CASE("two components that meet in a corner each lie on the other", "[unit]") {
  const TwoTriangles mesh({0, 0, 0});
  CHECK(mesh.audit().intersections ==
        std::vector{edge_meets(mesh.topology, 0, 1, 1), edge_meets(mesh.topology, 0, 2, 1),
                    edge_meets(mesh.topology, 3, 4, 0), edge_meets(mesh.topology, 3, 5, 0),
                    Intersection{Kind::vertex_triangle, 0, 1}, Intersection{Kind::vertex_triangle, 3, 0}});
}

TEST_CASE("coplanar triangles that overlap are found even where no vertex lies on the other", "[unit]") {
  // The triangles form a star: every edge of one crosses two edges of the other, and no corner lies inside.
  const std::vector<Vec3> positions{{0, 3, 1}, {3, -2, 1}, {-3, -2, 1}, {0, -3, 1}, {3, 2, 1}, {-3, 2, 1}};
  const Topology topology = build_topology(6, std::array{Triangle{0, 1, 2}, Triangle{3, 4, 5}});
  const AuditResult result = audit(topology, positions);
  CHECK(result.count == 6);
  CHECK(std::none_of(result.intersections.begin(), result.intersections.end(),
                     [](const Intersection& i) { return i.kind == Kind::vertex_triangle; }));
}

TEST_CASE("triangles that are folded onto each other along an edge are listed by their corners and sides", "[unit]") {
  const std::vector<Vec3> folded{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}};
  const Topology topology = build_topology(4, std::array{Triangle{0, 1, 2}, Triangle{1, 0, 3}});
  const auto edge = [&](Index a, Index b) { return find_edge(topology, a, b); };
  // Vertex 2 lies on triangle 1, which does not contain it, and vertex 3 lies on triangle 0. At this point, (0, 1, 0),
  // edges of both triangles meet.
  CHECK(audit(topology, folded).intersections == std::vector{Intersection{Kind::vertex_triangle, 2, 1},
                                                             Intersection{Kind::vertex_triangle, 3, 0},
                                                             Intersection{Kind::edge_edge, edge(0, 2), edge(1, 3)},
                                                             Intersection{Kind::edge_edge, edge(0, 3), edge(1, 2)}});
}

TEST_CASE("curves that touch or cross in a point are listed, by the edges of no triangle alone", "[unit]") {
  // The scene is a triangle 0 1 2, a chain 3 4 5 that crosses edge 6 7, and an edge 8 9 that ends on edge 6 7.
  const std::vector<Vec3> positions{{5, 5, 5}, {6, 5, 5},  {5, 6, 5}, {-1, 0, 0},  {1, 0, 0},
                                    {2, 1, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0.5, 0}, {0, 0.5, 3}};
  const Topology topology = build_topology(10, std::vector<Triangle>{{0, 1, 2}},
                                           std::vector<Edge>{{3, 4}, {4, 5}, {6, 7}, {8, 9}});
  const auto edge = [&](Index a, Index b) { return find_edge(topology, a, b); };
  const AuditResult result = audit(topology, positions);
  CHECK(result.intersections == std::vector{Intersection{Kind::edge_edge, edge(3, 4), edge(6, 7)},
                                            Intersection{Kind::edge_edge, edge(6, 7), edge(8, 9)}});
  CHECK(describe(result.intersections[0], topology) == "edge (vertices 3, 4) meets edge (vertices 6, 7)");
  CHECK(audit(topology, positions, std::vector<Index>{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0}).count == 0);
  std::vector<Vec3> apart = positions;
  apart[6].z = apart[7].z = 0x1p-60;
  apart[8].y = 2;
  CHECK(audit(topology, apart).count == 0);
  // Edges of two triangles in one plane cross. The audit lists a crossing as edge and triangle, not again as two edges.
  const std::vector<Vec3> flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, -1, 0}, {1, 5, 0}, {9, 9, 0}};
  const AuditResult plane = audit(build_topology(6, std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}), flat);
  CHECK(std::none_of(plane.intersections.begin(), plane.intersections.end(),
                     [](const Intersection& i) { return i.kind == Kind::edge_edge; }));
}

TEST_CASE("a pair inside one rigid group is left out, a pair of two groups is not", "[unit]") {
  const TwoTriangles mesh({1, 1, -1});
  CHECK(mesh.audit(std::vector<Index>(6, 2)).count == 0);
  CHECK(mesh.audit(std::vector<Index>(6, 0)).count == 0);
  CHECK(mesh.audit(std::vector<Index>(6, -1)).count == 2);
  CHECK(mesh.audit(std::vector<Index>{0, 0, 0, 1, 1, 1}).count == 2);
  CHECK(mesh.audit(std::vector<Index>{0, 0, -1, 0, 0, 0}).count == 2);
  // edge 3–5 lies within the group, edge 3–4 does not
  CHECK(mesh.audit(std::vector<Index>{0, 0, 0, 0, 1, 0}).count == 1);
}

TEST_CASE("a pair beside an excluded pair of vertices is left out, either way round, others are not", "[unit]") {
  const TwoTriangles mesh({1, 1, -1});
  const auto count = [&](std::vector<std::array<Index, 2>> pairs) {
    const Exclusions exclusions{{}, partner_rows(6, pairs)};
    return audit(mesh.topology, mesh.positions, exclusions).count;
  };
  CHECK(count({{5, 0}}) == 1);  // leaves out edge 3–5, not edge 3–4
  CHECK(count({{0, 5}}) == 1);
  CHECK(count({{4, 1}, {2, 5}}) == 0);
  CHECK(count({{2, 3}}) == 0);          // vertex 3 is on both edges, vertex 2 on the triangle
  CHECK(count({{4, 5}, {0, 1}}) == 2);  // both vertices of a pair belong to one triangle
}

TEST_CASE("collapsed triangles and loose edges are audited like the rest", "[unit]") {
  const std::vector<Vec3> positions{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, -1, -1}, {1, 1, 1}, {5, 5, 5}};
  const Topology topology = build_topology(6, std::vector<Triangle>{{0, 1, 2}}, std::array{Edge{3, 4}, Edge{4, 5}});
  CHECK(audit(topology, positions).intersections == std::vector{edge_meets(topology, 3, 4, 0)});
  // All vertices are at one point: two edges and three vertices lie on the triangle, and an end of one edge lies on the
  // other edge.
  CHECK(audit(topology, std::vector<Vec3>(6, Vec3{1, 1, 1})).count == 6);
  CHECK(audit(build_topology(0, {}), {}).count == 0);
}

TEST_CASE("an audit lists no more than the limit and counts on", "[unit]") {
  const TwoTriangles mesh({1, 1, 0});
  const AuditResult result = audit(mesh.topology, mesh.positions, {}, {.limit = 2});
  CHECK(result.count == 3);
  CHECK(result.intersections == std::vector{edge_meets(mesh.topology, 3, 4, 0), edge_meets(mesh.topology, 3, 5, 0)});
}

TEST_CASE("a state that is not finite, or of another mesh, is refused with the vertex or the sizes", "[unit]") {
  TwoTriangles mesh({1, 1, 1});
  mesh.positions[4].y = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(mesh.audit(), ContainsSubstring("vertex 4"));
  mesh.positions[4].y = -std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(mesh.audit(), InputError);
  mesh.positions.pop_back();
  CHECK_THROWS_WITH(mesh.audit(), ContainsSubstring("5 positions") && ContainsSubstring("6 vertices"));
  CHECK_THROWS_AS(TwoTriangles({1, 1, 1}).audit(std::vector<Index>(3, 0)), InputError);
}

TEST_CASE("a description names kinds, numbers, vertices, bodies, files and lines", "[unit]") {
  const TwoTriangles mesh({1, 1, 0});
  AuditResult result = mesh.audit();
  CHECK(describe(result, mesh.topology) ==
        "edge (vertices 3, 4) meets triangle 0 (vertices 0, 1, 2)\n"
        "edge (vertices 3, 5) meets triangle 0 (vertices 0, 1, 2)\n"
        "vertex 3 lies on triangle 0 (vertices 0, 1, 2)\n");
  result.intersections.erase(result.intersections.begin(), result.intersections.begin() + 2);
  Scene scene;
  scene.bodies = {{.name = "floor", .vertex_count = 3, .triangle_count = 1, .material = {}},
                  {.name = "cloth",
                   .first_vertex = 3,
                   .vertex_count = 3,
                   .first_triangle = 1,
                   .triangle_count = 1,
                   .material = {}}};
  CHECK(
      describe(result, mesh.topology, ElementNames(scene)) ==
      "vertex 0 of body 'cloth' (3 in the scene) lies on triangle 0 of body 'floor' (vertices 0, 1, 2)\nand 2 more\n");
  MeshSource obj{.file = "x.obj",
                 .first = 1,
                 .vertices = {},
                 .first_faces = {},
                 .faces = {4, 6},
                 .vertex_lines = {1, 2, 3, 4, 6, 7},
                 .face_lines = {8, 9, 10, 11, 12, 13, 14},
                 .edge_lines = {}};
  CHECK(describe(result, mesh.topology, ElementNames(obj)) ==
        "vertex 4 (line 4) lies on face 5 (vertices 1, 2, 3; line 12)\nand 2 more\n");
  obj.shares_vertices = false;
  obj.first_faces = {4, 4, 4, 6, 6, 6};
  obj.face_lines.clear();
  CHECK(describe(result, mesh.topology, ElementNames(obj)) == "a vertex of face 7 lies on face 5\nand 2 more\n");
  CHECK(describe(AuditResult{}, mesh.topology).empty());
}

TEST_CASE(
    "the audit finds what brute force over all pairs finds in rational numbers, and a power of two changes nothing",
    "[property]") {
  std::mt19937 random(5);
  std::size_t findings = 0;
  for (const int size : {2, 3, 6, 1 << 20}) {
    std::uniform_int_distribution<int> coordinate(0, size);
    std::uniform_int_distribution<Index> vertex(0, 11);
    for (int trial = 0; trial < 4; ++trial) {
      std::vector<Vec3> positions(12);
      for (Vec3& p : positions) p = {0.1 * coordinate(random), 0.1 * coordinate(random), 0.1 * coordinate(random)};
      std::vector<Triangle> triangles;
      while (triangles.size() < 8) {
        const Triangle t{vertex(random), vertex(random), vertex(random)};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
      }
      const Topology topology = build_topology(12, triangles, std::array{Edge{0, 11}, Edge{1, 10}});
      const std::vector<Intersection> expected = all_pairs(topology, positions);
      REQUIRE(audit(topology, positions).intersections == expected);
      findings += expected.size();
      for (const double scale : {0x1p-20, 0x1p20}) {
        std::vector<Vec3> scaled = positions;
        for (Vec3& p : scaled) p = {scale * p.x, scale * p.y, scale * p.z};
        REQUIRE(audit(topology, scaled).intersections == expected);
      }
    }
  }
  CHECK(findings > 100);
}

TEST_CASE("the answer does not depend on the number of threads", "[property]") {
  RolledSheet sheet(40);
  for (std::size_t i = 0; i < sheet.positions.size(); i += 7) sheet.positions[i].x = -sheet.positions[i].x;
  const AuditResult parallel = audit(sheet.topology, sheet.positions);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const AuditResult serial = audit(sheet.topology, sheet.positions);
  CHECK(parallel.count > 1000);
  CHECK(parallel.intersections == serial.intersections);
  CHECK(parallel.count == serial.count);
  CHECK(parallel.pairs_tested == serial.pairs_tested);
}

TEST_CASE("a rolled sheet of ten thousand vertices is clean, and one vertex pushed through a layer is found",
          "[property]") {
  for (const double shear : {0.0, 0.3}) {
    RolledSheet sheet(100, shear);
    const auto begin = std::chrono::steady_clock::now();
    const AuditResult clean = audit(sheet.topology, sheet.positions);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    WARN("audit of " << sheet.positions.size() << " vertices: " << seconds << " s, " << clean.pairs_tested << " pairs");
    CHECK(clean.count == 0);
    Vec3& vertex = sheet.positions[50 * 100 + 50];  // the layers are 0.126 m apart
    vertex = {vertex.x * 1.9, vertex.y * 1.9, vertex.z};
    CHECK(audit(sheet.topology, sheet.positions).count > 0);
  }
}
