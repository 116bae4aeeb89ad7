#include "compare/judge/report/corpus.hpp"

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "compare/files/meshes/obj.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/report/shape.hpp"
#include "compare/oracle/smallest_distances.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;
using ogc::tests::Scratch;

namespace {

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

}  // namespace

TEST_CASE("a saved case comes back bit for bit, for every stage", "[property]") {
  const Scratch folder;
  for (const Stage stage : all_stages)
    for (const Generator& generator : generators(stage)) {
      const TestCase test = generate({stage, std::string(generator.name), 5, 17, "", {}});
      const auto path = save_case(folder.folder(), test, "why");
      INFO(path.string());
      REQUIRE(path.extension() == ".h5");
      const TestCase loaded = load_case(path);
      REQUIRE(loaded.name == test.name);
      REQUIRE(case_to_json(loaded, "why") == case_to_json(test, "why"));
    }
}

TEST_CASE("parameters stand in the file and in its name", "[unit]") {
  const Scratch folder;
  const CaseName name = parse_problem("stage=truncate gen=uniform seed=1 index=2 b=0.25");
  const auto path = save_case(folder.folder(), generate(name), "");
  REQUIRE(path != save_case(folder.folder(), generate(parse_problem("stage=truncate gen=uniform seed=1 index=2")), ""));
  REQUIRE(load_case(path).name == name);
  REQUIRE(case_of<TruncateCase>(load_case(path).data).bound == 0.25f);
}

TEST_CASE("a case written by hand as JSON is read too", "[unit]") {
  const Scratch folder;
  const TestCase test = generate(
      parse_problem("stage=sweep gen=" + std::string(generators(Stage::sweep)[0].name) + " seed=1 index=2"));
  write(folder / "case.json", case_to_json(test, "why").dump());
  REQUIRE(case_to_json(load_case(folder / "case.json"), "") == case_to_json(test, ""));
}

TEST_CASE("a mesh case is saved with a mesh and a picture to look at", "[unit]") {
  const Scratch folder;
  auto path = save_case(folder.folder(), generate({Stage::detect_edge_edge, "ladder.fan", 5, 1, "", {}}), "a < b");
  const std::string picture = read(std::filesystem::path(path).replace_extension(".svg"));
  REQUIRE(picture.starts_with("<svg "));
  REQUIRE(picture.find("<polygon") != std::string::npos);
  REQUIRE(picture.find("a &lt; b") != std::string::npos);
  const std::string obj = read(path.replace_extension(".obj"));
  REQUIRE(obj.starts_with("v "));
  REQUIRE(obj.find("\nf ") != std::string::npos);
}

TEST_CASE("the mesh of a saved case is one that an audit takes, whatever degenerates, and its vertices are the case's",
          "[property]") {
  const Scratch folder;
  for (const Stage stage : all_stages)
    for (const Generator& generator : generators(stage))
      for (std::uint64_t index = 0; index < 4 && generator.least == 0; ++index) {
        const TestCase test = generate({stage, std::string(generator.name), 5, index, "", {}});
        const std::string text = print_shape_obj(shape_of(test));
        const bool has_geometry = stage != Stage::activation && stage != Stage::bound;
        INFO(print_problem(test.name) << "\n" << text);
        if (!has_geometry) CHECK(text.empty());
        if (text.empty()) continue;
        const Mesh mesh = make_mesh(parse_obj(text, "saved.obj")).mesh;
        CHECK(describe(validate(mesh)).empty());
        const auto* whole = std::any_cast<MeshCase>(&test.data);
        if (whole && mesh.positions.size() == whole->positions.size() &&
            text.find('#') == std::string::npos)  // nothing is omitted or added
          CHECK(to_single(mesh.positions) == whole->positions);
      }
}

TEST_CASE("what an audit says of the mesh of a point and a triangle is the distance of the case", "[property]") {
  std::size_t asked = 0;
  for (const char* generator : {"uniform", "ladder.near", "ladder.corner_plane", "ladder.needle"})
    for (std::uint64_t index = 0; index < 50; ++index) {
      const TestCase test = generate({Stage::closest_face, generator, 5, index, "", {}});
      const Mesh mesh = make_mesh(parse_obj(print_shape_obj(shape_of(test)), "saved.obj")).mesh;
      if (mesh.triangles.size() != 1 || mesh.positions.size() != 5) continue;  // the case has collapsed
      ++asked;
      const auto& c = case_of<ClosestFaceCase>(test.data);
      const double exact = ogc::reference::authority().closest_face({{c.point}, {c.triangle}}).distance[0];
      const SmallestDistances found = smallest_distances(build_topology(5, mesh.triangles, mesh.loose_edges),
                                                         mesh.positions);
      INFO(print_problem(test.name));
      CHECK(found.vertex == 3);
      CHECK(found.vertex_triangle == Approx(exact).epsilon(1e-9).margin(1e-11));
    }
  CHECK(asked > 120);
}

