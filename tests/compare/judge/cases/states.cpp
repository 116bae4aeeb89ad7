#include "compare/judge/cases/states.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/corpus.hpp"
#include "compare/judge/report/report.hpp"
#include "compare/problem/error.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

std::filesystem::path write_run(const std::filesystem::path& folder, const Scene& scene) {
  RunWriter run(folder, scene, recorded_provenance(), {});
  for (std::int64_t step = 0; step < 3; ++step) run.add_frame(recorded_frame(step));
  run.finish("finished");
  return folder;
}

/// Returns a scene with cases for every stage except the stages of solids: a fixed yarn, a hinge in the cloth, a
/// spring.
Scene full_scene() {
  Scene scene = recorded_scene();
  scene.bodies[0].fixed = false;
  scene.bodies[2].fixed = true;
  scene.springs.push_back({1, 5, 20, 0.5, 0.001});
  scene.settings.contact_radius = 2;  // larger than the distances in all frames
  return scene;
}

/// Writes a run with one frame of a stretched block.
std::filesystem::path write_solid_run(const std::filesystem::path& folder) {
  Scene scene = solid_scene();
  round_to_single(scene);
  RunWriter run(folder, scene, recorded_provenance(), {});
  std::vector<Vec3f> positions = to_single(scene.mesh.positions);
  for (Vec3f& x : positions) x.y *= 1.25f;
  run.add_frame({.step = 0,
                 .time = 0,
                 .positions = positions,
                 .velocities = std::vector<Vec3f>(positions.size()),
                 .bounds = std::vector<float>(positions.size(), 0.005f)});
  run.finish("finished");
  return folder;
}

/// Returns three square sheets of 4 × 4 cells. The second sheet is half of r above the first and falls at 1 mm/s. It is
/// rotated against the first, because contacts of parallel edges have no stiffness. The third sheet is far away.
Scene facing_sheets() {
  Scene scene;
  scene.name = "facing_sheets";
  constexpr Index side = 5;
  constexpr double edge = 0.01;
  for (Index body = 0; body < 3; ++body) {
    for (Index i = 0; i < side * side; ++i) {
      const double x = edge * (i % side), z = edge * (i / side), angle = body == 1 ? 0.3 : 0.0;
      scene.mesh.positions.push_back({x * std::cos(angle) - z * std::sin(angle) + (body == 2 ? 1.0 : 0.0),
                                      body == 1 ? 0.0025 : 0.0, x * std::sin(angle) + z * std::cos(angle)});
    }
    for (Index j = 0; j + 1 < side; ++j)
      for (Index i = 0; i + 1 < side; ++i) {
        const Index a = body * side * side + j * side + i;
        scene.mesh.triangles.push_back({a, a + 1, a + side});
        scene.mesh.triangles.push_back({a + 1, a + side + 1, a + side});
      }
    scene.bodies.push_back({.name = "sheet_" + std::to_string(body),
                            .first_vertex = body * side * side,
                            .vertex_count = side * side,
                            .first_triangle = body * 2 * (side - 1) * (side - 1),
                            .triangle_count = 2 * (side - 1) * (side - 1),
                            .fixed = false,
                            .material = {}});
  }
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.assign(scene.mesh.positions.size(), {});
  for (Index v = side * side; v < 2 * side * side; ++v) scene.velocities[static_cast<std::size_t>(v)] = {0, -0.001, 0};
  round_to_single(scene);
  return scene;
}

}  // namespace

TEST_CASE("frames of a run become cases, whole for detection and pair by pair", "[unit]") {
  const Scratch scratch;
  const States states(write_run(scratch / "run", full_scene()), ogc::reference::authority());
  const auto make = [&](Stage stage, std::uint64_t index) {
    return generate({stage, "states", 1, index, states.folder(), {}}, &states).data;
  };
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Frame frame = recorded_frame(static_cast<std::int64_t>(i % 3));
    const auto mesh = case_of<MeshCase>(make(Stage::detect_edge_edge, i));
    REQUIRE(mesh.positions == frame.positions);
    REQUIRE(mesh.rigid_groups == rigid_groups(full_scene()));
    REQUIRE(mesh.query_radius >= mesh.contact_radius);
    REQUIRE(case_of<BoundCase>(make(Stage::bound, i)).d_min_vertex.size() == 10);
    REQUIRE(case_of<SweepCase>(make(Stage::sweep, i)).previous == frame.positions);
    REQUIRE(to_single(case_of<StepCase>(make(Stage::step, i)).scene->mesh.positions) == frame.positions);
    REQUIRE(case_of<MembraneCase>(make(Stage::membrane, i)).area > 0);
    REQUIRE(case_of<BendingCase>(make(Stage::bending, i)).stiffness > 0);
    REQUIRE(case_of<ActivationCase>(make(Stage::activation, i)).contact_radius == mesh.contact_radius);
    const auto spring = case_of<SpringCase>(make(Stage::spring, i));
    REQUIRE(spring.rest_length == 0.5f);
    REQUIRE((spring.start[0] == frame.positions[1] || spring.start[0] == frame.positions[5]));
  }
}

