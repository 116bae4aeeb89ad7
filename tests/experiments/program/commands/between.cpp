// Tests what `ogc audit` reports about the motion between frames: without --between, that it was not checked; with
// --between, the primitives that meet during the motion.
#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns a mesh of two horizontal triangles, one at height 0 and one at the given height.
std::string two_triangles(const std::string& height) {
  return "v 0 0 0\nv 4 0 0\nv 0 0 4\nv 0.5 " + height + " 0.5\nv 2 " + height + " 0.5\nv 0.5 " + height +
         " 2\nf 1 2 3\nf 4 5 6\n";
}

/// Writes one frame for each height of the upper triangle.
std::string frames(const TemporaryFolder& folder, const std::vector<std::string>& heights) {
  std::string files;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const std::string file = (folder / ("frame_" + std::to_string(i) + ".obj")).string();
    compare::write_bytes(file, two_triangles(heights[i]));
    files += " " + file;
  }
  return files;
}

}  // namespace

// Between the heights 1 and −1, the upper triangle passes height 0 half way. Its three vertices meet the lower triangle
// there; no edges meet.
TEST_CASE("two sheets that change places between two frames meet, where the straight ways are asked", "[unit]") {
  const TemporaryFolder folder;
  const std::string files = frames(folder, {"2", "1", "-1"});
  const ProgramResult states = run_ogc("audit" + files);
  CHECK(states.status == 0);
  CHECK(contains(states.out, {"3 states audited exactly, 0 intersections\n", "between these states was not looked at",
                              "--between asks"}));
  const ProgramResult ways = run_ogc("audit --between" + files);
  CHECK(ways.status == 1);
  CHECK(contains(ways.out, {"0 intersections; 2 straight ways between them asked exactly, 3 meetings on 1 of them",
                            "frame_1.obj", "after 0.5 of the motion"}));
  CHECK(ways.out.find("not looked at") == std::string::npos);
  CHECK(contains(ways.err, {"2 straight ways between 3 states will take about", "MiB"}));
  const nlohmann::json json = nlohmann::json::parse(run_ogc("audit --between --json --limit 2" + files).out);
  CHECK(json.at("meetings") == 3);
  CHECK(json.at("ways").size() == 2);
  CHECK(json.at("ways")[0].at("count") == 0);
  CHECK(json.at("ways")[1].at("meetings").size() == 2);
  CHECK(json.at("ways")[1].at("meetings")[0].at("time") == 0.5);
  CHECK(!json.contains("unseen"));
  CHECK(nlohmann::json::parse(run_ogc("audit --json" + files).out).at("unseen").size() == 1);
}

TEST_CASE("ways without a meeting are clean, and one state has none", "[unit]") {
  const TemporaryFolder folder;
  CHECK(run_ogc("audit --between" + frames(folder, {"2", "1", "0.5"})).status == 0);
  const ProgramResult one = run_ogc("audit --between " + (folder / "frame_0.obj").string());
  CHECK(one.status == 0);
  CHECK(contains(one.out, {"1 state audited exactly, 0 intersections; 0 straight ways"}));
}

TEST_CASE("no way leads to a frame of another mesh: its name, and what came before it", "[unit]") {
  const TemporaryFolder folder;
  std::string files = frames(folder, {"2", "-1"});
  const std::string other = (folder / "frame_2.obj").string();
  compare::write_bytes(other, "v 0 0 0\nv 4 0 0\nv 0 0 4\nf 1 2 3\n");
  const ProgramResult result = run_ogc("audit --between" + files + " " + other);
  CHECK(result.status == 1);  // because of the earlier meetings
  CHECK(contains(result.err, {"frame_2.obj has other triangles than", "frame_1.obj", "leave --between out"}));
  CHECK(contains(result.out, {"1 straight way between them asked exactly, 3 meetings"}));
}
