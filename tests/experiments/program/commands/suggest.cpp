// Tests that the command that `ogc suggest` prints makes a run with the stated properties.
#include <cmath>

#include <nlohmann/json.hpp>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/scene.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

nlohmann::json suggested(const std::filesystem::path& mesh, const std::string& options = "") {
  const ProgramResult result = run_ogc("suggest '" + mesh.string() + "' --json " + options);
  INFO(result.err);
  REQUIRE(result.status == 0);
  return nlohmann::json::parse(result.out);
}

double value(const nlohmann::json& suggestion, const char* setting) {
  return suggestion.at("settings").at(setting).at("value");
}

compare::Mesh scaled(compare::Mesh mesh, double factor) {
  for (compare::Vec3& p : mesh.positions) p = {factor * p.x, factor * p.y, factor * p.z};
  return mesh;
}

/// Returns two sheets, `gap` [m] apart.
compare::Mesh layers(double gap) {
  compare::Scene scene;
  append_body(scene, {.name = "lower", .material = {}}, experiments::grid(8, 0.4, 0));
  append_body(scene, {.name = "upper", .material = {}}, experiments::grid(8, 0.4, gap));
  return scene.mesh;
}

}  // namespace

TEST_CASE("the run that ogc suggest prints lands, keeps distances above 0 on the way, and is not warned of",
          "[property]") {
  for (const compare::Mesh& mesh : {experiments::grid(10, 0.5, 1), layers(0.02), layers(0.004)}) {
    const TemporaryFolder folder;
    compare::write_mesh(folder / "mesh.obj", mesh);
    const nlohmann::json suggestion = suggested(folder / "mesh.obj", "--fall 0.02");
    const std::string command = suggestion.at("command");
    REQUIRE(command.starts_with("ogc run "));
    const ProgramResult result = run_ogc(command.substr(4) + " --audit every --json --out " +
                                         (folder / "run").string());
    INFO(command << "\n" << result.err);
    REQUIRE(result.status == 0);
    const nlohmann::json summary = nlohmann::json::parse(result.out);
    CHECK(summary.at("guarantee_kept") == true);
    CHECK(summary.at("smallest_distance_m") > 0);
    CHECK(summary.at("warnings").empty());
    const std::vector<compare::StepMetrics> rows = compare::read_steps(folder / "run").rows;
    CHECK(rows.back().vertex_facet_contacts > 0);
  }
}

// Lengths are printed with two digits, rounded down. The height of the fall is scaled with the mesh. The step h is a
// length divided by the speed v after the fall. v² is proportional to the height, so h grows with the square root of
// the length. h is rounded by a factor of at most 2.5.
TEST_CASE("suggested lengths scale with the mesh, the step with its root", "[property]") {
  const TemporaryFolder folder;
  compare::write_mesh(folder / "one.obj", experiments::grid(20, 1, 0));
  const nlohmann::json one = suggested(folder / "one.obj", "--fall 1");
  for (const double factor : {0.125, 0.001}) {
    compare::write_mesh(folder / "scaled.obj", scaled(experiments::grid(20, 1, 0), factor));
    const nlohmann::json other = suggested(folder / "scaled.obj", "--fall " + std::to_string(factor));
    CHECK(value(other, "contact_radius") == Approx(factor * value(one, "contact_radius")).epsilon(0.1));
    CHECK(value(other, "detection_radius_cap") == Approx(value(one, "detection_radius_cap")).epsilon(0.2));
    const double shrunk = value(other, "time_step") / value(one, "time_step") / std::sqrt(factor);
    CHECK(shrunk > 1 / 2.6);
    CHECK(shrunk < 2.6);
  }
}

TEST_CASE("ogc suggest gives each number a reason, and its command survives a shell", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path mesh = folder / "my shirt (1).obj";
  compare::write_mesh(mesh, experiments::grid(4, 0.3, 0));
  const nlohmann::json suggestion = suggested(mesh);
  for (const char* setting :
       {"contact_radius", "detection_radius_cap", "contact_stiffness", "time_step", "iterations"}) {
    CHECK(value(suggestion, setting) > 0);
    CHECK(suggestion.at("settings").at(setting).at("reason").get<std::string>().size() > 20);
  }
  const std::string command = suggestion.at("command");
  const ProgramResult words = run_ogc("suggest '" + mesh.string() + "'");
  CHECK_THAT(words.out, ContainsSubstring("N/m") && Catch::Matchers::EndsWith(command + "\n"));
  CHECK(run_ogc(command.substr(4) + " --steps 1 --out " + (folder / "run").string()).status == 0);
}

TEST_CASE("ogc suggest refuses curves and falls that are none", "[unit]") {
  const TemporaryFolder folder;
  const std::string yarn = folder.write("yarn.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").string();
  const std::string mesh = folder.write("mesh.obj", parallel_triangles_obj).string();
  for (const std::string& arguments :
       {yarn, mesh + " --fall 0", mesh + " --fall nan", mesh + " --fall inf", mesh + " --fall -1"}) {
    const ProgramResult result = run_ogc("suggest " + arguments);
    INFO(arguments << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {arguments == yarn ? "triangle" : "--fall"}));
  }
}
