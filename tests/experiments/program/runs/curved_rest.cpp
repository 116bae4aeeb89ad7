// Tests isometric bending on rest shapes that are flat, nearly flat and curved.
#include "experiments/program/runs/curved_rest.hpp"

#include <cmath>
#include <numbers>

#include "compare/files/scenes/scene_files.hpp"
#include "experiments/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;

namespace {

/// Returns a strip of `cells` × 2 cells along x that bends by `degrees` at each transverse line.
compare::Mesh strip(int cells, double degrees) {
  compare::Mesh mesh;
  double x = 0, y = 0;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j < 3; ++j) mesh.positions.push_back({x, y, 0.1 * j});
    const double way = degrees * i * std::numbers::pi / 180;
    x += 0.1 * std::cos(way), y += 0.1 * std::sin(way);
  }
  for (compare::Index i = 0; i < cells; ++i)
    for (compare::Index j = 0; j < 2; ++j) {
      const compare::Index a = 3 * i + j, b = a + 1, c = a + 3, d = a + 4;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
  return mesh;
}

compare::Scene scene_of(double degrees, compare::BendingModel model = compare::BendingModel::isometric_quadratic) {
  compare::Scene scene;
  scene.name = "strips";
  compare::Material material;
  material.bending = model;
  material.bending_stiffness = 1e-3;
  append_body(scene, {.name = "first", .material = material}, strip(3, 0));
  append_body(scene, {.name = "second", .material = material}, strip(4, degrees));
  for (std::size_t v = 12; v < scene.mesh.positions.size(); ++v) {
    scene.mesh.positions[v].y += 2;
    scene.rest_positions[v].y += 2;
  }
  scene.settings.contact_radius = 0.01;
  scene.settings.steps = 1;
  round_to_single(scene);
  return scene;
}

}  // namespace

// The transverse lines at 1, 2 and 3 cells have two bent edges each; longitudinal edges and diagonals stay flat.
TEST_CASE("a rest shape that isometric bending does not know is named with its largest angle and the model to take",
          "[unit]") {
  const std::string text = curved_rest_warning(scene_of(15));
  CHECK_THAT(text, ContainsSubstring("body 'second' has bending=isometric_quadratic") &&
                       ContainsSubstring("6 hinges bent at rest") && ContainsSubstring("15 degrees") &&
                       ContainsSubstring("take bending=discrete_hinge"));
}

TEST_CASE("flat rest shapes, other models, no stiffness and fixed bodies are no reason for a word", "[unit]") {
  CHECK(curved_rest_warning(scene_of(0)) == "");
  CHECK(curved_rest_warning(scene_of(0.9 * flat_degrees)) == "");
  CHECK(curved_rest_warning(scene_of(1.1 * flat_degrees)) != "");
  CHECK(curved_rest_warning(scene_of(15, compare::BendingModel::discrete_hinge)) == "");
  compare::Scene scene = scene_of(15);
  scene.bodies[1].material.bending_stiffness = 0;
  CHECK(curved_rest_warning(scene) == "");
  scene = scene_of(15);
  scene.bodies[1].fixed = true;
  CHECK(curved_rest_warning(scene) == "");
}

TEST_CASE("each solver warns of a curved rest shape, and with the model that it names no more", "[unit]") {
  const tests::TemporaryFolder folder;
  const std::string file = compare::write_scene(folder / "scene", scene_of(15)).string();
  for (const std::string solver : {"vbd", "newton", "reference_vbd", "ipc", "penalty"}) {
    const std::string run = "run " + file + " --solver " + solver + " --out " + (folder / solver).string();
    const tests::ProgramResult warned = tests::run_ogc(run),
                               quiet = tests::run_ogc(run + "_hinges --set bending=discrete_hinge");
    INFO(solver << warned.err << quiet.err);
    CHECK(warned.status == 0);
    CHECK(tests::contains(warned.out, {"isometric_quadratic", "15 degrees", "bending=discrete_hinge"}));
    CHECK(!tests::contains(quiet.err, {"isometric_quadratic"}));
  }
}
