// Makes a block of tetrahedra, small enough to write down its answers.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::tests {

/// Returns (n − 1)³ cubes of side `spacing`; `corner` is the lowest corner. Each cube has six tetrahedra about the
/// diagonal from its lowest to its highest corner. Vertex (i, j, k) has number (i n + j) n + k.
inline compare::Mesh block_mesh(compare::Index n, double spacing, const compare::Vec3& corner = {}) {
  compare::Mesh mesh;
  for (compare::Index i = 0; i < n; ++i)
    for (compare::Index j = 0; j < n; ++j)
      for (compare::Index k = 0; k < n; ++k)
        mesh.positions.push_back({corner.x + spacing * i, corner.y + spacing * j, corner.z + spacing * k});
  const std::array<compare::Index, 3> step{n * n, n, 1};
  constexpr std::array<std::array<std::size_t, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  for (compare::Index i = 0; i + 1 < n; ++i)
    for (compare::Index j = 0; j + 1 < n; ++j)
      for (compare::Index k = 0; k + 1 < n; ++k)
        for (std::size_t o = 0; o < orders.size(); ++o) {
          const compare::Index a = (i * n + j) * n + k, b = a + step[orders[o][0]], c = b + step[orders[o][1]],
                               d = c + step[orders[o][2]];
          mesh.tetrahedra.push_back(o < 3 ? compare::Tetrahedron{a, b, c, d} : compare::Tetrahedron{a, c, b, d});
        }
  return mesh;
}

/// Returns one free body "block" of 3³ vertices 0.1 m apart; the middle vertex lies inside.
inline compare::Scene solid_scene() {
  compare::Scene scene;
  scene.name = "solid";
  append_body(scene, {.name = "block", .material = {}}, block_mesh(3, 0.1));
  scene.settings.contact_radius = 0.02;
  return scene;
}

}  // namespace ogc::tests
