#include "compare/judge/states.hpp"

#include "compare/judge/corpus.hpp"
#include "compare/judge/generators.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

std::filesystem::path write_run(const std::filesystem::path& folder) {
  RunWriter run(folder, recorded_scene(), recorded_provenance(), {});
  for (std::int64_t step = 0; step < 3; ++step) run.add_frame(recorded_frame(step));
  run.finish("finished");
  return folder;
}

}  // namespace

TEST_CASE("frames of a run become cases, whole for detection and pair by pair", "[unit]") {
  const Scratch scratch;
  const States states(write_run(scratch / "run"));
  const auto make = [&](Stage stage, std::uint64_t index) { return generate({stage, "states", 1, index, states.folder()}, &states).data; };
  for (std::uint64_t i = 0; i < 6; ++i) {
    const auto mesh = std::get<MeshCase>(make(Stage::detect_edge_edge, i));
    REQUIRE(mesh.positions == recorded_frame(static_cast<std::int64_t>(i % 3)).positions);
    REQUIRE(mesh.rigid_groups == rigid_groups(recorded_scene()));
    REQUIRE(mesh.query_radius >= mesh.contact_radius);
    REQUIRE(std::get<BoundCase>(make(Stage::bound, i)).d_min_vertex.size() == 10);
    REQUIRE(std::holds_alternative<ClosestFaceCase>(make(Stage::closest_face, i)));
    REQUIRE(std::holds_alternative<ClosestPointsCase>(make(Stage::closest_points, i)));
    REQUIRE(std::get<SweepCase>(make(Stage::sweep, i)).previous == recorded_frame(static_cast<std::int64_t>(i % 3)).positions);
    REQUIRE(to_single(std::get<StepCase>(make(Stage::step, i)).scene->mesh.positions) == recorded_frame(static_cast<std::int64_t>(i % 3)).positions);
    REQUIRE(std::holds_alternative<TruncateCase>(make(Stage::truncate, i)));
  }
  REQUIRE_THROWS_AS(make(Stage::activation, 0), InputError);
}

TEST_CASE("a folder that is no run is refused", "[unit]") {
  const Scratch scratch;
  REQUIRE_THROWS_AS(States(scratch / "nothing"), InputError);
}
