// Tests runs whose start has intersections (--tolerate-start): which pairs are excluded, when an excluded pair is
// closed (counts as a contact again), and what the run reports.
#include "experiments/program/runs/start_pairs.hpp"

#include <fstream>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/cut_runs.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;
using experiments::grid;
using experiments::StartPairs;

namespace {

/// Returns a triangle that rises at `speed` [m/s]. Its first corner is below a large fixed triangle, its other two
/// corners are above.
compare::Scene tip_through_floor(double speed) {
  compare::Scene scene;
  scene.name = "tip";
  append_body(
      scene, {.name = "tip", .material = {}},
      {.positions = {{0, -0.01, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0.05}}, .triangles = {{0, 1, 2}}, .loose_edges = {}});
  append_body(scene, {.name = "floor", .fixed = true, .material = {}},
              {.positions = {{-1, 0, -1}, {-1, 0, 2}, {2, 0, -1}}, .triangles = {{0, 1, 2}}, .loose_edges = {}});
  for (std::size_t v = 0; v < 3; ++v) scene.velocities[v] = {0, speed, 0};
  scene.settings.contact_radius = 0.005;
  scene.settings.time_step = 0.005;
  scene.settings.steps = 120;
  scene.settings.frame_steps = 4;
  round_to_single(scene);
  return scene;
}

/// Returns a tilted sheet that intersects a fixed sheet at the start and rises.
compare::Scene crossing_sheets() {
  compare::Scene scene;
  scene.name = "crossing";
  compare::Mesh upper = grid(9, 1, 0.02), lower = grid(7, 1.1, 0);
  for (compare::Vec3& x : upper.positions) x.y += 0.2 * x.x;
  append_body(scene, {.name = "upper", .material = {}}, upper);
  append_body(scene, {.name = "lower", .fixed = true, .material = {}}, lower);
  for (std::size_t v = 0; v < upper.positions.size(); ++v) scene.velocities[v] = {0, 0.3, 0};
  scene.gravity = {};
  scene.settings.contact_radius = 0.01;
  scene.settings.time_step = 0.005;
  scene.settings.steps = 60;
  scene.settings.frame_steps = 5;
  round_to_single(scene);
  return scene;
}

std::vector<compare::Vec3f> positions_of(const compare::Scene& scene) {
  return compare::to_single(scene.mesh.positions);
}

std::vector<std::size_t> open_pairs(const std::filesystem::path& run) {
  std::ifstream file(run / "start_pairs.csv");
  std::vector<std::size_t> open;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) open.push_back(std::stoul(line.substr(line.find(',') + 1)));
  return open;
}

}  // namespace

// Both edges at the triangle's tip pass through the floor. Their three vertices and the floor's three vertices make
// nine pairs.
TEST_CASE("start pairs are the vertices of what meets, and close where nothing that has them meets", "[unit]") {
  compare::Scene scene = tip_through_floor(0);
  StartPairs pairs(scene, positions_of(scene));
  CHECK(pairs.at_start().count == 2);
  CHECK(pairs.named() == 9);
  CHECK(pairs.tolerant_scene().excluded_pairs.size() == 9);
  CHECK(!pairs.close_apart(positions_of(scene)));
  scene.mesh.positions[1].y = -0.1;
  // One edge at the tip no longer meets the floor. The edge opposite to the tip does now, so pairs of its vertices stay
  // open.
  CHECK(!pairs.close_apart(positions_of(scene)));
  scene.mesh.positions[2].y = -0.1;
  CHECK(pairs.close_apart(positions_of(scene)));
  CHECK(pairs.open() == 0);
  CHECK(pairs.tolerant_scene().excluded_pairs.empty());
  CHECK(pairs.named() == 9);
  // Closed pairs stay closed.
  scene = tip_through_floor(0);
  CHECK(!pairs.close_apart(positions_of(scene)));
  CHECK(pairs.open() == 0);
}

