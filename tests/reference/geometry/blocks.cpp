// Tests the four properties of blocks of §3.3 as theorems, on random and handmade meshes, and the boundaries of Eq.
// 8–10, 14 and 15 as printed.
#include "reference/geometry/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "tests/catch.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Face;
using compare::FaceKind;
using reference::Complex;
using reference::edge_face;
using reference::in_block;
using reference::in_edge_only_block;
using reference::triangle_face;
using reference::vertex_face;

namespace {

Surface tetrahedron() {
  return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}, {}, {}};
}

/// Returns four triangles around vertex 0, whose neighbours lie alternately above and below it.
Surface saddle() {
  return {{{0, 0, 0}, {2, 0, 1}, {0, 2, -1}, {-2, 0, 1}, {0, -2, -1}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}},
          {},
          {}};
}

/// Returns three triangles on the edge from vertex 0 to vertex 1.
Surface fan() {
  return {{{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, -3, 1}, {2, 0, 4}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}, {}, {}};
}

/// Returns the distance from x to the closed face.
double distance_to(const Complex& mesh, Face face, const Vec3f& x) {
  const auto v = mesh.vertices(face).items;
  if (face.kind == FaceKind::vertex) return reference::distance(reference::gap_points(mesh.at(v[0]), x));
  if (face.kind == FaceKind::edge) {
    const reference::EdgePair pair{{mesh.at(v[0]), mesh.at(v[1])}, {x, x}};
    return reference::distance(reference::feature_gap(pair, reference::closest_features(pair)));
  }
  const reference::Corners corners{mesh.at(v[0]), mesh.at(v[1]), mesh.at(v[2])};
  return reference::distance(reference::feature_gap(corners, reference::closest_feature(corners, x), x));
}

std::vector<Face> faces_of(const Complex& mesh, Index t) {
  std::vector<Face> faces;
  for (const Index v : mesh.triangle(t)) faces.push_back(vertex_face(v));
  for (const Index e : mesh.topology.triangle_edges[static_cast<std::size_t>(t)]) faces.push_back(edge_face(e));
  faces.push_back(triangle_face(t));
  return faces;
}

bool is_part(const Complex& mesh, Face a, Face b) {
  const auto u = mesh.vertices(a), v = mesh.vertices(b);
  return a.kind < b.kind && std::includes(v.span().begin(), v.span().end(), u.span().begin(), u.span().end());
}

struct Counts {
  int inside = 0, covered = 0, shared = 0, uncovered = 0, farther = 0;
};

/// Counts at x the faces whose block contains x, and the violations of the properties of blocks (§3.3).
void examine(const Complex& mesh, const Vec3f& x, float r, Counts& counts) {
  bool within = false, covered = false;
  for (std::size_t t = 0; t < mesh.topology.triangles.size(); ++t) {
    const auto number = static_cast<Index>(t);
    const auto faces = faces_of(mesh, number);
    const double to_triangle = distance_to(mesh, triangle_face(number), x);
    within = within || to_triangle <= r;
    for (const Face a : faces) {
      if (!in_block(mesh, a, x, r)) continue;
      covered = true;
      ++counts.inside;
      for (const Face b : faces) {
        if (is_part(mesh, a, b) || is_part(mesh, b, a)) counts.shared += in_block(mesh, b, x, r);
        const double to_a = distance_to(mesh, a, x), to_b = distance_to(mesh, b, x);
        if (is_part(mesh, a, b)) counts.farther += to_b < to_a;   // equal if the closest point of b lies on a
        if (is_part(mesh, b, a)) counts.farther += to_b <= to_a;  // strict
      }
    }
  }
  counts.covered += covered;
  counts.uncovered += within != covered;
}

Counts examine_around(const Surface& surface, std::mt19937& random, int points, float r) {
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  Counts counts;
  std::uniform_int_distribution<std::size_t> pick(0, surface.positions.size() - 1);
  std::uniform_real_distribution<float> move(-2 * r, 2 * r);
  for (int k = 0; k < points; ++k) {
    const Vec3f& x = surface.positions[pick(random)];
    examine(mesh, {x.x + move(random), x.y + move(random), x.z + move(random)}, r, counts);
  }
  return counts;
}

void check_properties(const Counts& counts) {
  CHECK(counts.inside > 100);
  CHECK(counts.covered > 100);
  CHECK(counts.shared == 0);
  CHECK(counts.uncovered == 0);
  CHECK(counts.farther == 0);
}

}  // namespace

TEST_CASE("blocks: exclusive, covering up to d = r and locally closest on random and hand-made meshes", "[property]") {
  std::mt19937 random(4);
  check_properties(examine_around(jittered(grid(5), random, 0.6f), random, 400, 0.7f));
  check_properties(examine_around(tetrahedron(), random, 1000, 1.5f));
  check_properties(examine_around(saddle(), random, 1000, 1));
  check_properties(examine_around(fan(), random, 1000, 1));
  check_properties(examine_around(soup(12, 20, random), random, 500, 0.2f));
}

