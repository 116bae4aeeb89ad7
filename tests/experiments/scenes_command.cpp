#include <nlohmann/json.hpp>

#include "compare/files/scene_files.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("ogc scenes lists every scene with its sizes", "[unit]") {
  const ProgramResult text = run_ogc("scenes");
  const ProgramResult result = run_ogc("scenes --json");
  REQUIRE(text.status == 0);
  REQUIRE(result.status == 0);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  REQUIRE(json.at("scenes").size() == experiments::scenes().size());
  for (const auto& entry : json.at("scenes")) {
    const std::string name = entry.at("name");
    CHECK(contains(text.out, {name, entry.at("figure").get<std::string>()}));
    REQUIRE(entry.at("scales").size() == 3);
    const compare::Scene scene = experiments::make_scene(name, experiments::Scale::small);
    CHECK(entry.at("scales").at(1).at("vertices") == scene.mesh.positions.size());
    CHECK(entry.at("scales").at(1).at("triangles") == scene.mesh.triangles.size());
  }
}

TEST_CASE("ogc scenes NAME --write writes a scene file that reads back as the scene", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("scenes cloth_on_sphere --scale smoke --json --write " + (folder / "mine").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const compare::Scene scene = compare::read_scene(nlohmann::json::parse(result.out).at("written").get<std::string>());
  const compare::Scene expected = experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke);
  CHECK(scene.mesh.positions == expected.mesh.positions);
  CHECK(scene.mesh.triangles == expected.mesh.triangles);
  CHECK(scene.settings.iterations == expected.settings.iterations);
}

TEST_CASE("ogc scenes --schema prints JSON", "[unit]") {
  const ProgramResult result = run_ogc("scenes --schema");
  REQUIRE(result.status == 0);
  CHECK(nlohmann::json::parse(result.out).is_object());
}

TEST_CASE("an unknown scene exits 2 and lists the known ones", "[unit]") {
  for (const char* arguments : {"scenes trampoline", "scenes trampoline --write nowhere", "run trampoline"}) {
    const ProgramResult result = run_ogc(arguments);
    INFO(result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"trampoline", "cloth_on_sphere", "twist"}));
  }
  CHECK(run_ogc("scenes --write nowhere").status == 2);
}
