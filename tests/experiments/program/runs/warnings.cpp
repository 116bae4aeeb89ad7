// Tests warnings. A probable mistake in a scene is reported once, with a number and a remedy. A correct scene causes no
// warning.
#include "experiments/program/runs/warnings.hpp"

#include <fstream>

#include <nlohmann/json.hpp>

#include "compare/files/scenes/scene_files.hpp"
#include "experiments/scenes/registry.hpp"
#include "experiments/scenes/shapes.hpp"
#include "experiments/scenes/solid_box.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

/// Returns a square sheet of 2 × 2 cells far from everything, with r = 10 mm.
compare::Scene sheet(double side = 1) {
  compare::Scene scene;
  scene.name = "sheet";
  append_body(scene, {.name = "cloth", .material = {}}, grid(3, side, 0));
  scene.settings.contact_radius = 0.01;
  scene.settings.steps = 3;
  return scene;
}

void throw_down(compare::Scene& scene, double speed) {
  for (compare::Vec3& v : scene.velocities) v = {0, -speed, 0};
}

compare::StepMetrics numbered(std::int64_t step) {
  compare::StepMetrics row;
  row.step = step;
  return row;
}

/// Returns the warnings at the end of a run of the scene. Checks that the output of --json and run.json contain the
/// same warnings.
std::vector<std::string> warnings_of(compare::Scene scene) {
  const TemporaryFolder folder;
  round_to_single(scene);
  const std::string command = "run " + compare::write_scene(folder / "scene", scene).string() + " --audit off --out ";
  const ProgramResult json = run_ogc(command + (folder / "run").string() + " --json"),
                      words = run_ogc(command + (folder / "words").string());
  INFO(json.err << words.err);
  REQUIRE(json.status == 0);
  const auto warnings = nlohmann::json::parse(json.out).at("warnings").get<std::vector<std::string>>();
  CHECK(nlohmann::json::parse(std::ifstream(folder / "run/run.json")).at("warnings").get<std::vector<std::string>>() ==
        warnings);
  const std::string last = words.out.substr(words.out.rfind('\n', words.out.size() - 2) + 1);
  for (const std::string& warning : warnings) CHECK_THAT(last, ContainsSubstring(warning));
  // Each kind of warning must be printed once during the run.
  std::size_t said = 0;
  for (std::size_t at = words.err.find("warning: "); at != std::string::npos; at = words.err.find("warning: ", at + 1))
    ++said;
  CHECK(said == warnings.size());
  CHECK((last.find("warning") != std::string::npos) == !warnings.empty());
  return warnings;
}

}  // namespace

TEST_CASE("a step that loses more than half of its momentum to truncation is warned of, once, by the worst", "[unit]") {
  Warnings warnings(sheet());
  CHECK(warnings.look_at(numbered(1), 0.5).empty());
  CHECK(warnings.look_at(numbered(2), std::nullopt).empty());
  CHECK(warnings.look_at(numbered(7), 0.6).size() == 1);
  CHECK(warnings.look_at(numbered(8), 0.9).empty());
  CHECK(warnings.look_at(numbered(9), 0.7).empty());
  REQUIRE(warnings.list().size() == 1);
  CHECK_THAT(warnings.list()[0], ContainsSubstring("step 8 lost 90 %") && ContainsSubstring("time_step"));
}

TEST_CASE("ten steps in a row in which bounds cut every free vertex are warned of, and the longest row is told",
          "[unit]") {
  compare::Scene scene = sheet();
  scene.motions = {{.name = "held", .vertices = {0}, .keyframes = {}}};  // 8 of 9 vertices are free
  Warnings warnings(scene);
  const auto look_at = [&](int steps, std::int64_t cut) {
    std::size_t said = 0;
    for (int k = 0; k < steps; ++k) {
      compare::StepMetrics row = numbered(1);
      row.vertices_cut = cut, row.share_cut = static_cast<double>(cut) / 9;
      said += warnings.look_at(row, std::nullopt).size();
    }
    return said;
  };
  CHECK(look_at(9, 8) == 0);
  CHECK(look_at(1, 7) == 0);
  CHECK(look_at(9, 9) == 0);
  CHECK(warnings.list().empty());
  CHECK(look_at(1, 8) == 1);
  CHECK(look_at(3, 8) == 0);
  look_at(1, 0);
  CHECK(look_at(11, 8) == 0);
  REQUIRE(warnings.list().size() == 1);
  CHECK_THAT(warnings.list()[0], ContainsSubstring("13 steps in a row") && ContainsSubstring("8 free vertices") &&
                                     ContainsSubstring("ogc audit"));
}

