// Holds small scenes for the tests of the solver: square sheets with alternating diagonals, one body each.
#pragma once

#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::fast::test {

/// Adds n × n vertices on side × side [m] in the plane y = height, centred on the y axis, with one material.
inline compare::Body& add_sheet(compare::Scene& scene, compare::Index n, double side, double height, bool fixed,
                                const compare::Material& material = {}) {
  compare::Body body;
  body.name = "sheet " + std::to_string(scene.bodies.size());
  body.first_vertex = static_cast<compare::Index>(scene.mesh.positions.size());
  body.first_triangle = static_cast<compare::Index>(scene.mesh.triangles.size());
  body.vertex_count = n * n;
  body.triangle_count = 2 * (n - 1) * (n - 1);
  body.fixed = fixed;
  body.material = material;
  for (compare::Index i = 0; i < n; ++i) {
    for (compare::Index j = 0; j < n; ++j)
      scene.mesh.positions.push_back({side * (i / (n - 1.0) - 0.5), height, side * (j / (n - 1.0) - 0.5)});
  }
  for (compare::Index i = 0; i + 1 < n; ++i) {
    for (compare::Index j = 0; j + 1 < n; ++j) {
      const compare::Index a = body.first_vertex + i * n + j, b = a + 1, c = a + n, d = c + 1;
      if ((i + j) % 2 == 0) {
        scene.mesh.triangles.push_back({a, b, d});
        scene.mesh.triangles.push_back({a, d, c});
      } else {
        scene.mesh.triangles.push_back({a, b, c});
        scene.mesh.triangles.push_back({b, d, c});
      }
    }
  }
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.resize(scene.mesh.positions.size());
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

/// Returns a scene without bodies: step 1/100 s, 10 iterations, r = 5 mm.
inline compare::Scene empty_scene() {
  compare::Scene scene;
  scene.name = "test";
  scene.settings.iterations = 10;
  return scene;
}

/// Returns eight sheets so close that each touches four others: more contacts than the size of the mesh suggests. Steps
/// are so short that contacts hardly change.
inline compare::Scene dense_stack(compare::Bounds bounds) {
  compare::Scene scene = empty_scene();
  scene.settings.bounds = bounds;
  scene.settings.time_step = 1e-5;
  for (int k = 0; k < 8; ++k) add_sheet(scene, 10, 0.1, 0.45 * scene.settings.contact_radius * k, false);
  compare::round_to_single(scene);
  return scene;
}

}  // namespace ogc::fast::test
