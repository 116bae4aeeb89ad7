// Only closed formulas are used, so that a scene is the same on every machine.
#include "experiments/scenes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ogc::experiments {
namespace {

using compare::at, compare::Index;
using compare::Edge;
using compare::Mesh;
using compare::Triangle;
using compare::Vec3;

Vec3 on_unit_sphere(const Vec3& v) {
  const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return {v.x / length, v.y / length, v.z / length};
}

Mesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh;
  for (const Vec3& v :
       {Vec3{-1, g, 0}, Vec3{1, g, 0}, Vec3{-1, -g, 0}, Vec3{1, -g, 0}, Vec3{0, -1, g}, Vec3{0, 1, g}, Vec3{0, -1, -g},
        Vec3{0, 1, -g}, Vec3{g, 0, -1}, Vec3{g, 0, 1}, Vec3{-g, 0, -1}, Vec3{-g, 0, 1}}) {
    mesh.positions.push_back(on_unit_sphere(v));
  }
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

Mesh split_in_four(const Mesh& coarse) {
  Mesh fine;
  fine.positions = coarse.positions;
  std::map<Edge, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [entry, is_new] = middles.try_emplace(Edge{std::min(a, b), std::max(a, b)},
                                                     static_cast<Index>(fine.positions.size()));
    if (is_new) {
      const Vec3 &p = coarse.positions[at(a)], &q = coarse.positions[at(b)];
      fine.positions.push_back(on_unit_sphere({p.x + q.x, p.y + q.y, p.z + q.z}));
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}})
      fine.triangles.push_back(t);
  }
  return fine;
}

/// Adds `count` vertices on a circle about (centre.x, centre.y, z), counter-clockwise as seen from +z. Sines are
/// rounded to multiples of 2⁻⁴⁰, so that sin π is 0.
void add_ring(Mesh& mesh, Index count, double radius, const Vec3& centre, double z) {
  const auto tidy = [](double sine) { return std::round(sine * 0x1p40) * 0x1p-40; };
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    mesh.positions.push_back({centre.x + radius * tidy(std::cos(angle)), centre.y + radius * tidy(std::sin(angle)), z});
  }
}

/// Adds two triangles for each cell between two rings of `count` vertices, whose first vertices are `from` and `to`.
/// Normals point outward if the second ring lies towards +z, or inside the first ring.
void join_rings(Mesh& mesh, Index count, Index from, Index to) {
  for (Index i = 0; i < count; ++i) {
    const Index next = (i + 1) % count;
    mesh.triangles.push_back({from + i, from + next, to + next});
    mesh.triangles.push_back({from + i, to + next, to + i});
  }
}

/// Adds the triangles between the pole and the ring whose first vertex is `ring`. `up`: whether the pole lies on the
/// positive side of the ring along its axis.
void add_fan(Mesh& mesh, Index count, Index ring, Index pole, bool up) {
  for (Index i = 0; i < count; ++i) {
    const Index a = ring + i, b = ring + (i + 1) % count;
    mesh.triangles.push_back(up ? Triangle{a, b, pole} : Triangle{b, a, pole});
  }
}

/// Adds the disc inside the ring whose first vertex is `rim`. `up`: whether the disc's normal is +z; otherwise it is
/// −z.
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
  add_fan(mesh, cells.around, outer, middle, up);
}

/// Returns two unit vectors perpendicular to `axis`, so that (first, second, axis) is right-handed.
std::array<Vec3, 2> across(const Vec3& axis) {
  const bool along_y = std::abs(axis.y) > 0.9;
  const Vec3 first = on_unit_sphere(along_y ? Vec3{0, -axis.z, axis.y} : Vec3{axis.z, 0, -axis.x});
  return {
      first,
      {axis.y * first.z - axis.z * first.y, axis.z * first.x - axis.x * first.z, axis.x * first.y - axis.y * first.x}};
}

/// Numbers the lattice points of a box's surface in the order of their first use.
class BoxSurface {
 public:
  BoxSurface(const std::array<Index, 3>& cells, const Vec3& low, const Vec3& high)
      : cells_(cells), low_(low), high_(high) {}

