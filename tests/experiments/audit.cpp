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

// Two equal right triangles, 1 mm apart: every vertex is 1 mm from the other triangle, every edge from its twin; the lowest numbers are named.
TEST_CASE("ogc audit gives the smallest distances with their primitives, in words and as JSON", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("parallel.obj", parallel_triangles_obj).string();
  const nlohmann::json distances = nlohmann::json::parse(run_ogc("audit --json " + mesh).out).at("states").at(0).at("smallest_distances");
  CHECK(distances.at("vertex_triangle").at("distance").get<double>() == Approx(0.001));
  CHECK(distances.at("vertex_triangle").at("vertex") == 0);
  CHECK(distances.at("vertex_triangle").at("triangle") == 1);
  CHECK(distances.at("vertex_triangle").at("triangle_vertices") == nlohmann::json{3, 4, 5});
  CHECK(distances.at("edge_edge").at("distance").get<double>() == Approx(0.001));
  CHECK(distances.at("edge_edge").at("edge") == 0);
  CHECK(distances.at("edge_edge").at("other_edge") == 3);
  CHECK(distances.at("edge_edge").at("other_edge_vertices") == nlohmann::json{3, 4});
  CHECK(contains(run_ogc("audit " + mesh).out, {"0.001 m, vertex 0 and triangle 1 (vertices 3, 4, 5)", "0.001 m, edge 0 (vertices 0, 1) and edge 3 (vertices 3, 4)"}));
}

TEST_CASE("ogc audit of a single triangle says that there is no pair", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  CHECK(contains(run_ogc("audit " + mesh).out, {"there is no such pair"}));
  CHECK(nlohmann::json::parse(run_ogc("audit --json " + mesh).out).at("states").at(0).at("smallest_distances").at("edge_edge").is_null());
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
