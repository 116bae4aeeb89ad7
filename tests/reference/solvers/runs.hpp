// Runs the reference's solvers for their tests.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "compare/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

namespace ogc::tests {

using StartSolver = std::unique_ptr<compare::Simulation> (*)(const compare::Scene&, const compare::SimulationOptions&);

struct Run {
  std::vector<compare::StepMetrics> rows;
  compare::Snapshot end;
};

inline Run run_of(StartSolver start, const compare::Scene& scene, std::int64_t steps) {
  const auto simulation = start(scene, {.iterations = true});
  Run result{simulation->advance(steps), {}};
  result.end = simulation->snapshot();
  return result;
}

inline bool clean(const Run& run) {
  return std::all_of(run.rows.begin(), run.rows.end(),
                     [](const compare::StepMetrics& row) { return row.status == compare::step_clean; });
}

/// Returns a tilted sheet that falls onto a fixed one: contacts of all kinds, friction, damping, several detections in
/// a step.
inline compare::Scene drop_scene() {
  compare::Scene scene;
  scene.name = "drop";
  compare::Material material;
  material.bending_damping = material.membrane_damping = 2e-6;
  add_sheet(scene, 8, 0.07, 0.012, false, material);
  add_sheet(scene, 6, 0.09, 0, true, material);
  for (std::size_t v = 0; v < 64; ++v) {
    compare::Vec3& x = scene.mesh.positions[v];
    x.y += 0.1 * x.x + 0.05 * x.z;
    scene.velocities[v] = {0.1, -0.3, 0.05};
  }
  set_setting(scene.settings, "ipc_distance", 2e-3);
  return scene;
}

/// Checks that each step from the previous snapshot has the bits of an uninterrupted run. Both sheets are free, so
/// contacts couple vertices that no triangle couples, and the matrix' pattern grows and shrinks.
inline void check_goes_on_from_any_snapshot(StartSolver start, compare::Scene scene) {
  scene.bodies[1].fixed = false;
  const auto whole = start(scene, {});
  for (int step = 1; step <= 20; ++step) {
    const auto rest = start(scene, {});
    rest->restore(whole->snapshot());
    whole->advance(1);
    rest->advance(1);
    const compare::Snapshot once = whole->snapshot(), again = rest->snapshot();
    INFO("step " << step);
    CHECK(once.step == step);
    CHECK(again.step == step);
    CHECK(once.positions == again.positions);
    CHECK(once.velocities == again.velocities);
    CHECK(once.exact_positions == again.exact_positions);
    CHECK(once.exact_velocities == again.exact_velocities);
    CHECK(once.orientations == again.orientations);
  }
}

}  // namespace ogc::tests
