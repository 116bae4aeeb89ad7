// Makes small scenes for the tests of the solvers.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::tests {

/// Returns n × n vertices on side × side [m] at y = height, centred on the y axis, with alternating diagonals.
inline compare::Mesh sheet_mesh(compare::Index n, double side, double height) {
  compare::Mesh mesh;
  for (compare::Index i = 0; i < n; ++i)
    for (compare::Index j = 0; j < n; ++j)
      mesh.positions.push_back({side * (i / (n - 1.0) - 0.5), height, side * (j / (n - 1.0) - 0.5)});
  for (compare::Index i = 0; i + 1 < n; ++i)
    for (compare::Index j = 0; j + 1 < n; ++j) {
      const compare::Index a = i * n + j, b = a + 1, c = a + n, d = c + 1;
      if ((i + j) % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
      else
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
    }
  return mesh;
}

inline void add_sheet(compare::Scene& scene, compare::Index n, double side, double height, bool fixed,
                      const compare::Material& material = {}) {
  append_body(scene, {.name = "sheet_" + std::to_string(scene.bodies.size()), .fixed = fixed, .material = material},
              sheet_mesh(n, side, height));
}

/// Returns a tilted free sheet that falls from 4 mm above a fixed one: contacts of all kinds from the first step on.
inline compare::Scene two_sheets() {
  compare::Scene scene;
  scene.name = "two_sheets";
  compare::Material material;
  material.bending_damping = material.membrane_damping = 2e-6;
  add_sheet(scene, 6, 0.05, 4e-3, false, material);
  add_sheet(scene, 5, 0.07, 0, true, material);
  for (std::size_t v = 0; v < 36; ++v) {
    compare::Vec3& x = scene.mesh.positions[v];
    x.y += 0.02 * x.x - 0.03 * x.z;
    scene.velocities[v] = {0.05, -0.1, 0.02};
  }
  return scene;
}

/// Returns a triangle, 1 cm wide, `height` above the interior of a fixed triangle, 3 m wide. Only three contacts are
/// possible: between a vertex of the first triangle and the interior of the second.
inline compare::Scene triangle_on_plane(double height, const compare::Material& material) {
  compare::Scene scene;
  scene.name = "triangle_on_plane";
  append_body(scene, {.name = "block", .material = material},
              {{{0, height, 0}, {0, height, 0.01}, {0.01, height, 0}}, {{0, 1, 2}}, {}});
  append_body(scene, {.name = "plane", .fixed = true, .material = material},
              {{{-1, 0, -1}, {-1, 0, 2}, {2, 0, -1}}, {{0, 1, 2}}, {}});
  scene.settings.contact_radius = 5e-3;
  return scene;
}

}  // namespace ogc::tests