TEST_CASE("every stage has cases of a run that has everything, as they are and mutated, and the same ones again",
          "[property]") {
  const Scratch scratch;
  const States surfaces(write_run(scratch / "run", full_scene()), ogc::reference::authority());
  const States solids(write_solid_run(scratch / "solid"), ogc::reference::authority());
  for (const Stage stage : all_stages) {
    INFO(stage_name(stage));
    const States& states = stage == Stage::tetrahedron ? solids : surfaces;
    REQUIRE(states.missing(stage).empty());
    for (const std::string generator : {"states", "mutated"}) {
      const CaseName name{stage, generator, 1, 4, states.folder(), {}};
      const TestCase test = generate(name, &states), again = generate(parse_problem(print_problem(name)), &states);
      REQUIRE(case_to_json(again, "") == case_to_json(test, ""));
      REQUIRE(case_to_json(load_case(save_case(scratch / generator, test, "")), "") == case_to_json(test, ""));
    }
  }
}

TEST_CASE("stencils of contact and friction are contacts of the frame, and nearly all of them act", "[property]") {
  const Scratch scratch;
  const Scene scene = facing_sheets();
  const Authority authority = ogc::reference::authority();
  RunWriter run(scratch / "run", scene, recorded_provenance(), {});
  const std::vector<Vec3f> positions = to_single(scene.mesh.positions);
  run.add_frame({.step = 0,
                 .time = 0,
                 .positions = positions,
                 .velocities = to_single(scene.velocities),
                 .bounds = std::vector<float>(positions.size(), 0.0025f)});
  run.finish("finished");
  const States states(scratch / "run", authority);
  int acting = 0, pairs_in_reach = 0;
  constexpr int count = 200;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto make = [&](Stage stage) { return generate({stage, "states", 1, i, states.folder(), {}}, &states).data; };
    const auto contact = case_of<ContactForceCase>(make(Stage::contact_force));
    acting += authority.contact_force({{contact}}).accepted[0][0].block != std::array<double, 6>{};
    const auto friction = case_of<FrictionForceCase>(make(Stage::friction_force));
    for (const Vec3f& x : friction.start) CHECK(x.x < 0.5f);  // nothing touches the third sheet
    CHECK(case_of<ActivationCase>(make(Stage::activation)).distance <
          static_cast<float>(scene.settings.contact_radius));
    const auto pair = case_of<ClosestFaceCase>(make(Stage::closest_face));
    pairs_in_reach += authority.closest_face({{pair.point}, {pair.triangle}}).distance[0] <
                      scene.settings.contact_radius;
  }
  CHECK(acting >= count * 9 / 10);
  CHECK(pairs_in_reach >= count / 3);
}

TEST_CASE("a stage of which a run has nothing says why, in the report and to who asks for a case", "[unit]") {
  const Scratch scratch;
  const Authority authority = ogc::reference::authority();
  const States states(write_run(scratch / "run", recorded_scene()), authority);
  REQUIRE(states.missing(Stage::spring) == "its scene has no spring");
  REQUIRE(states.missing(Stage::tetrahedron) == "no body that moves has tetrahedra");
  REQUIRE(states.missing(Stage::contact_force) == "none of its frames has a contact");
  REQUIRE_THROWS_WITH(generate({Stage::spring, "states", 1, 0, states.folder(), {}}, &states),
                      ContainsSubstring("its scene has no spring"));
  Contestant contestant;
  contestant.spring = [&](const SpringIn& in) {
    ForceOut out;
    for (const auto& accepted : authority.spring(in).accepted) {
      const ForceAnswer& right = accepted[0];
      out.force.push_back(
          {static_cast<float>(right.force.x), static_cast<float>(right.force.y), static_cast<float>(right.force.z)});
      out.block.emplace_back();
      std::copy(right.block.begin(), right.block.end(), out.block.back().begin());
    }
    return out;
  };
  JudgeOptions options;
  options.cases = 50;
  options.states = &states;
  const std::vector<StageReport> reports{judge_stage(Stage::spring, contestant, authority, options)};
  REQUIRE(reports[0].passed());
  REQUIRE_THAT(report_table(reports),
               ContainsSubstring("no states of " + states.folder() + ": its scene has no spring"));
}

TEST_CASE("frames of a run, which flat sheets fill with ties, are held to no share of grey decisions", "[unit]") {
  for (const Stage stage : all_stages)
    for (const char* name : {"states", "mutated"}) CHECK_FALSE(find_generator(stage, name).generic);
}

TEST_CASE("a folder that is no run is refused", "[unit]") {
  const Scratch scratch;
  REQUIRE_THROWS_AS(States(scratch / "nothing", ogc::reference::authority()), InputError);
}
