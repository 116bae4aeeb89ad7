// Closed formulas only, so that a scene is the same wherever it is generated.
#include "experiments/scenes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ogc::experiments {
namespace {

using compare::Edge;
using compare::Index;
using compare::Mesh;
using compare::Triangle;
using compare::Vec3;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec3 on_unit_sphere(const Vec3& v) {
  const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return {v.x / length, v.y / length, v.z / length};
}

Mesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh;
  for (const Vec3& v : {Vec3{-1, g, 0}, Vec3{1, g, 0}, Vec3{-1, -g, 0}, Vec3{1, -g, 0}, Vec3{0, -1, g}, Vec3{0, 1, g},
                        Vec3{0, -1, -g}, Vec3{0, 1, -g}, Vec3{g, 0, -1}, Vec3{g, 0, 1}, Vec3{-g, 0, -1}, Vec3{-g, 0, 1}}) {
    mesh.positions.push_back(on_unit_sphere(v));
  }
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

Mesh split_in_four(const Mesh& coarse) {
  Mesh fine;
  fine.positions = coarse.positions;
  std::map<Edge, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [entry, is_new] = middles.try_emplace(Edge{std::min(a, b), std::max(a, b)}, static_cast<Index>(fine.positions.size()));
    if (is_new) {
      const Vec3 &p = coarse.positions[at(a)], &q = coarse.positions[at(b)];
      fine.positions.push_back(on_unit_sphere({p.x + q.x, p.y + q.y, p.z + q.z}));
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}}) fine.triangles.push_back(t);
  }
  return fine;
}

/// `count` vertices of a circle about (centre.x, centre.y, z), against the clock as seen from +z. Sines are multiples of 2⁻⁴⁰, so that sin π is 0.
void add_ring(Mesh& mesh, Index count, double radius, const Vec3& centre, double z) {
  const auto tidy = [](double sine) { return std::round(sine * 0x1p40) * 0x1p-40; };
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    mesh.positions.push_back({centre.x + radius * tidy(std::cos(angle)), centre.y + radius * tidy(std::sin(angle)), z});
  }
}

/// Two triangles a cell between rings of `count` vertices that begin at `from` and `to`; outward where the second ring lies towards +z, or inside.
void join_rings(Mesh& mesh, Index count, Index from, Index to) {
  for (Index i = 0; i < count; ++i) {
    const Index next = (i + 1) % count;
    mesh.triangles.push_back({from + i, from + next, to + next});
    mesh.triangles.push_back({from + i, to + next, to + i});
  }
}

/// From the ring that begins at `rim` to the centre of its disc; `up`: the disc looks towards +z.
void add_cap(Mesh& mesh, const CylinderCells& cells, double radius, const Vec3& centre, double z, Index rim, bool up) {
  Index outer = rim;
  for (Index k = 1; k <= cells.cap; ++k) {
    const auto inner = static_cast<Index>(mesh.positions.size());
    add_ring(mesh, cells.around, radius * (cells.cap + 1 - k) / (cells.cap + 1), centre, z);
    up ? join_rings(mesh, cells.around, outer, inner) : join_rings(mesh, cells.around, inner, outer);
    outer = inner;
  }
  const auto middle = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back({centre.x, centre.y, z});
  for (Index i = 0; i < cells.around; ++i) {
    const Index a = outer + i, b = outer + (i + 1) % cells.around;
    mesh.triangles.push_back(up ? Triangle{a, b, middle} : Triangle{b, a, middle});
  }
}

}  // namespace

Mesh grid(Index count, double side, double height) {
  Mesh mesh;
  const auto coordinate = [&](Index i) { return side * i / (count - 1) - side / 2; };
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < count; ++j) mesh.positions.push_back({coordinate(i), height, coordinate(j)});
  }
  mesh.triangles = cross_diagonals(count, count);
  return mesh;
}

std::vector<Triangle> cross_diagonals(Index rows, Index columns) {
  std::vector<Triangle> triangles;
  for (Index i = 0; i + 1 < rows; ++i) {
    for (Index j = 0; j + 1 < columns; ++j) {
      const Index a = i * columns + j, b = a + 1, c = a + columns + 1, d = a + columns;
      const bool even = (i + j) % 2 == 0;
      triangles.push_back(even ? Triangle{a, b, c} : Triangle{a, b, d});
      triangles.push_back(even ? Triangle{a, c, d} : Triangle{b, c, d});
    }
  }
  return triangles;
}

Mesh ground(Index vertices_a_side, double height) {
  constexpr double side = 4;
  const double largest_cell = 10.0 / (vertices_a_side - 1);  // ten cells of the cloth, so a hundred of its triangles
  return grid(static_cast<Index>(std::ceil(side / largest_cell)) + 1, side, height);
}

Mesh icosphere(int subdivisions, double radius, const Vec3& centre) {
  Mesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) mesh = split_in_four(mesh);
  for (Vec3& v : mesh.positions) v = {centre.x + radius * v.x, centre.y + radius * v.y, centre.z + radius * v.z};
  return mesh;
}

Mesh cylinder(const CylinderCells& cells, double radius, double length, const Vec3& centre) {
  Mesh mesh;
  const auto height = [&](Index k) { return centre.z + length * k / (cells.along - 1) - length / 2; };
  for (Index k = 0; k < cells.along; ++k) add_ring(mesh, cells.around, radius, centre, height(k));
  for (Index k = 0; k + 1 < cells.along; ++k) join_rings(mesh, cells.around, k * cells.around, (k + 1) * cells.around);
  add_cap(mesh, cells, radius, centre, height(0), 0, false);
  add_cap(mesh, cells, radius, centre, height(cells.along - 1), (cells.along - 1) * cells.around, true);
  return mesh;
}

}  // namespace ogc::experiments