  /// Adds the two faces of the box that are perpendicular to `axis`.
  void add_sides(int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      for (Index i = 0; i < cells_[at(u)]; ++i) {
        for (Index j = 0; j < cells_[at(v)]; ++j) {
          const auto corner = [&](Index di, Index dj) {
            std::array<Index, 3> place{};
            place[at(axis)] = far ? cells_[at(axis)] : 0;
            place[at(u)] = i + di;
            place[at(v)] = j + dj;
            return vertex(place);
          };
          const Index a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          mesh.triangles.push_back(far ? Triangle{a, b, c} : Triangle{a, c, b});
          mesh.triangles.push_back(far ? Triangle{a, c, d} : Triangle{a, d, c});
        }
      }
    }
  }
  Mesh mesh;

 private:
  Index vertex(const std::array<Index, 3>& place) {
    const auto [entry, is_new] = numbers_.try_emplace(place, static_cast<Index>(mesh.positions.size()));
    const auto between = [&](double low, double high, int axis) {
      return low + (high - low) * place[at(axis)] / cells_[at(axis)];
    };
    if (is_new)
      mesh.positions.push_back({between(low_.x, high_.x, 0), between(low_.y, high_.y, 1), between(low_.z, high_.z, 2)});
    return entry->second;
  }
  std::array<Index, 3> cells_;
  Vec3 low_, high_;
  std::map<std::array<Index, 3>, Index> numbers_;
};

}  // namespace

Mesh capsule(const CapsuleCells& cells, double radius, const Vec3& from, const Vec3& to) {
  const Vec3 axis = on_unit_sphere({to.x - from.x, to.y - from.y, to.z - from.z});
  const std::array<Vec3, 2> sides = across(axis);
  Mesh mesh;
  const auto add = [&](const Vec3& centre, double out, double up, double angle) {
    const double c = out * std::cos(angle), s = out * std::sin(angle);
    mesh.positions.push_back(tidy({centre.x + c * sides[0].x + s * sides[1].x + up * axis.x,
                                   centre.y + c * sides[0].y + s * sides[1].y + up * axis.y,
                                   centre.z + c * sides[0].z + s * sides[1].z + up * axis.z}));
  };
  const auto ring = [&](const Vec3& centre, double latitude) {
    for (Index i = 0; i < cells.around; ++i)
      add(centre, radius * std::cos(latitude), radius * std::sin(latitude), 2 * std::numbers::pi * i / cells.around);
  };
  const auto latitude = [&](Index k) { return std::numbers::pi / 2 * k / cells.cap; };
  for (Index k = cells.cap - 1; k > 0; --k) ring(from, -latitude(k));
  for (Index k = 0; k <= cells.along; ++k) {
    const double share = static_cast<double>(k) / cells.along;
    ring({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), from.z + share * (to.z - from.z)}, 0);
  }
  for (Index k = 1; k < cells.cap; ++k) ring(to, latitude(k));
  const Index rings = cells.along + 2 * cells.cap - 1, poles = rings * cells.around;
  for (Index k = 0; k + 1 < rings; ++k) join_rings(mesh, cells.around, k * cells.around, (k + 1) * cells.around);
  add(from, 0, -radius, 0);
  add(to, 0, radius, 0);
  add_fan(mesh, cells.around, 0, poles, false);
  add_fan(mesh, cells.around, poles - cells.around, poles + 1, true);
  return mesh;
}

Mesh box(const std::array<Index, 3>& cells, const Vec3& low, const Vec3& high) {
  BoxSurface surface(cells, low, high);
  for (int axis = 0; axis < 3; ++axis) surface.add_sides(axis);
  return std::move(surface.mesh);
}

Vec3 tidy(const Vec3& v) {
  const auto round = [](double x) { return std::round(x * 0x1p20) * 0x1p-20; };
  return {round(v.x), round(v.y), round(v.z)};
}

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
  // The ground's cells are at most as long as ten cells of the cloth. A triangle then has up to a hundred times the
  // area of the cloth's triangles.
  const double largest_cell = 10.0 / (vertices_a_side - 1);
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
