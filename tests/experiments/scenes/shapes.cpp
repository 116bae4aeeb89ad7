#include "experiments/scenes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;
using namespace ogc::experiments;

namespace {

Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3 normal(const Mesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.positions[at(t[0])];
  return cross(difference(mesh.positions[at(t[1])], a), difference(mesh.positions[at(t[2])], a));
}

/// Returns the volume inside a surface with outward normals [m³].
double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const Triangle& t : mesh.triangles)
    volume += dot(mesh.positions[at(t[0])], cross(mesh.positions[at(t[1])], mesh.positions[at(t[2])])) / 6;
  return volume;
}

Topology topology_of(const Mesh& mesh) {
  return build_topology(static_cast<Index>(mesh.positions.size()), mesh.triangles);
}

}  // namespace

TEST_CASE("a grid has the paper's numbers of vertices and triangles and is a valid disc", "[unit]") {
  const auto [count, vertices, triangles] = GENERATE(std::array{2, 4, 2}, std::array{3, 9, 8},
                                                     std::array{70, 4900, 9522}, std::array{100, 10000, 19602});
  const Mesh mesh = grid(count, 1, 0.3);
  CHECK(mesh.positions.size() == at(vertices));
  CHECK(mesh.triangles.size() == at(triangles));
  CHECK(validate(mesh).empty());
  const Topology topology = topology_of(mesh);
  CHECK(topology.boundary_edges.size() == at(4 * (count - 1)));
  CHECK(topology.non_manifold_edges.empty());
  CHECK(vertices - static_cast<int>(topology.edges.size()) + triangles == 1);
}

TEST_CASE("a grid spans its square, lies in its plane, faces up, and every cell has half of its area in each triangle",
          "[unit]") {
  constexpr Index count = 5;
  const Mesh mesh = grid(count, 1, 0.25);
  CHECK(mesh.positions.front() == Vec3{-0.5, 0.25, -0.5});
  CHECK(mesh.positions[1] == Vec3{-0.5, 0.25, -0.25});
  CHECK(mesh.positions.back() == Vec3{0.5, 0.25, 0.5});
  for (const Triangle& t : mesh.triangles) CHECK(normal(mesh, t) == Vec3{0, 0.0625, 0});
}

TEST_CASE("the diagonals of a grid alternate: (i, j) to (i+1, j+1) where i + j is even", "[unit]") {
  constexpr Index count = 6;
  const Topology topology = topology_of(grid(count, 1, 0));
  for (Index i = 0; i + 1 < count; ++i) {
    for (Index j = 0; j + 1 < count; ++j) {
      const Index a = i * count + j;
      const bool even = (i + j) % 2 == 0;
      CHECK((find_edge(topology, a, a + count + 1) >= 0) == even);
      CHECK((find_edge(topology, a + 1, a + count) >= 0) == !even);
    }
  }
}

TEST_CASE("an icosphere has 10 · 4ⁿ + 2 vertices, is closed, and faces outwards", "[unit]") {
  const auto [subdivisions, vertices] = GENERATE(std::array{0, 12}, std::array{1, 42}, std::array{2, 162},
                                                 std::array{3, 642});
  const Vec3 centre{-0.15, 0, 0.5};
  const Mesh mesh = icosphere(subdivisions, 0.262, centre);
  CHECK(mesh.positions.size() == at(vertices));
  CHECK(mesh.triangles.size() == at(2 * vertices - 4));
  CHECK(validate(mesh).empty());
  const Topology topology = topology_of(mesh);
  CHECK(topology.boundary_edges.empty());
  CHECK(topology.hinges.size() == topology.edges.size());
  for (const Triangle& t : mesh.triangles)
    CHECK(dot(normal(mesh, t), difference(mesh.positions[at(t[0])], centre)) > 0);
}

TEST_CASE("all vertices of an icosphere lie on the sphere up to rounding", "[unit]") {
  const Vec3 centre{-0.15, 0, 0};
  const double radius = 0.262, rounding = 16 * 0x1p-53;
  for (const Vec3& v : icosphere(3, radius, centre).positions) {
    CHECK(std::abs(std::sqrt(dot(difference(v, centre), difference(v, centre))) - radius) <= rounding);
  }
}

