// Scenes with rods, by solvers that have none.
#include <string>

#include "compare/files/scenes/scene_files.hpp"
#include "tests/catch.hpp"
#include "tests/compare/record/small_run.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("a solver that has no rods refuses them by name, before anything is written", "[unit]") {
  const TemporaryFolder folder;
  const std::string file = write_scene(folder / "scene", recorded_scene()).string();
  for (const std::string solver : {"ipc"}) {
    const std::filesystem::path out = folder / solver;
    const ProgramResult result = run_ogc("run " + file + " --solver " + solver + " --out " + out.string());
    INFO(result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"body 'yarn' is a rod, which", solver, "does not simulate"}));
    CHECK(!std::filesystem::exists(out));
  }
}
