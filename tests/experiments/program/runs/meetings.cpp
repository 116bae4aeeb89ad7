// Tests how runs count meetings (primitives that pass through each other during a step). Counting changes no bit, runs
// with bounds have no meetings, and runs without bounds have some.
#include <cmath>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns a straight curve of four edges along x that sinks through a fixed curve along z. Both have prescribed
/// motions, so that only bounds stop them.
compare::Scene curve_through_curve(compare::Bounds bounds) {
  compare::Scene scene;
  scene.name = "curves";
  const auto curve = [](bool along_x, double height) {
    compare::Mesh mesh;
    for (int k = 0; k < 5; ++k) {
      const double s = 0.05 * (k - 2) + 0.01;
      mesh.positions.push_back({along_x ? s : 0, height, along_x ? 0 : s});
      if (k > 0) mesh.loose_edges.push_back({k - 1, k});
    }
    return mesh;
  };
  append_body(scene, {.name = "fixed", .fixed = true, .material = {}}, curve(false, 0));
  append_body(scene, {.name = "sinking", .material = {}}, curve(true, 0.0275));
  compare::PrescribedMotion motion;
  motion.name = "sinks";
  for (compare::Index v = 5; v < 10; ++v) motion.vertices.push_back(v);
  motion.velocity = {0, -1, 0};
  scene.motions.push_back(motion);
  scene.gravity = {};
  scene.settings.bounds = bounds;
  scene.settings.time_step = 0.005;
  scene.settings.contact_radius = 0.01;
  scene.settings.steps = 12;
  round_to_single(scene);
  return scene;
}

std::vector<compare::StepMetrics> rows_of(const std::filesystem::path& run) { return compare::read_steps(run).rows; }

}  // namespace

TEST_CASE(
    "the option --audit-meetings changes no bit, fills a column of the steps that it names, and bounds have no meeting",
    "[property]") {
  const TemporaryFolder folder;
  const std::string options = GENERATE("cloth_on_sphere --scale smoke --steps 20 --audit off",
                                       "twist --scale smoke --steps 12 --audit off --set bounds=planes");
  const auto make = [&](const std::string& name, const std::string& more) {
    const ProgramResult result = run_ogc("run " + options + more + " --json --out " + (folder / name).string());
    INFO(options << more << "\n" << result.err);
    REQUIRE(result.status == 0);
    return nlohmann::json::parse(result.out);
  };
  const auto plain = make("plain", ""), with = make("with", " --audit-meetings 3:9");
  CHECK(plain.at("final_hash") == with.at("final_hash"));
  CHECK(!plain.at("audit").contains("meetings"));
  CHECK(with.at("audit").at("meetings") == 0);
  const std::string header = compare::read_bytes(folder / "plain/steps.csv");
  CHECK(header.substr(0, header.find('\n') + 1) == compare::step_header({}, {.convergence = true}));
  for (const compare::StepMetrics& row : rows_of(folder / "with")) {
    CHECK(std::isnan(row.meetings) == (row.step < 3 || row.step > 9));
    if (row.step >= 3 && row.step <= 9) CHECK(row.meetings == 0);
  }
}

TEST_CASE("a curve that is driven through a curve meets it once without bounds and never with them", "[property]") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, compare::Bounds bounds, const std::string& more) {
    const std::string file = write_scene(folder / (name + "_scene"), curve_through_curve(bounds)).string();
    const ProgramResult result = run_ogc("run " + file + more + " --json --out " + (folder / name).string());
    INFO(more << "\n" << result.err);
    REQUIRE(result.status == 0);
    if (bounds == compare::Bounds::off) CHECK(contains(result.err, {"meets edge", "of the motion"}));
    return nlohmann::json::parse(result.out);
  };
  // In scenes with loose edges, audits of every step count meetings by default.
  const auto off = run("off", compare::Bounds::off, " --audit every");
  CHECK(off.at("audit").at("meetings") == 1);
  CHECK(off.at("audit").at("first_meeting") == 6);
  CHECK(off.at("audit").at("intersections") == 0);
  const auto ball = run("ball", compare::Bounds::ball, " --audit every");
  CHECK(ball.at("audit").at("meetings") == 0);
  CHECK(ball.at("guarantee_kept") == true);
  CHECK(ball.at("largest_lag_m").get<double>() > 0.01);
  CHECK(!run("silent", compare::Bounds::ball, " --audit every --audit-meetings off").at("audit").contains("meetings"));
}

TEST_CASE("a run that is cut off and goes on asks the same steps", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 6 --audit off --audit-meetings 2:5 --out " + run).status ==
          0);
  CHECK(compare::RunReader(run).provenance().extra.at("meetings") == "2:5");
}