TEST_CASE("a cylinder is a closed surface of its volume that looks outwards, and never leaves the round one",
          "[unit]") {
  const CylinderCells cells = GENERATE(CylinderCells{}, CylinderCells{3, 2, 0}, CylinderCells{24, 9, 3});
  const Vec3 centre{-0.25, 0.5, 1};
  const Mesh mesh = cylinder(cells, 0.25, 0.5, centre);
  CHECK(mesh.positions.size() == at(cells.around * (cells.along + 2 * cells.cap) + 2));
  CHECK(validate(mesh).empty());
  const Topology topology = topology_of(mesh);
  CHECK(topology.boundary_edges.empty());
  CHECK(topology.non_manifold_edges.empty());
  CHECK(mesh.positions.size() + mesh.triangles.size() == topology.edges.size() + 2);
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = difference(mesh.positions[at(t[0])], centre);
    volume += dot(a,
                  cross(difference(mesh.positions[at(t[1])], centre), difference(mesh.positions[at(t[2])], centre))) /
              6;
  }
  const double corner = 2 * std::numbers::pi / cells.around;
  CHECK(volume == Approx(0.5 * cells.around * 0.25 * 0.25 * std::sin(corner) / 2));
  for (const Vec3& v : mesh.positions) {
    CHECK(std::hypot(v.x - centre.x, v.y - centre.y) <= 0.25 * (1 + 0x1p-39));
    CHECK(std::abs(v.z - centre.z) <= 0.25);
  }
}

TEST_CASE("the paper's cylinder has 1,224 vertices, none of them a hair's breadth off an axis", "[unit]") {
  CHECK(cylinder({}, 0.25, 0.5, {}).positions.size() == 1224);
  CHECK(validate(cylinder({24, 2, 0}, 0.25, 0.5, {})).empty());
}

TEST_CASE("the ground's triangles have at most a hundred times the area of the cloth's", "[unit]") {
  for (const Index count : {14, 28, 70, 141}) {
    const Mesh mesh = ground(count, -0.60);
    const double cloth_cell = 1.0 / (count - 1),
                 ground_cell = 4.0 / (std::sqrt(static_cast<double>(mesh.positions.size())) - 1);
    CHECK(ground_cell <= 10 * cloth_cell * (1 + 1e-12));
    CHECK(mesh.positions.front() == Vec3{-2, -0.60, -2});
  }
}

TEST_CASE("a capsule is a closed surface that looks outwards, with every vertex at its radius from the axis",
          "[unit]") {
  const auto [from, to] = GENERATE(
      std::array<Vec3, 2>{{{0, 0, 0}, {0, 0.5, 0}}}, std::array<Vec3, 2>{{{0.25, -0.125, 0.5}, {-0.25, 0.375, 0.25}}},
      std::array<Vec3, 2>{{{0, 0, 0.5}, {0, 0, 0}}}, std::array<Vec3, 2>{{{1, 0, 0}, {0.5, 0, 0}}});
  const CapsuleCells cells{32, 6, 8};
  const Mesh mesh = capsule(cells, 0.125, from, to);
  CHECK(mesh.positions.size() == at(cells.around * (cells.along + 2 * cells.cap - 1) + 2));
  CHECK(mesh.triangles.size() == 2 * mesh.positions.size() - 4);
  CHECK(validate(mesh).empty());
  const Topology topology = topology_of(mesh);
  CHECK(topology.boundary_edges.empty());
  CHECK(topology.non_manifold_edges.empty());
  const Vec3 axis = difference(to, from);
  const double length = std::sqrt(dot(axis, axis));
  for (const Vec3& v : mesh.positions) {
    const double share = std::clamp(dot(difference(v, from), axis) / dot(axis, axis), 0.0, 1.0);
    const Vec3 off = difference(v, {from.x + share * axis.x, from.y + share * axis.y, from.z + share * axis.z});
    CHECK(std::sqrt(dot(off, off)) == Approx(0.125).margin(2e-6));
  }
  // The volume is up to 3 % below that of a round capsule, because the mesh has 32 corners around and eight rings to
  // each pole.
  CHECK(volume_of(mesh) == Approx(std::numbers::pi * 0.125 * 0.125 * (length + 4.0 / 3 * 0.125)).epsilon(0.03));
  CHECK(validate(capsule({3, 1, 1}, 0.125, from, to)).empty());
}

TEST_CASE("a box is a closed surface of its volume that looks outwards", "[unit]") {
  const auto cells = GENERATE(std::array<Index, 3>{1, 1, 1}, std::array<Index, 3>{2, 1, 3},
                              std::array<Index, 3>{4, 5, 6});
  const Mesh mesh = box(cells, {-0.5, 0.25, 1}, {0.5, 0.5, 1.5});
  const auto [a, b, c] = cells;
  CHECK(mesh.positions.size() == at((a + 1) * (b + 1) * (c + 1) - (a - 1) * (b - 1) * (c - 1)));
  CHECK(mesh.triangles.size() == at(4 * (a * b + b * c + c * a)));
  CHECK(validate(mesh).empty());
  CHECK(topology_of(mesh).boundary_edges.empty());
  CHECK(volume_of(mesh) == Approx(0.125));
}