TEST_CASE("a start that intersects is left to come apart, says how far it is, and is held apart from then on",
          "[unit]") {
  const TemporaryFolder folder;
  const std::string file = compare::write_scene(folder / "scene", tip_through_floor(0.6)).string(),
                    run = (folder / "run").string();
  const ProgramResult refused = run_ogc("run " + file + " --out " + run);
  CHECK(refused.status == 2);
  CHECK(contains(refused.err, {"starts with 2 intersections", "--tolerate-start"}));
  const std::string command = "run " + file + " --audit every --tolerate-start --out " + run;
  const ProgramResult result = run_ogc(command);
  CHECK(result.status == 0);
  CHECK(contains(result.err, {"tip starts with 2 intersections", "9 pairs of vertices are no contact", "of body 'tip'",
                              "of 9 start pairs open"}));
  CHECK(contains(result.out, {"kept but for 9 pairs of vertices that met at the start, 0 still open (120 states"}));
  const std::vector<std::size_t> open = open_pairs(run);
  CHECK(open.size() == 31);
  CHECK(open.front() == 9);
  CHECK(open.back() == 0);
  CHECK(std::ranges::is_sorted(open, std::greater{}));
  // The triangle starts upwards at 0.6 m/s, is back at its initial height after 0.12 s, and lies on the floor at 0.6 s.
  const compare::RunReader reader(run);
  CHECK(compare::audit(build_topology(reader.scene()),
                       compare::to_double(reader.frame(reader.frame_count() - 1).positions))
            .count == 0);
  CHECK(reader.frame(reader.frame_count() - 1).positions[0].y > 0);
  CHECK(reader.frame(reader.frame_count() - 1).positions[0].y < 0.01f);
  const nlohmann::json manifest = nlohmann::json::parse(std::ifstream(folder / "run/run.json"));
  CHECK(manifest.dump().find("but for 9 pairs") != std::string::npos);
  const nlohmann::json json = nlohmann::json::parse(
      run_ogc("run " + file + " --tolerate-start --steps 4 --json --out " + (folder / "short").string()).out);
  CHECK(json.at("guarantee_kept").is_null());
  CHECK(json.at("start_pairs") == nlohmann::json{{"named", 9}, {"open", 9}});
}

TEST_CASE("a clean start that is tolerated is an ordinary run, with a word", "[unit]") {
  const TemporaryFolder folder;
  compare::Scene scene = tip_through_floor(0.6);
  for (std::size_t v = 0; v < 3; ++v) scene.mesh.positions[v].y += 0.1;
  scene.settings.steps = 4;
  const ProgramResult result = run_ogc("run " + compare::write_scene(folder / "scene", scene).string() +
                                       " --tolerate-start --json --out " + (folder / "run").string());
  CHECK(contains(result.err, {"--tolerate-start has nothing to leave out"}));
  CHECK(nlohmann::json::parse(result.out).at("guarantee_kept") == true);
  CHECK(!nlohmann::json::parse(result.out).contains("start_pairs"));
}

// Audits ignore open pairs only. Any other intersection would end the run with an exit status other than 0.
TEST_CASE("sheets that start through each other let no pair in that did not meet at the start, with every bound",
          "[property]") {
  const TemporaryFolder folder;
  const std::string file = compare::write_scene(folder / "scene", crossing_sheets()).string();
  for (const std::string more : {"--set bounds=ball", "--set bounds=planes", "--set bounds=dat", "--solver newton",
                                 "--solver ipc --set ipc_distance=0.002"}) {
    const std::string run = (folder / std::to_string(std::hash<std::string>{}(more))).string();
    const ProgramResult result = run_ogc("run " + file + " --tolerate-start --audit every " + more + " --out " + run);
    INFO(more << "\n" << result.err);
    CHECK(result.status == 0);
    const std::vector<std::size_t> open = open_pairs(run);
    CHECK(open.size() == 13);
    CHECK(open.front() > 50);
    CHECK(open.back() < open.front() / 2);
    CHECK(std::ranges::is_sorted(open, std::greater{}));
  }
}

TEST_CASE("a tolerant run that is cut off goes on with the pairs that were open, to the same bits", "[property]") {
  const TemporaryFolder folder;
  const std::string file = compare::write_scene(folder / "scene", crossing_sheets()).string();
  check_cut_runs(folder / "runs", file + " --tolerate-start --audit frame", {"KILL"});
}

TEST_CASE("an audit prints what meets as a scene excludes it", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = (folder / "m.obj").string();
  compare::write_bytes(mesh, "v 0 -1 0\nv 1 1 0\nv -1 1 0.5\nv -9 0 -9\nv -9 0 20\nv 20 0 -9\nf 1 2 3\nf 4 5 6\n");
  const nlohmann::json state = nlohmann::json::parse(run_ogc("audit --json " + mesh).out).at("states").at(0);
  CHECK(state.at("excluded_pairs").size() == 1);
  CHECK(state.at("excluded_pairs")[0].at("bodies") == std::vector<std::string>{"cloth", "cloth"});
  CHECK(state.at("excluded_pairs")[0].at("vertices").size() == 9);
  // A scene file with these excluded pairs must be accepted, and its run must start.
  const nlohmann::json scene{{"format_version", 2},
                             {"bodies", {{{"name", "cloth"}, {"mesh", "m.obj"}}}},
                             {"excluded_pairs", state.at("excluded_pairs")},
                             {"settings", {{"contact_radius", 0.01}, {"steps", 2}}}};
  compare::write_bytes(folder / "s.json", scene.dump());
  CHECK(run_ogc("run " + (folder / "s.json").string() + " --out " + (folder / "r").string()).status == 0);
  CHECK(run_ogc("audit --json " + (folder / "r").string()).status == 0);
}