TEST_CASE("a broken case file is refused with its name and what is wrong", "[unit]") {
  const Scratch folder;
  const auto path = folder / "case.json";
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("case.json"));
  write(path, "{");
  REQUIRE_THROWS_AS(load_case(path), InputError);
  write(path, R"({"format": 4, "problem": "stage=bound gen=few seed=1 index=1", "data": {}})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("format 4"));
  write(path, R"({"format": 3, "problem": "stage=activation gen=bits seed=1 index=1", "data": {"activation": "cubic", )"
              R"("distance": "1x", "contact_radius": "1", "stiffness": "1"}})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("1x"));
  write(path, R"({"format": 3, "problem": "stage=activation gen=bits seed=1 index=1", "data": {"activation": "ogc", )"
              R"("distance": "1", "stiffness": "1"}})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("contact_radius"));
  write(path, R"({"format": 3, "problem": "stage=activation gen=bits seed=1 index=1", "data": {"activation": "log"}})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("unknown activation 'log'"));
}

TEST_CASE("a damaged HDF5 file is refused with its name", "[unit]") {
  const Scratch folder;
  const auto path = folder / "case.h5";
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("case.h5"));
  write(path, "no HDF5");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("case.h5"));
}

TEST_CASE("a saved case that asks of what is not there, or is no legal scene, is refused", "[unit]") {
  const Scratch folder;
  const auto path = folder / "case.json";
  const auto block = [&](const std::string& question) {
    write(path, R"({"format": 3, "problem": "stage=block gen=few seed=1 index=1", "data": {"mesh": )"
                R"({"vertex_count": 2, "triangles": [], "loose_edges": [[0, 1]]},
      "positions": [["0", "0", "0"], ["1", "0", "0"]], "questions": [)" +
                    question + "]}}");
  };
  block(R"({"kind": "vertex_in_surface", "of": 0, "face": "edge", "index": 9})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("index 9"));
  block(R"({"kind": "vertex_in_surface", "of": 0, "face": "side", "index": 0})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("side"));
  write(path, R"({"format": 3, "problem": "stage=rest_state gen=soup seed=1 index=1", "data": {"rest_positions": )"
              R"([["0", "0", "0"], ["1", "0", "0"]],
    "positions": [["0", "0", "0"], ["1", "0", "0"]], "triangles": [], "loose_edges": [], "bodies": [], )"
              R"("motions": []}})");
  REQUIRE_THROWS_WITH(load_case(path), ContainsSubstring("vertex"));
}

TEST_CASE("a saved case without a list that every scene has is refused by the list's name", "[unit]") {
  const Scratch folder;
  const auto refused = [&](const char* problem, const std::string& where, const char* key) {
    nlohmann::ordered_json json = case_to_json(generate(parse_problem(problem)), "");
    nlohmann::ordered_json& scene = json.at(nlohmann::ordered_json::json_pointer(where));
    REQUIRE(scene.erase(key) == 1);
    write(folder / "case.json", json.dump());
    INFO(problem << ": " << key);
    CHECK_THROWS_WITH(load_case(folder / "case.json"), ContainsSubstring("case.json") && ContainsSubstring(key));
  };
  for (const char* key : {"triangles", "loose_edges", "springs"})
    refused("stage=step gen=few seed=1 index=1", "/data/scene", key);
  refused("stage=step gen=few seed=1 index=1", "/data/scene/bodies/0", "triangles");
  for (const char* key : {"triangles", "loose_edges"})
    refused("stage=rest_state gen=soup seed=1 index=1", "/data", key);
  refused("stage=rest_state gen=soup seed=1 index=1", "/data/bodies/0", "triangles");
}

TEST_CASE("a batch file holds one problem a line, comments and empty lines apart", "[unit]") {
  const Scratch folder;
  const auto path = folder / "corpus.txt";
  write(path, "# worst cases\n\nstage=bound gen=few seed=1 index=1\nstage=truncate gen=bits seed=2 index=9\n");
  const auto names = load_batch(path);
  REQUIRE(names.size() == 2);
  REQUIRE(names[1] == CaseName{Stage::truncate, "bits", 2, 9, "", {}});
  write(path, "stage=bound gen=few seed=1 index=1\nstage=bund\n");
  REQUIRE_THROWS_WITH(load_batch(path), ContainsSubstring("line 2") && ContainsSubstring("bund"));
  REQUIRE_THROWS_AS(load_batch(folder / "none.txt"), InputError);
}