TEST_CASE("steps that leave a tenth of the free vertices' force are warned of at the end, by their median", "[unit]") {
  Warnings warnings(sheet());
  const auto look_at = [&](double residual, double rounding, double held) {
    compare::StepMetrics row = numbered(1);
    row.left_residual = residual, row.left_rounding = rounding, row.left_held = held;
    CHECK(warnings.look_at(row, std::nullopt).empty());
  };
  CHECK(warnings.look_at(numbered(1), std::nullopt).empty());  // not measured
  CHECK(warnings.forces_left().steps() == 0);
  look_at(0.05, 0.001, 3);
  CHECK(warnings.list().empty());
  look_at(0.5, 0.001, 7);
  look_at(0.3, 0.001, 9);
  CHECK(warnings.forces_left().median_residual() == 0.3);
  CHECK(warnings.forces_left().median_held() == 7);
  REQUIRE(warnings.list().size() == 1);
  CHECK(warnings.list() == warnings.look_back());
  CHECK_THAT(warnings.list()[0],
             ContainsSubstring("30 %") && ContainsSubstring("3 steps") && ContainsSubstring("iterations"));
  for (int k = 0; k < 3; ++k) look_at(0.9, 1, 0);  // steps of free fall
  CHECK(warnings.forces_left().steps() == 3);
  for (int k = 0; k < 2; ++k) look_at(0.01, 0.001, 0);
  CHECK(warnings.forces_left().median_residual() == 0.05);
  CHECK(warnings.list().empty());
}

// The diagonal of the sheet is √2 m. In h = 10 ms gravity changes speeds by 98.1 mm/s.
TEST_CASE("where settled_move may have ended steps, a warning of forces left names it first", "[unit]") {
  compare::Scene scene = sheet();
  scene.settings.settled_move = 0.5;
  compare::StepMetrics row = numbered(1);
  row.left_residual = 0.5, row.left_rounding = 0, row.left_held = 0;
  const auto text = [&] {
    Warnings warnings(scene);
    warnings.look_at(row, std::nullopt);
    return warnings.list().at(0);
  };
  CHECK_THAT(text(), ContainsSubstring("take a smaller settled_move than 0.5 m, more iterations than"));
  scene.settings.settled_move = 0;
  CHECK_THAT(text(), ContainsSubstring("take more iterations than"));
}

TEST_CASE("a tolerance of IPC above what gravity changes in a step is warned of, by its number and another one",
          "[unit]") {
  compare::Scene scene = sheet();
  const auto of = [&](Solver solver) { return Warnings(scene, solver).list(); };
  CHECK(of(Solver::ipc).empty());
  set_setting(scene.settings, "ipc_tolerance", 0.068);
  CHECK(of(Solver::ipc).empty());
  set_setting(scene.settings, "ipc_tolerance", 0.07);
  REQUIRE(of(Solver::ipc).size() == 1);
  CHECK_THAT(of(Solver::ipc)[0], ContainsSubstring("ipc_tolerance ends a step of IPC") &&
                                     ContainsSubstring("0.099 m/s") && ContainsSubstring("0.0981 m/s") &&
                                     ContainsSubstring("take ipc_tolerance=0.007"));
  CHECK(of(Solver::newton).empty());
  set_setting(scene.settings, "ipc_stopping", "velocity");
  CHECK(of(Solver::ipc).empty());
  set_setting(scene.settings, "ipc_velocity_tolerance", 0.2);
  REQUIRE(of(Solver::ipc).size() == 1);
  CHECK_THAT(of(Solver::ipc)[0], ContainsSubstring("take ipc_velocity_tolerance=0.01"));
  scene.gravity = {};
  CHECK(of(Solver::ipc).empty());
}

