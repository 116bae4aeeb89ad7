// Tests stacks of identical sheets with the settings of `ogc suggest`: they must come to rest and stay at rest.
#include <algorithm>
#include <cmath>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

constexpr double edge = 0.02, gap = 0.004;  ///< [m]
/// Number of steps in which a stack comes to rest, and number of steps that are checked afterwards.
constexpr std::size_t settling = 80, resting = 100;

/// Returns `count` sheets of n × n vertices above each other, the lowest at y = 0. A fixed pattern shifts each sheet
/// horizontally by up to `shift` [m].
compare::Mesh stack(int count, compare::Index n, double shift) {
  compare::Scene scene;
  for (int k = 0; k < count; ++k) {
    compare::Mesh sheet = experiments::grid(n, edge * (n - 1), gap * k);
    for (compare::Vec3& p : sheet.positions) p.x += shift * std::sin(7.0 * k), p.z += shift * std::sin(11.0 * k + 1);
    append_body(scene, {.name = "sheet_" + std::to_string(k), .material = {}}, sheet);
  }
  return scene.mesh;
}

}  // namespace

TEST_CASE("stacks of 3, 10 and 50 identical sheets, aligned or shifted, rest with no vertex at its bound",
          "[property]") {
  for (const int count : {3, 10, 50})
    for (const double shift : {0.0, edge / 4}) {
      const TemporaryFolder folder;
      compare::write_mesh(folder / "stack.obj", stack(count, count > 10 ? 3 : 4, shift));
      const std::string mesh = (folder / "stack.obj").string(), run = (folder / "run").string();
      const std::string steps = " --steps " + std::to_string(settling + resting);
      const ProgramResult done = run_ogc("run " + mesh + " --ground -0.004 --audit end" + steps + " --out " + run);
      INFO(count << " sheets, shift " << shift << " m\n" << done.err);
      REQUIRE(done.status == 0);
      const std::vector<compare::StepMetrics> rows = compare::read_steps(run).rows;
      REQUIRE(rows.size() == settling + resting);
      for (std::size_t i = settling; i < rows.size(); ++i) {
        INFO("step " << rows[i].step);
        CHECK(rows[i].vertices_cut == 0);
        // Nothing moves far enough to cause a second detection, and no gap closes.
        CHECK(rows[i].discrete_detections == 1);
        CHECK(rows[i].smallest_distance > gap / 4);
      }
    }
}
