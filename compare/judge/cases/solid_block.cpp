#include "compare/judge/cases/solid_block.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "compare/judge/cases/placement.hpp"
#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {

namespace {

/// One row for each tetrahedron of a cell: the order of axes along a path from the lowest corner to the highest one.
/// Even permutations come first.
constexpr std::array<std::array<std::size_t, 3>, 6> paths{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};

Mesh jittered(Random& random, const std::array<Index, 3>& cells, double size, double height) {
  const std::array<Index, 3> step{(cells[1] + 1) * (cells[2] + 1), cells[2] + 1, 1};
  Mesh mesh;
  for (Index i = 0; i <= cells[0]; ++i)
    for (Index j = 0; j <= cells[1]; ++j)
      for (Index k = 0; k <= cells[2]; ++k) {
        const Vec3 moved = placement::sum({1.0 * i, 1.0 * j, 1.0 * k}, placement::in_box(random, -0.1, 0.1));
        mesh.positions.push_back(placement::scaled({moved.x, moved.y, height * moved.z}, size));
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        const Index a = i * step[0] + j * step[1] + k;
        for (std::size_t p = 0; p < paths.size(); ++p) {
          const Index b = a + step[paths[p][0]], c = b + step[paths[p][1]], d = c + step[paths[p][2]];
          mesh.tetrahedra.push_back(p < 3 ? Tetrahedron{a, b, c, d} : Tetrahedron{a, c, b, d});
        }
      }
  return mesh;
}

}  // namespace

Mesh jittered_block(Random& random, double size, double height) {
  const std::array<Index, 3> cells{1 + random.below(2), 1 + random.below(2), 1 + random.below(2)};
  return jittered(random, cells, size, height);
}

Mesh jittered_surface(Random& random, double size, double height) {
  const Mesh block = jittered_block(random, size, height);
  Mesh surface{{}, boundary_triangles(block.tetrahedra), {}};
  std::vector<Index> number(block.positions.size(), -1);
  for (Triangle& triangle : surface.triangles)
    for (Index& v : triangle) {
      Index& own = number[static_cast<std::size_t>(v)];
      if (own < 0) {
        own = static_cast<Index>(surface.positions.size());
        surface.positions.push_back(block.positions[static_cast<std::size_t>(v)]);
      }
      v = own;
    }
  return surface;
}

Mesh jittered_hollow(Random& random, double size, double height) {
  Mesh mesh = jittered_surface(random, 3 * size, height);
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& x : mesh.positions) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  const auto first = static_cast<Index>(mesh.positions.size());
  const double share = random.between(0.3, 0.5);
  // The block's boundary deviates from a box by at most a tenth of a cell. So it does not reach an inner box of at most
  // half of the block's size.
  const auto between = [share](double a, double b, int side) { return (a + b) / 2 + (side - 0.5) * share * (b - a); };
  for (int v = 0; v < 8; ++v)
    mesh.positions.push_back(
        {between(low.x, high.x, v / 4), between(low.y, high.y, v / 2 % 2), between(low.z, high.z, v % 2)});
  for (const auto& [a, b, c, d] :
       {Tetrahedron{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    for (const auto& [p, q, r] : {Triangle{a, c, b}, {a, d, c}})
      mesh.triangles.push_back({first + p, first + q, first + r});
  return mesh;
}

Mesh jittered_cube(Random& random, double size, double height) { return jittered(random, {2, 2, 2}, size, height); }

namespace {

/// Returns six times the volume inside a body's triangles.
double six_volumes(const Scene& scene, const Body& body) {
  const auto from_first = [&](Index v) {
    return placement::sum(scene.mesh.positions[static_cast<std::size_t>(v)],
                          placement::scaled(scene.mesh.positions[static_cast<std::size_t>(body.first_vertex)], -1));
  };
  double all = 0;
  for (Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto& corners = scene.mesh.triangles[static_cast<std::size_t>(t)];
    const Vec3 a = from_first(corners[0]), b = from_first(corners[1]), c = from_first(corners[2]);
    all += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return all;
}

}  // namespace

void turn_mirrored(Scene& scene) {
  for (const Body& body : scene.bodies) {
    if (!body.is_volume() || body.is_solid() || six_volumes(scene, body) > 0) continue;
    const auto first = scene.mesh.triangles.begin() + body.first_triangle;
    for (auto t = first; t != first + body.triangle_count; ++t) std::swap((*t)[1], (*t)[2]);
  }
  const auto at = [&](Index v) { return scene.rest_positions[static_cast<std::size_t>(v)]; };
  for (const Body& body : scene.bodies) {
    if (!body.is_solid()) continue;
    const auto first = scene.mesh.tetrahedra.begin() + body.first_tetrahedron;
    if (const auto& [a, b, c, d] = *first; orientation(at(a), at(b), at(c), at(d)) > 0) return;
    for (auto t = first; t != first + body.tetrahedron_count; ++t) std::swap((*t)[2], (*t)[3]);
    const std::vector<Triangle> boundary = boundary_triangles({first, first + body.tetrahedron_count});
    std::copy(boundary.begin(), boundary.end(), scene.mesh.triangles.begin() + body.first_triangle);
  }
}

}  // namespace ogc::compare
