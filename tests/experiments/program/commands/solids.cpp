// Tests solids that users provide: an MSH file alone, and an MSH file in a scene with cloth.
#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "compare/problem/material_table.hpp"
#include "compare/record/run_folder.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

const std::string example = OGC_SOURCE_DIR "/experiments/examples/solid_on_cloth/";

struct Finished {
  ProgramResult said;
  compare::Scene scene;
  compare::Frame last;
};

Finished run(const TemporaryFolder& folder, const std::string& words) {
  const ProgramResult result = run_ogc("run " + words + " --json --out " + (folder / "run").string());
  INFO(result.out << result.err);
  REQUIRE(result.status == 0);
  const bool audited = words.find("--audit off") == std::string::npos;
  CHECK(nlohmann::json::parse(result.out).at("guarantee_kept") == (audited ? nlohmann::json(true) : nlohmann::json()));
  const compare::RunReader reader(folder / "run");
  return {result, reader.scene(), reader.frame(reader.frame_count() - 1)};
}

/// Returns the lowest and the highest y of a body's vertices at the end of the run [m].
std::pair<float, float> lowest_and_highest(const Finished& run, const compare::Body& body) {
  const auto first = run.last.positions.begin() + body.first_vertex;
  const auto [low, high] = std::minmax_element(first, first + body.vertex_count,
                                               [](const auto& a, const auto& b) { return a.y < b.y; });
  return {low->y, high->y};
}

}  // namespace

TEST_CASE("an MSH alone falls on a ground as a solid, of the material that is set", "[property]") {
  const TemporaryFolder folder;
  const Finished end = run(folder, example +
                                       "block.msh --ground 0.1 --audit end --set solid_poisson=0.25 "
                                       "--set solid_young=5e4 --set solid_density=500");
  CHECK(contains(end.said.err, {"is taken as a solid of 500 kg/m³", "5e+04 Pa", "Poisson's ratio 0.25"}));
  const compare::Body& solid = end.scene.bodies[0];
  CHECK(solid.name == "solid");
  CHECK(solid.tetrahedron_count == 162);
  CHECK(solid.material.solid_mu == Approx(5e4 / 2.5));
  CHECK(solid.material.solid_lambda == Approx(5e4 * 0.25 / (1.25 * 0.5)));
  // The solid's weight causes 500 Pa at its foot, 1 % of Young's modulus, so its height hardly changes.
  const auto [low, high] = lowest_and_highest(end, solid);
  CHECK(low > 0.1f);
  CHECK(low < 0.1 + 2 * end.scene.settings.contact_radius);
  CHECK(high - low == Approx(0.1).epsilon(0.1));
}

TEST_CASE("a modulus that is set keeps Poisson's ratio, and the other way round", "[unit]") {
  compare::Material material;
  compare::set_elasticity(material, {3e4, 0.4});
  const compare::Elasticity found = compare::elasticity_of(material);
  CHECK(found.young == Approx(3e4));
  CHECK(found.poisson == Approx(0.4));
  const TemporaryFolder folder;
  const Finished end = run(folder,
                           "mat_twist --scale smoke --steps 1 --audit off --set solid_young=4e4 "
                           "--set friction=0");
  const compare::Elasticity set = compare::elasticity_of(end.scene.bodies[0].material);
  CHECK(set.young == Approx(4e4));
  CHECK(set.poisson == Approx(0.4));
  CHECK(end.scene.bodies[0].material.friction == 0);
}

TEST_CASE("a solid falls on a cloth that is held by its corners and is carried by it", "[property]") {
  const TemporaryFolder folder;
  const Finished end = run(folder, example + "solid_on_cloth.json --audit frame");
  const auto [block_low, block_high] = lowest_and_highest(end, end.scene.bodies[0]);
  const auto [cloth_low, cloth_high] = lowest_and_highest(end, end.scene.bodies[1]);
  CHECK(block_low > cloth_low);
  CHECK(block_low < cloth_high);
  CHECK(block_high > cloth_high);
  // In free fall the block would sink by 3.1 m in 0.8 s.
  CHECK(block_low > -0.2f);
}

TEST_CASE("ogc suggest knows a solid, and its command runs it", "[unit]") {
  const ProgramResult result = run_ogc("suggest " + example + "block.msh");
  CHECK(result.status == 0);
  CHECK(contains(result.out, {"a soft solid of 1000 kg/m³ that falls by", "contact_radius", "ogc run "}));
}
