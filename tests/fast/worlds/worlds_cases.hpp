// Scenes and comparisons for tests of worlds.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "compare/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

namespace ogc::fast::test {

using Rows = std::vector<std::vector<compare::StepMetrics>>;

/// Returns a sheet of n × n vertices that falls askew on a fixed sheet: contacts of all kinds, friction, damping,
/// several detections a step.
inline compare::Scene falling_sheet(compare::Index n, double speed) {
  compare::Scene scene = empty_scene();
  compare::Material material;
  material.bending_damping = 2e-6, material.membrane_damping = 2e-6;
  add_sheet(scene, n, 0.10, 0.012, false, material);
  add_sheet(scene, 5, 0.12, 0, true, material);
  for (std::size_t v = 0; v < static_cast<std::size_t>(n * n); ++v) {
    compare::Vec3& x = scene.mesh.positions[v];
    x.y += 0.1 * x.x + 0.05 * x.z;
    scene.velocities[v] = {0.1, -speed, 0.05};
  }
  return scene;
}

/// Returns how often steps of a world were repeated because a list was too small.
inline std::int64_t repeats(const std::vector<compare::StepMetrics>& rows) {
  std::int64_t sum = 0;
  for (const compare::StepMetrics& row : rows) sum += row.repeats;
  return sum;
}

/// Returns worlds that differ in size, speed, iterations and bounds, so that their programs differ.
inline std::vector<compare::Scene> different_worlds(int count) {
  std::vector<compare::Scene> scenes;
  for (int w = 0; w < count; ++w) {
    compare::Scene& scene = scenes.emplace_back(falling_sheet(8 + w % 3, 0.3 + 0.02 * (w % 50)));
    scene.settings.iterations = 6 + w % 4;
    if (w % 4 == 2) scene.settings.bounds = compare::Bounds::planes;
  }
  return scenes;
}

/// Makes the scene's first step fail: a position overflows.
inline void make_fail(compare::Scene& scene) { scene.velocities[3] = {1e30, 0, 0}; }

/// Returns the bits of a number.
inline std::uint64_t bits_of(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

/// Requires equal rows, except for times.
inline void expect_same(const std::vector<compare::StepMetrics>& a, const std::vector<compare::StepMetrics>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    CAPTURE(k);
    CHECK(a[k].step == b[k].step);
    CHECK(a[k].status == b[k].status);
    CHECK(a[k].repeats == b[k].repeats);
    CHECK(a[k].vertex_facet_contacts == b[k].vertex_facet_contacts);
    CHECK(a[k].edge_edge_contacts == b[k].edge_edge_contacts);
    CHECK(a[k].discrete_detections == b[k].discrete_detections);
    CHECK(a[k].guess_rounds == b[k].guess_rounds);
    CHECK(a[k].iterations == b[k].iterations);
    CHECK(a[k].vertices_cut == b[k].vertices_cut);
    for (const auto member :
         {&compare::StepMetrics::momentum_lost_guess, &compare::StepMetrics::momentum_lost_end,
          &compare::StepMetrics::largest_lag, &compare::StepMetrics::query_radius, &compare::StepMetrics::last_motion,
          &compare::StepMetrics::left_residual, &compare::StepMetrics::left_held, &compare::StepMetrics::kinetic_energy,
          &compare::StepMetrics::elastic_energy, &compare::StepMetrics::contact_energy,
          &compare::StepMetrics::gravity_energy, &compare::StepMetrics::smallest_distance})
      CHECK(bits_of(a[k].*member) == bits_of(b[k].*member));
  }
}

/// Requires equal states, bit for bit.
inline void expect_same(const compare::Snapshot& a, const compare::Snapshot& b) {
  const auto same = [](const auto& left, const auto& right) {
    return left.size() == right.size() && std::memcmp(left.data(), right.data(), left.size() * sizeof(left[0])) == 0;
  };
  CHECK(a.step == b.step);
  CHECK(same(a.positions, b.positions));
  CHECK(same(a.velocities, b.velocities));
  CHECK(same(a.previous, b.previous));
  CHECK(same(a.bounds, b.bounds));
}

}  // namespace ogc::fast::test
