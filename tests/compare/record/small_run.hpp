// Makes a run of few vertices with all parts of a run: a free body, a fixed body, a yarn, and a motion.
#pragma once

#include <cmath>

#include "compare/record/run_folder.hpp"
#include "tests/compare/files/scratch.hpp"

namespace ogc::tests {

inline compare::Scene recorded_scene() {
  compare::Scene scene;
  scene.name = "small";
  scene.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 0},
                          {1, 1, 0}, {0, 1, 1}, {3, 0, 0}, {3, 1, 0}, {3, 1, 1}};
  scene.mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {4, 5, 6}};
  scene.rest_positions = scene.mesh.positions;
  scene.mesh.loose_edges = {{7, 8}, {8, 9}};
  scene.velocities.assign(10, {0, 0.5, 0});
  scene.bodies = {{.name = "floor",
                   .first_vertex = 0,
                   .vertex_count = 4,
                   .first_triangle = 0,
                   .triangle_count = 2,
                   .fixed = true,
                   .material = {}},
                  {.name = "cloth",
                   .first_vertex = 4,
                   .vertex_count = 3,
                   .first_triangle = 2,
                   .triangle_count = 1,
                   .fixed = false,
                   .material = {}},
                  {.name = "yarn",
                   .first_vertex = 7,
                   .vertex_count = 3,
                   .first_triangle = 3,
                   .triangle_count = 0,
                   .fixed = false,
                   .material = {}}};
  for (std::size_t v = 0; v < 4; ++v) scene.velocities[v] = {};
  scene.bodies[1].material.density = 0.3;
  scene.bodies[2].material.rod = {.density = 2e-3, .stretch = 0.2, .bend = 1e-7, .damping = 1e-4, .diameter = 2e-3};
  scene.motions = {{.name = "handle",
                    .vertices = {4},
                    .centre = {0, 1, 0},
                    .axis = {0, 1, 0},
                    .angular_velocity = 1,
                    .velocity = {0, 1, 0},
                    .keyframes = {}}};
  scene.motions[0].end = 2;
  scene.settings.steps = 4;
  scene.settings.seed = 42;
  compare::round_to_single(scene);
  return scene;
}

inline compare::Frame recorded_frame(std::int64_t step, std::size_t vertex_count = 10) {
  compare::Frame frame{
      .step = step, .time = 0.01 * static_cast<double>(step), .positions = {}, .velocities = {}, .bounds = {}};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto value = static_cast<float>(step) + static_cast<float>(v) / 3;
    frame.positions.push_back({value, -value, value * value});
    frame.velocities.push_back({std::sqrt(value), 0, 1});
    frame.bounds.push_back(value / 7);
  }
  return frame;
}

inline compare::StepMetrics recorded_metrics(std::int64_t step) {
  compare::StepMetrics row;
  row.step = step;
  row.wall_ms = 0.1 * static_cast<double>(step);
  row.vertex_facet_contacts = 10 * step;
  row.largest_lag = 1.0 / 3;
  row.residual = std::nan("");
  row.status = compare::step_list_grew;
  return row;
}

inline compare::Provenance recorded_provenance() {
  compare::Provenance provenance;
  provenance.solver = "vbd";
  provenance.backend = "cpu";
  provenance.command = "ogc run \"small\"";
  provenance.commit = "0123456789abcdef";
  provenance.dirty = true;
  return provenance;
}

}  // namespace ogc::tests
