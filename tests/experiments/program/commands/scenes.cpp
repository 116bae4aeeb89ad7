#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/scenes/scene_files.hpp"
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
  const ProgramResult result = run_ogc("scenes cloth_on_sphere --scale smoke --json --write " +
                                       (folder / "mine").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const compare::Scene scene = compare::read_scene(nlohmann::json::parse(result.out).at("written").get<std::string>());
  const compare::Scene expected = experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke);
  CHECK(scene.mesh.positions == expected.mesh.positions);
  CHECK(scene.mesh.triangles == expected.mesh.triangles);
  CHECK(scene.settings.iterations == expected.settings.iterations);
}

TEST_CASE("ogc scenes NAME --write keeps files that are there, unless --force says otherwise", "[unit]") {
  const TemporaryFolder folder;
  const std::string mine = (folder / "mine").string(), command = "scenes twist --scale smoke --write " + mine;
  REQUIRE(run_ogc(command).status == 0);
  std::filesystem::remove(folder / "mine/twist.json");
  const std::string mesh = compare::read_bytes(folder / "mine/twist_cloth.ply");
  compare::write_bytes(folder / "mine/twist_cloth.ply", "edited");
  const ProgramResult refused = run_ogc(command);
  CHECK(refused.status == 2);
  CHECK(contains(refused.err, {mine, "twist_cloth.ply", "--force"}));
  CHECK(compare::read_bytes(folder / "mine/twist_cloth.ply") == "edited");
  CHECK(std::distance(std::filesystem::directory_iterator(folder / "mine"), {}) ==
        1);  // the scene's own file was not written either
  CHECK(run_ogc("scenes fifty_layers --scale smoke --write " + mine).status == 0);
  CHECK(run_ogc(command + " --force").status == 0);
  CHECK(compare::read_bytes(folder / "mine/twist_cloth.ply") == mesh);
  CHECK(compare::read_scene(folder / "mine/twist.json").name == "twist");
  CHECK(run_ogc("scenes twist --force").status == 2);
}

TEST_CASE("ten lines are a scene: the example runs, and its cloth meets the stone", "[figure]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = OGC_SOURCE_DIR "/experiments/examples/drop/drop.json";
  CHECK(std::ranges::count(compare::read_bytes(file), '\n') <= 10);
  const ProgramResult result = run_ogc("run " + file.string() + " --audit every --json --out " +
                                       (folder / "run").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  CHECK(json.at("scene") == "drop");
  CHECK(json.at("guarantee_kept") == true);
  CHECK(json.at("contacts").at("most").get<int>() > 0);
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
