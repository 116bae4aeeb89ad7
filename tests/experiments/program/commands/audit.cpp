#include <nlohmann/json.hpp>

#include "compare/files/meshes/mesh_files.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

// The edges from vertex 3 (below) to 4 and 5 (above) cross the plane z = 0 inside triangle 0. OBJ numbers vertices from
// 1.
TEST_CASE("ogc audit of crossing triangles exits 1 and lists the pairs", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("crossing.obj", crossing_triangles_obj).string();
  const ProgramResult text = run_ogc("audit " + mesh), result = run_ogc("audit --json " + mesh);
  CHECK(text.status == 1);
  CHECK(contains(text.out, {"edge (vertices 4, 5; lines 4, 5) meets face 1 (vertices 1, 2, 3; line 7)",
                            "edge (vertices 4, 6; lines 4, 6)", "2 intersections"}));
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

// In two equal right triangles 1 mm apart, every vertex is 1 mm from the other triangle, and every edge is 1 mm from
// the equal edge. The lowest-numbered primitives must be named.
TEST_CASE("ogc audit gives the smallest distances with their primitives, in words and as JSON", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("parallel.obj", parallel_triangles_obj).string();
  const nlohmann::json distances =
      nlohmann::json::parse(run_ogc("audit --json " + mesh).out).at("states").at(0).at("smallest_distances");
  CHECK(distances.at("vertex_triangle").at("distance").get<double>() == Approx(0.001));
  CHECK(distances.at("vertex_triangle").at("vertex") == 0);
  CHECK(distances.at("vertex_triangle").at("triangle") == 1);
  CHECK(distances.at("vertex_triangle").at("triangle_vertices") == nlohmann::json{3, 4, 5});
  CHECK(distances.at("edge_edge").at("distance").get<double>() == Approx(0.001));
  CHECK(distances.at("edge_edge").at("edge") == 0);
  CHECK(distances.at("edge_edge").at("other_edge") == 3);
  CHECK(distances.at("edge_edge").at("other_edge_vertices") == nlohmann::json{3, 4});
  CHECK(contains(run_ogc("audit " + mesh).out,
                 {"0.001 m, vertex 1 (line 1) and face 2 (vertices 4, 5, 6; line 8)",
                  "0.001 m, edge (vertices 1, 2; lines 1, 2) and edge (vertices 4, 5; lines 4, 5)"}));
}

TEST_CASE("ogc audit of a single triangle says that there is no pair", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
  CHECK(contains(run_ogc("audit " + mesh).out, {"there is no such pair"}));
  CHECK(nlohmann::json::parse(run_ogc("audit --json " + mesh).out)
            .at("states")
            .at(0)
            .at("smallest_distances")
            .at("edge_edge")
            .is_null());
}

TEST_CASE("ogc audit refuses what is neither a mesh nor a run with exit status 2", "[unit]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "empty");
  for (const std::string& path : {(folder / "missing.ply").string(), (folder / "empty").string(),
                                  folder.write("notes.txt", "no mesh").string()}) {
    const ProgramResult result = run_ogc("audit " + path);
    INFO(path << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"ogc: ", path}));
  }
}

namespace {

/// Returns the file names of the states that have intersections.
std::vector<std::string> intersecting(const nlohmann::json& verdict) {
  std::vector<std::string> names;
  for (const nlohmann::json& state : verdict.at("states"))
    if (state.at("count") > 0) names.push_back(std::filesystem::path(state.at("state")).filename());
  return names;
}

/// Writes the meshes frame_0 to frame_11. Only 10 and 11 have intersections.
void write_frames(const TemporaryFolder& folder) {
  for (int k = 0; k < 12; ++k)
    folder.write("frame_" + std::to_string(k) + ".obj", k < 10 ? parallel_triangles_obj : crossing_triangles_obj);
}

}  // namespace

TEST_CASE("a folder, a pattern and a list of frames are audited in natural order, each frame by itself", "[unit]") {
  const TemporaryFolder folder;
  write_frames(folder);
  std::string list;
  for (const int k : {11, 10, 9}) list += (folder / ("frame_" + std::to_string(k) + ".obj")).string() + " ";
  const std::string whole = (folder / ".").string(), pattern = "'" + (folder / "frame_*.obj").string() + "'";
  for (const std::string& paths : {whole, pattern, list}) {
    const ProgramResult result = run_ogc("audit --json " + paths);
    INFO(paths << "\n" << result.err);
    CHECK(result.status == 1);
    const nlohmann::json verdict = nlohmann::json::parse(result.out);
    CHECK(intersecting(verdict) == std::vector<std::string>{"frame_10.obj", "frame_11.obj"});
    CHECK(verdict.at("states").size() == (paths == list ? 3 : 12));
    CHECK(verdict.at("intersecting_states") == 2);
    CHECK_THAT(verdict.at("first_intersecting").get<std::string>(), Catch::Matchers::EndsWith("frame_10.obj"));
    CHECK(verdict.at("complete") == true);
  }
  const ProgramResult words = run_ogc("audit " + whole);
  CHECK(contains(words.out, {"12 states audited exactly, 4 intersections in 2 states, the first: ",
                             "frame_10.obj: 2 intersections"}));
  CHECK(contains(words.err, {"frame 12/12"}));
}

