#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

// The edges from vertex 3 (below) to 4 and to 5 (above) cross the plane z = 0 inside triangle 0; edges are sorted by vertices: (3,4) is 3, (3,5) is 4.
TEST_CASE("ogc audit of crossing triangles exits 1 and lists the pairs", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("crossing.obj", crossing_triangles_obj).string();
  const ProgramResult text = run_ogc("audit " + mesh), result = run_ogc("audit --json " + mesh);
  CHECK(text.status == 1);
  CHECK(contains(text.out, {"edge 3", "edge 4", "triangle 0", "2 intersections"}));
  CHECK(result.status == 1);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  CHECK(json.at("clean") == false);
  CHECK(json.at("intersections") == 2);
  const nlohmann::json& pair = json.at("states").at(0).at("intersections").at(0);
  CHECK(pair.at("kind") == "edge_triangle");
  CHECK(pair.at("edge_vertices") == nlohmann::json{3, 4});
  CHECK(pair.at("triangle_vertices") == nlohmann::json{0, 1, 2});
}

TEST_CASE("ogc audit of separate triangles exits 0", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("audit --json " + folder.write("parallel.obj", parallel_triangles_obj).string());
  CHECK(result.status == 0);
  CHECK(nlohmann::json::parse(result.out).at("clean") == true);
}

TEST_CASE("ogc audit refuses what is neither a mesh nor a run with exit status 2", "[unit]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "empty");
  for (const std::string& path : {(folder / "missing.ply").string(), (folder / "empty").string(), folder.write("notes.txt", "no mesh").string()}) {
    const ProgramResult result = run_ogc("audit " + path);
    INFO(path << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"ogc: ", path}));
  }
}
