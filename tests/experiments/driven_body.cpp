// Tests that a body that follows keyframes is an ordinary surface (compare/deviations.md, §5.1.3): it may lag behind
// its motion, but never passes through another surface.
#include <nlohmann/json.hpp>

#include "compare/files/scenes/scene_files.hpp"
#include "experiments/program/runs/warnings.hpp"
#include "experiments/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns a plate that rises by 0.5 m at 10 m/s into a cloth 5 cm above it. Its prescribed motion is 0.1 m per step.
/// Bounds allow 36 mm from one detection to the next, and less near the cloth.
compare::Scene plate_into_cloth() {
  compare::Scene scene;
  scene.name = "plate";
  append_body(scene, {.name = "cloth", .material = {.membrane_damping = 1e-3}}, experiments::grid(12, 0.5, 0.05));
  const compare::Mesh plate = experiments::grid(5, 0.3, 0);
  compare::PrescribedMotion motion;
  motion.name = "rise";
  motion.keyframes.times = {0.01, 0.06};
  for (const float height : {0.0f, 0.5f}) {
    for (std::size_t v = 0; v < plate.positions.size(); ++v) {
      const compare::Vec3& x = plate.positions[v];
      if (height == 0) motion.vertices.push_back(static_cast<compare::Index>(scene.mesh.positions.size() + v));
      motion.keyframes.positions.push_back({static_cast<float>(x.x), height, static_cast<float>(x.z)});
    }
  }
  append_body(
      scene,
      {.name = "plate", .material = {.membrane = compare::MembraneModel::none, .bending = compare::BendingModel::none}},
      plate);
  scene.motions.push_back(motion);
  scene.gravity = {};
  scene.settings.time_step = 0.01;
  scene.settings.contact_radius = 0.02;
  scene.settings.iterations = 20;
  scene.settings.steps = 30;
  round_to_single(scene);
  return scene;
}

}  // namespace

TEST_CASE(
    "a body on keyframes that is faster than bounds pushes a cloth, passes through nothing, lags behind and catches up",
    "[unit]") {
  const TemporaryFolder folder;
  const std::string file = write_scene(folder / "scene", plate_into_cloth()).string();
  for (const std::string solver : {"vbd", "reference_vbd"}) {
    const ProgramResult result = run_ogc("run " + file + " --solver " + solver + " --audit every --json --out " +
                                         (folder / solver).string());
    INFO(result.err);
    REQUIRE(result.status == 0);
    const nlohmann::json summary = nlohmann::json::parse(result.out);
    CHECK(summary.at("guarantee_kept") == true);
    CHECK(summary.at("largest_lag_m") > 0.01);
  }
}

TEST_CASE("keys that begin away from their body get a word with the distance and the body's name", "[unit]") {
  const auto warnings = [](const compare::Scene& scene) { return experiments::Warnings(scene).list(); };
  compare::Scene scene = plate_into_cloth();
  CHECK(warnings(scene).empty());
  const auto vertices = static_cast<std::ptrdiff_t>(scene.motions[0].vertices.size());
  compare::Keyframes& keys = scene.motions[0].keyframes;
  for (auto p = keys.positions.begin(); p != keys.positions.begin() + vertices; ++p) p->y -= 0.25f;
  REQUIRE(warnings(scene).size() == 1);
  CHECK(contains(warnings(scene)[0], {"motion 'rise'", "0.25 m away from body 'plate'", "vertex 144"}));
  // The start, t = 0, is a third of the way from the key at −0.25 s to the key at 0.5 s.
  keys.times = {-0.25, 0.5};
  CHECK(warnings(scene).empty());
  keys.times = {-0.25, 0.25};
  CHECK(contains(warnings(scene).at(0), {"0.125 m away"}));
  keys.times = {-2, -1};
  CHECK(contains(warnings(scene).at(0), {"0.5 m away"}));
}
