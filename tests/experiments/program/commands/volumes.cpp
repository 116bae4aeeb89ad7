// Scenes with volumes, by solvers that have none.
#include <string>

#include "compare/files/scenes/scene_files.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("a solver that has no volumes refuses them by name, before anything is written", "[unit]") {
  const TemporaryFolder folder;
  compare::Scene scene = solid_scene();
  scene.bodies[0].contact = compare::BodyContact::volume;
  const std::string file = write_scene(folder / "scene", scene).string();
  for (const std::string solver : {"vbd", "reference_vbd", "newton", "ipc"}) {
    const std::filesystem::path out = folder / solver;
    const ProgramResult result = run_ogc("run " + file + " --solver " + solver + " --out " + out.string());
    INFO(result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"body 'block' is a volume, which", solver == "reference_vbd" ? "vbd" : solver,
                                "does not simulate", "leave the body a surface"}));
    CHECK(!std::filesystem::exists(out));
  }
}
