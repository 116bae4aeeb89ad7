// Tests two triangles in one plane that share an edge and overlap. Audits must report them, and a run must refuse to
// start from them.
#include "compare/files/bytes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("triangles that cross beside their common edge are an intersection, and a run from them is refused",
          "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = (folder / "bow_tie.obj").string();
  compare::write_bytes(mesh, "v 0 0.2 0\nv 2 0.2 0\nv 0.5 0.2 2\nv 1.5 0.2 2\nf 1 2 3\nf 1 2 4\n");
  const ProgramResult audit = run_ogc("audit " + mesh + " --show " + (folder / "shown").string());
  CHECK(audit.status == 1);
  CHECK(contains(audit.out, {"1 intersection", "edge (vertices 1, 4; lines 1, 4) meets edge (vertices 2, 3; lines"}));
  CHECK(std::filesystem::exists(folder / "shown/bow_tie.vtp"));
  const ProgramResult run = run_ogc("run " + mesh + " --out " + (folder / "run").string());
  CHECK(run.status == 2);
  CHECK(contains(run.err, {"starts with 1 intersection", "vertices 1, 4"}));
  CHECK(!std::filesystem::exists(folder / "run"));
}
