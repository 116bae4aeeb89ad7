// Holds what the tests of parts (fast/kernels/parts.hpp) on the host and on devices share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

namespace ogc::fast::test {

/// Returns two sheets that fall askew on a fixed one, and of which one edge is carried along: contacts of all kinds
/// between all parts, prescribed vertices, several detections a step.
inline compare::Scene falling_sheets() {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 12, 0.10, 0.012, false);
  add_sheet(scene, 11, 0.10, 0.020, false);
  add_sheet(scene, 9, 0.12, 0, true);
  // With friction a vertex reads in the guess loop what contacts took from the moves of other parts' vertices.
  for (compare::Body& body : scene.bodies) body.material.friction = 0.4;
  compare::PrescribedMotion carried;
  for (compare::Index v = 0; v < 12; ++v) carried.vertices.push_back(v);
  carried.velocity = {0.2, -0.4, 0.1};
  for (compare::Index v = 144; v < 155; ++v) carried.vertices.push_back(v);
  scene.motions.push_back(carried);
  for (compare::Index v = 0; v < 144 + 121; ++v) {
    compare::Vec3& x = scene.mesh.positions[static_cast<std::size_t>(v)];
    x.y += 0.1 * x.x + 0.05 * x.z;
    scene.velocities[static_cast<std::size_t>(v)] = {0.1, -0.5, 0.05};
  }
  return scene;
}

/// The rows and the end of a run.
struct Outcome {
  std::vector<compare::StepMetrics> rows;
  compare::Snapshot end;
};

/// Runs steps.
inline Outcome run(compare::Simulation& simulation, std::int64_t steps) {
  // One thread a part: idle threads of many parts would only take the processors from those that others wait for.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  Outcome outcome;
  outcome.rows = simulation.advance(steps);
  outcome.end = simulation.snapshot();
  return outcome;
}

/// Returns the same scene with one detection a step, so that rows have the counts of all detections.
inline compare::Scene falling_sheets_detected_once() {
  compare::Scene scene = falling_sheets();
  scene.settings.iterations = 1, scene.settings.guess_rounds = 1;
  return scene;
}

/// Returns a number of contacts of which those of the rows come nearly up to (ListRoom::full).
inline int nearly_full_capacity(const Outcome& outcome) {
  std::int64_t most = 0;
  for (const compare::StepMetrics& row : outcome.rows)
    most = std::max(most, row.vertex_facet_contacts + row.edge_edge_contacts);
  return static_cast<int>(most + most / 10);
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Returns a row as text, without the times of stages; equal rows have equal text.
inline std::string lines(compare::StepMetrics row) {
  row.stage_ms.clear();
  return compare::step_lines(std::span(&row, 1), 0);
}

/// Requires the same states, bounds and rows.
inline void require_equal(const Outcome& parts, const Outcome& whole) {
  CHECK(same_bits(parts.end.positions, whole.end.positions));
  CHECK(same_bits(parts.end.velocities, whole.end.velocities));
  CHECK(same_bits(parts.end.bounds, whole.end.bounds));
  REQUIRE(parts.rows.size() == whole.rows.size());
  for (std::size_t k = 0; k < whole.rows.size(); ++k) {
    compare::StepMetrics row = parts.rows[k];
    row.wall_ms = whole.rows[k].wall_ms;  // the only column that may differ, beside the repeats of grown lists
    row.repeats = whole.rows[k].repeats, row.status = whole.rows[k].status;
    CHECK(lines(row) == lines(whole.rows[k]));
  }
}

}  // namespace ogc::fast::test
