// Tests scenes with volumes: which solvers refuse them, and what runs report about them.
#include <string>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("ipc refuses volumes by name, driven or free, before anything is written", "[unit]") {
  const TemporaryFolder folder;
  const auto refuses = [&](const std::string& scene, const std::string& body) {
    const std::filesystem::path out = folder / "ipc";
    const ProgramResult result = run_ogc("run " + scene + " --solver ipc --out " + out.string());
    INFO(result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"body '" + body + "' is a volume", "ipc", "leave the body a surface"}));
    CHECK(!std::filesystem::exists(out));
  };
  refuses("dress --scale smoke --set body_contact=volume", "body");
  refuses("mat_twist --scale smoke --set body_contact=volume", "mat");
}

TEST_CASE("a mat of tetrahedra that is twisted as a free volume runs to its end, and the summary says what is inside",
          "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path run = folder / "run";
  const ProgramResult result = run_ogc(
      "run mat_twist --scale smoke --set body_contact=volume --steps 40 --json --out " + run.string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  CHECK(json.at("guarantee_kept") == true);
  CHECK(json.at("largest_lag_m") == 0);
  CHECK(json.at("volumes").at("inside_at_start") == 0);
  CHECK(json.at("volumes").at("most_unresolved") == 0);
  CHECK(json.at("smallest_distance_m").is_null());  // no vertex has a bound
  const auto manifest = nlohmann::json::parse(compare::read_bytes(run / "run.json"));
  CHECK(manifest.at("most_depth_unresolved") == "0");
  CHECK(contains(compare::read_bytes(run / "steps.csv"), {",deepest [m],depth_unresolved [1]"}));
  const ProgramResult audit = run_ogc("audit " + run.string());
  CHECK(audit.status == 0);
  CHECK(contains(audit.out, {"inside volumes"}));
}

TEST_CASE("a free volume that begins inside out is refused with the triangle's name", "[unit]") {
  const TemporaryFolder folder;
  compare::Scene scene = solid_scene();
  scene.bodies[0].contact = compare::BodyContact::volume;
  for (compare::Vec3& x : scene.mesh.positions) x.x = -x.x;
  CHECK_THROWS_WITH(write_scene(folder / "scene", scene),
                    ContainsSubstring("triangle 0 of body 'block'") && ContainsSubstring("turned inside out"));
}

TEST_CASE("newton: a dress on a volume does not lag, and no panel intersects another", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc(
      "run dress --scale smoke --set body_contact=volume --solver newton --steps 4 --audit every --json --out " +
      (folder / "run").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  CHECK(json.at("guarantee_kept") == true);
  CHECK(json.at("largest_lag_m") == 0);
  CHECK(json.at("volumes").at("most_inside") == 0);
}

TEST_CASE("a dress on a volume: no lag, no intersection among its panels, and the summary says what is inside",
          "[unit]") {
  const TemporaryFolder folder;
  const std::string run = "run dress --scale smoke --set body_contact=volume --steps 20 --audit every --json --out ";
  const ProgramResult result = run_ogc(run + (folder / "run").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  CHECK(json.at("guarantee_kept") == true);
  CHECK(json.at("largest_lag_m") == 0);
  CHECK(json.at("audit").at("intersections") == 0);
  CHECK(json.at("volumes").at("inside_at_start") == 0);
  CHECK(json.at("volumes").at("most_inside") == 0);
  const std::string header = compare::read_bytes(folder / "run" / "steps.csv");
  CHECK(contains(header, {"volume_contacts [1],vertices_inside [1],deepest [m]"}));
  const ProgramResult audit = run_ogc("audit " + (folder / "run").string() + " --deepest 0");
  CHECK(audit.status == 0);
  CHECK(contains(audit.out, {"0 vertex positions inside volumes"}));
}

TEST_CASE("run.json says what each body is to others, and not how deep one is inside where nobody looked", "[unit]") {
  const auto manifest = [](const std::string& options) {
    const TemporaryFolder folder;
    const std::filesystem::path run = folder / "run";
    const ProgramResult result = run_ogc("run dress --scale smoke --steps 2 " + options + " --out " + run.string());
    INFO(result.err);
    REQUIRE(result.status == 0);
    return nlohmann::json::parse(compare::read_bytes(run / "run.json"));
  };
  for (const std::string kind : {"surface", "volume"}) {
    const auto json = manifest("--set body_contact=" + kind + " --audit off");
    for (const auto& body : json.at("scene").at("bodies"))
      CHECK(body.at("body_contact") == (body.at("name") == "body" ? kind : "surface"));
    for (const char* most : {"most_vertices_inside", "deepest_m", "most_edges_meeting_volumes"}) {
      CHECK(json.contains(most) == (kind == "volume"));
      if (kind == "volume") CHECK(json.at(most) == "not checked");
    }
  }
  CHECK(manifest("--set body_contact=volume --audit end").at("most_vertices_inside") == "0");
}

TEST_CASE("a ledger of a scene with volumes is refused before anything is written", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "run";
  const ProgramResult result = run_ogc("run dress --scale smoke --set body_contact=volume --ledger --out " +
                                       out.string());
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"--ledger knows no volumes", "leave it out"}));
  CHECK(!std::filesystem::exists(out));
}

TEST_CASE("body_contact= belongs to scenes with a driven body, and knows two words", "[unit]") {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& arguments) {
    const ProgramResult result = run_ogc("run " + arguments + " --out " + (folder / "run").string());
    CHECK(result.status == 2);
    return result.err;
  };
  CHECK(
      contains(said("twist --scale smoke --set body_contact=volume"), {"body_contact", "is moved whole by a motion"}));
  CHECK(contains(said("dress --scale smoke --set body_contact=volum"), {"body_contact", "volum", "volume"}));
}