TEST_CASE("a run without bounds says at its first and last line that nothing is guaranteed", "[unit]") {
  compare::Scene scene = sheet();
  scene.settings.bounds = compare::Bounds::off;
  const std::vector<std::string> warnings = warnings_of(scene);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], ContainsSubstring("bounds=off") && ContainsSubstring("guarantees nothing"));
}

// In each of 16 rounds bounds let a vertex move by γ_p r_q = 0.45 · 40 mm, so by at most 0.29 m in a step. This is 29
// m/s for h = 10 ms. In free flight only truncation removes momentum.
TEST_CASE("a run of a sheet thrown faster than its bounds allow warns; half as fast as they allow it does not",
          "[property]") {
  compare::Scene scene = sheet();
  throw_down(scene, 100);
  const std::vector<std::string> warnings = warnings_of(scene);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], ContainsSubstring("step 1 lost ") && ContainsSubstring("guess_rounds"));
  throw_down(scene, 14);
  CHECK(warnings_of(scene).empty());
}

// The bounds allow 29 m/s (previous test). The handle moves at 100 m/s.
TEST_CASE("a run whose handles fall behind by more than r warns with the lag", "[property]") {
  compare::Scene scene = sheet();
  compare::PrescribedMotion motion;
  motion.name = "handle";
  motion.vertices = {0};
  motion.velocity = {0, 100, 0};
  scene.motions = {motion};
  const std::vector<std::string> warnings = warnings_of(scene);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], ContainsSubstring("lag ") && ContainsSubstring("move them slower"));
  scene.motions[0].velocity = {0, 0.5, 0};
  CHECK(warnings_of(scene).empty());
}

TEST_CASE("a run with r above two median edges warns, and names the body with the shortest", "[unit]") {
  compare::Scene scene = sheet();
  append_body(scene, {.name = "fine", .fixed = true, .material = {}},
              grid(11, 0.06, 1));  // 10 × 10 cells; the median edge is 6 mm
  scene.settings.contact_radius = 0.0119;
  CHECK(Warnings(scene).list().empty());
  scene.settings.contact_radius = 0.0121;
  const std::vector<std::string> warnings = warnings_of(scene);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], ContainsSubstring("0.0121 m, 2.02 median edges (0.006 m) of body 'fine'") &&
                              ContainsSubstring("ogc suggest"));
}

TEST_CASE("a run of a scene whose box has a diagonal above 20 m warns, and says how to scale millimetres", "[unit]") {
  const std::vector<std::string> warnings = warnings_of(sheet(1000));
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], ContainsSubstring("diagonal of 1.41e+03 m") && ContainsSubstring("0.001"));
  CHECK(Warnings(sheet(14.1)).list().empty());
  CHECK(Warnings(sheet(14.2)).list().size() == 1);
}

TEST_CASE("no built-in scene begins with a warning", "[unit]") {
  for (const SceneInfo& info : scenes())
    for (const Scale scale : {Scale::smoke, Scale::small}) {
      INFO(info.name);
      CHECK(Warnings(make_scene(std::string(info.name), scale)).list() == std::vector<std::string>{});
    }
}

TEST_CASE("a solid that is thinner than r at rest is reported with its pairs and its thickness, and not refused",
          "[unit]") {
  compare::Scene scene;
  scene.name = "slab";
  append_body(scene, {.name = "slab", .material = {}}, solid_box({4, 2, 4}, {}, {0.3, 0.008, 0.3}));
  scene.settings.contact_radius = 0.01;
  const std::vector<std::string> texts = Warnings(scene).list();
  REQUIRE(texts.size() == 1);
  CHECK_THAT(texts[0], ContainsSubstring("body 'slab' is thinner than contact_radius (0.01 m) at rest") &&
                           ContainsSubstring("pairs of a vertex and a face of its own") &&
                           ContainsSubstring("the thinnest place is 0.008 m"));
  scene.settings.contact_radius = 0.005;
  CHECK(Warnings(scene).list().empty());
}