TEST_CASE("a frame that can't be read is named, and what was audited before it is reported", "[unit]") {
  const TemporaryFolder folder;
  write_frames(folder);
  folder.write("frame_4.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n");
  const ProgramResult result = run_ogc("audit --json '" + (folder / "*.obj").string() + "'");
  CHECK(result.status == 2);
  const nlohmann::json verdict = nlohmann::json::parse(result.out);
  CHECK(verdict.at("states").size() == 4);
  CHECK(verdict.at("complete") == false);
  CHECK_THAT(verdict.at("stopped").get<std::string>(), ContainsSubstring("frame_4.obj: line 3"));
  CHECK(contains(result.err, {"frame_4.obj: line 3"}));
}

TEST_CASE("frames that can't be a sequence are refused with what to do", "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", parallel_triangles_obj).string(),
                    cache = folder.write("c.pc2", "POINTCACHE2").string();
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"'" + (folder / "*.ply").string() + "'", "no file matches"},
      {mesh + " --mesh " + mesh, "--mesh"},
      {mesh + " " + cache, "name it alone"},
      {cache + " --mesh " + mesh, "the header: the file ends at byte 11"},
      {folder.write("x.npz", "PK").string(), "no zip archive"},
      {folder.write("x.npy", "0123456789").string() + " --mesh " + mesh, "no .npy array"}};
  for (const auto& [arguments, reason] : wrong) {
    const ProgramResult result = run_ogc("audit " + arguments);
    INFO(arguments << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {reason}));
  }
}

TEST_CASE("an audit of curves says that states say nothing about them, not that they are clean", "[unit]") {
  const TemporaryFolder folder;
  const std::string yarn = folder.write("yarn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.1\nv 1 -1 0.1\nl 1 2\nl 3 4\n").string();
  const ProgramResult words = run_ogc("audit " + yarn), result = run_ogc("audit --json " + yarn);
  CHECK(words.status == 0);
  CHECK(contains(words.out, {"2 edges without a triangle", "passed through each other"}));
  CHECK(words.out.find("0 intersections") == std::string::npos);
  CHECK(nlohmann::json::parse(result.out).at("clean").is_null());
  const std::string crossed =
      folder.write("crossed.obj", "v -1 0 0\nv 1 0 0\nv 0 -1 0\nv 0 1 0\nl 1 2\nl 3 4\n").string();
  const ProgramResult touching = run_ogc("audit " + crossed), found = run_ogc("audit --json " + crossed);
  CHECK(touching.status == 1);
  CHECK(contains(touching.out, {"1 intersection", "meets edge"}));
  const nlohmann::json pair = nlohmann::json::parse(found.out).at("states").at(0).at("intersections").at(0);
  CHECK(pair.at("kind") == "edge_edge");
  CHECK(pair.at("other_edge") == 1);
  CHECK(nlohmann::json::parse(found.out).at("clean") == false);
  CHECK(run_ogc("audit " + crossed + " --show " + (folder / "show").string()).status == 1);
  CHECK(std::filesystem::exists(folder / "show/crossed.vtp"));
  const std::string mixed =
      folder.write("mixed.obj", std::string(parallel_triangles_obj) + "v 5 0 0\nv 6 0 0\nl 7 8\n").string();
  CHECK(contains(run_ogc("audit " + mixed).out, {"0 intersections", "of 1 edge without a triangle"}));
  CHECK(nlohmann::json::parse(run_ogc("audit --json " + mixed).out).at("clean") == true);
}

// The mesh of the intersections must contain both triangles and both edges that pass through a triangle.
TEST_CASE("the option --show writes what intersects as a mesh that can be audited itself", "[unit]") {
  const TemporaryFolder folder;
  write_frames(folder);
  const std::string show = (folder / "show").string();
  const nlohmann::json verdict = nlohmann::json::parse(
      run_ogc("audit --json '" + (folder / "*.obj").string() + "' --show " + show).out);
  CHECK(verdict.at("shown").size() == 2);
  const compare::Mesh part = compare::read_mesh(folder / "show/frame_10.vtp");
  CHECK(part.positions.size() == 6);
  CHECK(part.triangles == std::vector<compare::Triangle>{{0, 1, 2}, {3, 4, 5}});
  CHECK(part.loose_edges == std::vector<compare::Edge>{{3, 4}, {3, 5}});
  CHECK(run_ogc("audit " + (folder / "show/frame_11.vtp").string()).status == 1);
  CHECK_THAT(verdict.at("shown").at(0).get<std::string>(),
             ContainsSubstring("between (") && ContainsSubstring("frame_10.vtp"));
}

TEST_CASE("a run of an intersecting start says where, and --show writes it", "[unit]") {
  const TemporaryFolder folder;
  REQUIRE(run_ogc("scenes cloth_on_sphere --scale smoke --write " + (folder / "scene").string()).status == 0);
  // The cloth is replaced by a second sphere, which touches the first one everywhere.
  std::filesystem::copy_file(folder / "scene/cloth_on_sphere_sphere.ply", folder / "scene/cloth_on_sphere_cloth.ply",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string scene = (folder / "scene/cloth_on_sphere.json").string(),
                    out = " --out " + (folder / "run").string();
  const ProgramResult plain = run_ogc("run " + scene + out);
  INFO(plain.err);
  CHECK(plain.status == 2);
  CHECK(contains(plain.err, {"between (", "--show DIR"}));
  const ProgramResult shown = run_ogc("run " + scene + out + " --show " + (folder / "show").string());
  CHECK(shown.status == 2);
  CHECK(contains(shown.err, {(folder / "show/start.vtp").string()}));
  CHECK(std::filesystem::exists(folder / "show/start.vtp"));
}
