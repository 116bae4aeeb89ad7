#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

namespace {

nlohmann::json contacts(const TemporaryFolder& folder, const std::string& engine) {
  const std::string mesh = folder.write("parallel.obj", parallel_triangles_obj).string();
  const ProgramResult result = run_ogc("contacts " + mesh + " --radius 0.01 --query-radius 0.02 --json --engine " +
                                       engine);
  INFO(result.err);
  REQUIRE(result.status == 0);
  return nlohmann::json::parse(result.out);
}

}  // namespace

// In two equal right triangles 1 mm apart, each corner is above or below a corner of the other triangle. The three
// corners of each triangle have one contact each.
TEST_CASE("ogc contacts finds the corners of parallel triangles, with distances and bounds", "[unit]") {
  const TemporaryFolder folder;
  const nlohmann::json json = contacts(folder, "exact");
  CHECK(json.at("vertex_facet").size() == 6);
  for (const auto& contact : json.at("vertex_facet")) {
    CHECK(contact.at("face").at("kind") == "vertex");
    CHECK(contact.at("face").at("index") == (contact.at("vertex").get<int>() + 3) % 6);
    CHECK(contact.at("distance").get<double>() == Approx(0.001));
  }
  REQUIRE(json.at("bound").size() == 6);
  for (const auto& bound : json.at("bound")) CHECK(bound.get<double>() == Approx(0.45 * 0.001));
  CHECK(json.at("d_min_edge").size() == 6);
  CHECK(json.at("d_min_triangle").size() == 2);
}

TEST_CASE("ogc contacts lists its sets by primitive, with margins, layers and kinds of vertices", "[unit]") {
  const TemporaryFolder folder;
  const nlohmann::json json = contacts(folder, "exact");
  const nlohmann::json& sets = json.at("sets");
  for (std::size_t v = 0; v < 6; ++v) {
    CHECK(sets.at("layers").at(v) == 1);
    REQUIRE(sets.at("faces_near_vertex").at(v).size() == 1);
    CHECK(json.at("vertex_facet").at(sets.at("faces_near_vertex").at(v).at(0).get<std::size_t>()).at("vertex") == v);
    CHECK(json.at("vertex_kind").at(v) == "convex");
    CHECK(json.at("vertex_place").at(v) == "boundary");
  }
  CHECK(sets.at("vertices_near_facet") == nlohmann::json{{3, 4, 5}, {0, 1, 2}});
  for (const auto& contact : json.at("vertex_facet")) {
    CHECK(contact.at("penetration").get<double>() == Approx(0.009));
    // A margin is the distance to a boundary of the block. A corner's block has three: the sphere of radius r, and a
    // plane across each of the corner's two edges. The vertex lies on both planes.
    CHECK(contact.at("margins").size() == 3);
    CHECK(contact.at("margins").at(1).at("sign") == 0);
    CHECK(contact.at("margins").at(1).at("closed") == true);
  }
}

TEST_CASE("ogc contacts gives the same sets by the exact and the fast engine, and safe bounds", "[agreement]") {
  const TemporaryFolder folder;
  const nlohmann::json exact = contacts(folder, "exact"), fast = contacts(folder, "cpu");
  const auto names = [](const nlohmann::json& json) {
    std::vector<std::string> all;
    for (const auto& contact : json.at("vertex_facet"))
      all.push_back(contact.at("vertex").dump() + contact.at("face").dump());
    for (const auto& contact : json.at("edge_edge"))
      all.push_back(contact.at("first").dump() + contact.at("second").dump());
    return all;
  };
  CHECK(names(fast) == names(exact));
  for (std::size_t v = 0; v < 6; ++v)
    CHECK(fast.at("bound").at(v).get<double>() <= exact.at("bound").at(v).get<double>());
}

TEST_CASE(
    "ogc contacts --squares prints smallest distances and bounds as exact fractions, and refuses where there are none",
    "[unit]") {
  const TemporaryFolder folder;
  const std::string mesh =
      folder.write("steps.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.75\nv 1 0 0.75\nv 0 1 0.75\nf 1 2 3\nf 4 5 6\n")
          .string();
  const ProgramResult result = run_ogc("contacts " + mesh + " --radius 1 --json --squares");
  REQUIRE(result.status == 0);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  for (const char* name : {"d_min_vertex_squared", "d_min_edge_squared", "d_min_triangle_squared"}) {
    for (const auto& square : json.at(name)) CHECK(square == "9/16");
  }
  // In single precision γ_p = 0.45 is 7549747/2²⁴. The fraction cannot be reduced, because 9 · 7549747² is odd.
  for (const auto& square : json.at("bound_squared")) CHECK(square == "512988117876081/4503599627370496");
  CHECK(run_ogc("contacts " + mesh + " --squares").status == 2);
  CHECK(run_ogc("contacts " + mesh + " --json --squares --engine cpu").status == 2);
}

TEST_CASE("ogc contacts says how many predicates intervals decided", "[unit]") {
  const TemporaryFolder folder;
  const nlohmann::json json = contacts(folder, "exact");
  const auto& filters = json.at("filters");
  // Each of six corners is tested against the other triangle, each edge against three edges.
  CHECK(filters.at("distance_below").at("calls") >= 6);
  for (const auto& [predicate, count] : filters.items())
    CHECK(count.at("undecided").get<int>() <= count.at("calls").get<int>());
  CHECK_FALSE(contacts(folder, "cpu").contains("filters"));
  CHECK(contains(run_ogc("contacts " + folder.write("parallel.obj", parallel_triangles_obj).string()).out,
                 {"undecided", "distance_below", "share"}));
}

TEST_CASE("ogc contacts says in words what is close", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("contacts " + folder.write("parallel.obj", parallel_triangles_obj).string());
  REQUIRE(result.status == 0);
  CHECK(contains(result.out, {"6 vertices", "2 triangles", "6 vertex-facet contacts", "0.001 m", "nothing within r_q",
                              "bounds from"}));
}

TEST_CASE("ogc contacts warns where the mesh intersects itself", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("contacts --json " +
                                       folder.write("crossing.obj", crossing_triangles_obj).string());
  REQUIRE(result.status == 0);
  CHECK(contains(result.err, {"crossing.obj", "intersects itself", "2 pairs"}));
  CHECK(nlohmann::json::parse(result.out).at("intersections") == 2);
  CHECK(run_ogc("contacts " + folder.write("parallel.obj", parallel_triangles_obj).string()).err.empty());
}

TEST_CASE("ogc contacts refuses bad meshes and radii with exit status 2, naming them", "[unit]") {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.obj", parallel_triangles_obj).string();
  const std::string bad_number = folder.write("nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n").string();
  const std::string flat = folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").string();
  ProgramResult result = run_ogc("contacts " + bad_number);
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"nan.obj"}));
  result = run_ogc("contacts " + flat);
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"flat.obj", "no face that has an area", "face 1 (line 4)"}));
  result = run_ogc("contacts " + (folder / "missing.obj").string());
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"missing.obj"}));
  CHECK(run_ogc("contacts " + good + " --radius -1").status == 2);
  CHECK(run_ogc("contacts --json").status == 2);
  CHECK(run_ogc("contacts --ipc --engine cpu " + good).status == 2);
  CHECK(run_ogc("contacts " + good + " --radius 0.1 --query-radius 0.05").status == 2);
}