TEST_CASE("blocks: exclusive, covering and locally closest on points of integer lattices, where many lie on boundaries",
          "[property]") {
  for (const Surface& surface : {tetrahedron(), saddle(), fan(), grid(3, 0, 2), mapped(grid(3), turned)}) {
    const auto topology = surface.topology();
    const Complex mesh{topology, surface.positions};
    Counts counts;
    const float step = surface.positions[1].x > 4 ? 12.5f : 1;
    for (int i = -3; i <= 5; ++i) {
      for (int j = -3; j <= 5; ++j) {
        for (int k = -3; k <= 5; ++k) {
          examine(mesh, {static_cast<float>(i) * step, static_cast<float>(j) * step, static_cast<float>(k) * step},
                  3 * step, counts);
        }
      }
    }
    check_properties(counts);
  }
}

TEST_CASE("blocks: the distance r is inside, the next float beyond it is not", "[unit]") {
  const Surface surface = grid(3, 0, 4);
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const float r = 1.5f, beyond = std::nextafter(r, 2.0f);
  CHECK(in_block(mesh, vertex_face(4), {4, 4, r}, r));
  CHECK_FALSE(in_block(mesh, vertex_face(4), {4, 4, beyond}, r));
  const Index e = compare::find_edge(topology, 3, 4);
  CHECK(in_block(mesh, edge_face(e), {1, 4, r}, r));
  CHECK_FALSE(in_block(mesh, edge_face(e), {1, 4, beyond}, r));
  CHECK(in_block(mesh, triangle_face(0), {1, 1, -r}, r));
  CHECK_FALSE(in_block(mesh, triangle_face(0), {1, 1, -beyond}, r));
}

TEST_CASE(
    "blocks: an edge block is open at its ends and closed at its side planes, a boundary edge's is half a cylinder",
    "[unit]") {
  const Surface surface = grid(3, 0, 4);
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const Index inner = compare::find_edge(topology, 3, 4), outer = compare::find_edge(topology, 0, 1);
  CHECK_FALSE(in_block(mesh, edge_face(inner), {0, 4, 1}, 2));
  CHECK(in_block(mesh, edge_face(inner), {0x1p-100f, 4, 1}, 2));
  CHECK(in_block(mesh, edge_face(inner), {1, 4, 1}, 2));
  CHECK_FALSE(in_block(mesh, edge_face(inner), {1, 4 + 0x1p-20f, 1}, 2));
  CHECK(in_block(mesh, edge_face(outer), {1, -1, 1}, 2));
  CHECK(in_block(mesh, edge_face(outer), {1, 0, 1}, 2));
  CHECK_FALSE(in_block(mesh, edge_face(outer), {1, 0x1p-100f, 1}, 2));
}

TEST_CASE("blocks: the block of a saddle vertex is the vertex itself", "[unit]") {
  const Surface surface = saddle();
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  CHECK(in_block(mesh, vertex_face(0), {0, 0, 0}, 1));
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0, 0.3f);
  for (int k = 0; k < 2000; ++k)
    CHECK_FALSE(in_block(mesh, vertex_face(0), {normal(random), normal(random), normal(random)}, 1));
}

TEST_CASE(
    "blocks: every vertex around a non-manifold edge cuts its block; an edge without triangles keeps the whole "
    "cylinder",
    "[unit]") {
  Surface surface = fan();
  surface.loose_edges = {{2, 3}};
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const Index spine = compare::find_edge(topology, 0, 1), loose = compare::find_edge(topology, 2, 3);
  // The opposite vertices lie towards +y, −y (slightly up) and +z. Only directions near −z with a small y point away
  // from all three.
  CHECK(in_block(mesh, edge_face(spine), {2, 0, -1}, 1));
  CHECK_FALSE(in_block(mesh, edge_face(spine), {2, 0, 1}, 1));
  CHECK_FALSE(in_block(mesh, edge_face(spine), {2, 0.5f, -0.5f}, 1));
  CHECK_FALSE(in_block(mesh, edge_face(spine), {2, -0.9f, -0.1f}, 1));
  for (const float side : {-1.0f, 1.0f}) {
    CHECK(in_block(mesh, edge_face(loose), {2 + side, 0, 0.5f}, 1));
    CHECK(in_edge_only_block(mesh, edge_face(loose), {2 + side, 0, 0.5f}, 1));
  }
}

TEST_CASE(
    "blocks: in the edge-only manifold an edge has the whole cylinder and a vertex the ball cut by its neighbours' "
    "planes",
    "[unit]") {
  const Surface surface = grid(3, 0, 4);
  const auto topology = surface.topology();
  const Complex mesh{topology, surface.positions};
  const Index inner = compare::find_edge(topology, 3, 4);
  CHECK(in_edge_only_block(mesh, edge_face(inner), {1, 5, 1}, 2));
  CHECK_FALSE(in_block(mesh, edge_face(inner), {1, 5, 1}, 2));
  CHECK_FALSE(in_edge_only_block(mesh, edge_face(inner), {0, 5, 1}, 2));
  CHECK(in_edge_only_block(mesh, vertex_face(4), {4, 4, 2}, 2));
  CHECK_FALSE(in_edge_only_block(mesh, vertex_face(4), {4, 4.25f, 1}, 2));
  CHECK(in_edge_only_block(mesh, vertex_face(0), {-1, -1, 1}, 2));
}
