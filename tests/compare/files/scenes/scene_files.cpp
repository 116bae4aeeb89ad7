// Tests that a scene is read back bit for bit, that exactly the keys of the schema are read, and that bad input is
// named.
#include "compare/files/scenes/scene_files.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/scenes/keyframes.hpp"
#include "compare/files/scenes/orientations.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"
#include "tests/compare/problem/renamed.hpp"
#include "tests/compare/problem/small_scene.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using nlohmann::json;
using ogc::tests::recorded_scene;
using ogc::tests::Scratch;
using ogc::tests::small_scene;
using ogc::tests::solid_scene;

namespace {

// Returns a scene with everything that a scene file can contain, and no default values.
Scene full_scene() {
  Scene scene = small_scene();
  scene.rest_positions[1].y = 0.02;
  scene.velocities[1] = {0.1, -0.2, 0.3};
  for (std::size_t v = 4; v < 7; ++v) scene.velocities[v] = {0, -0.0, 1};
  scene.bodies[0].material.membrane = MembraneModel::none;
  scene.bodies[0].material.bending = BendingModel::none;
  scene.bodies[1].material.membrane = MembraneModel::stable_neo_hookean;
  scene.bodies[1].material.bending = BendingModel::isometric_quadratic;
  scene.bodies[0].material.lame_lambda = 1.0 / 3;
  scene.motions[0].axis = {0.1, 1.0 / 3, -2};
  scene.motions[0].start = 0.1;
  scene.motions[1].end = 2.5;
  scene.motions[1].vertices = {3, 2};
  scene.gravity = {0.1, -9.81, 1e-5};
  scene.settings.steps = 7;
  scene.settings.lanes = 16;
  set_setting(scene.settings, "tests_share", 1.0 / 3);
  set_setting(scene.settings, "tests_count", 7);
  set_setting(scene.settings, "tests_way", "second");
  scene.settings.contact_activation = ContactActivation::cubic;
  scene.settings.damping = DampingForm::per_vertex;
  scene.springs = {{1, 5, 12, 0.25, 1e-4}, {6, 0, 3, 0, 0}};
  scene.springs.push_back({0, 5, 100, 0, 0, 6, 1.0 / 3});
  scene.excluded_pairs = {{0, 5}, {0, 6}, {1, 3}, {6, 2}};
  scene.settings.seed = (std::int64_t{1} << 53) - 1;
  scene.settings.contact_radius = 1.0 / 300;
  round_to_single(scene);
  return scene;
}

// Returns a scene in which a vertex of the sheet follows a path of three positions.
Scene keyframed_scene() {
  Scene scene = full_scene();
  scene.motions.resize(1);
  scene.motions[0] = {};
  scene.motions[0].name = "path";
  scene.motions[0].vertices = {3, 1};
  scene.motions[0].keyframes = {
      {0, 1.0 / 3, 0.5},
      {{0.1f, 0, 0}, {0, 0, 0.1f}, {0.1f, 1e-3f, 0}, {0, -1e-3f, 0.1f}, {0.2f, 0, 0}, {-0.1f, 0, 1.0f / 3}}};
  return scene;
}

// Writes a scene whose JSON can be changed before it is read.
class Edited {
 public:
  explicit Edited(const Scene& scene = full_scene())
      : file_(write_scene(scratch_.folder(), scene)), content(json::parse(read_bytes(file_))) {}
  std::string error() const {
    write_bytes(file_, content.dump());
    return error_of_file();
  }
  std::string error_of_file() const {
    try {
      read_scene(file_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  const std::filesystem::path& file() const { return file_; }
  const Scratch& scratch() const { return scratch_; }

 private:
  Scratch scratch_;
  std::filesystem::path file_;

 public:
  json content;
};

using UseObject = std::function<void(const json::json_pointer&, const json&)>;

// Calls use(pointer to an object of the document, schema of that object) for every object that the schema describes.
void each_object(const json& schema, const json& document, const json::json_pointer& at, const UseObject& use) {
  if (schema.value("type", "") == "object") {
    use(at, schema);
    for (const auto& [key, inner] : schema["properties"].items()) {
      if (document.contains(at / key)) each_object(inner, document, at / key, use);
    }
  } else if (schema.value("type", "") == "array" && schema["items"].value("type", "") == "object") {
    for (std::size_t i = 0; i < document.at(at).size(); ++i) each_object(schema["items"], document, at / i, use);
  }
}

}  // namespace

TEST_CASE("a scene comes back from its files bit for bit", "[unit]") {
  const Scratch scratch;
  const Scene scene = full_scene();
  const Scene again = read_scene(write_scene(scratch / "new", scene));
  CHECK(again == scene);
  CHECK(std::signbit(again.velocities[4].y));
  CHECK(read_scene(write_scene(scratch / "again", again)) == scene);
  CHECK(read_bytes(scratch / "new/small.json") == read_bytes(scratch / "again/small.json"));
}

TEST_CASE("a volume comes back as one, and a body that says nothing about its contact is a surface", "[unit]") {
  Scene scene = solid_scene();
  scene.bodies[0].contact = BodyContact::volume;
  round_to_single(scene);
  Edited edited(scene);
  CHECK(read_scene(edited.file()) == scene);
  edited.content["bodies"][0].erase("body_contact");
  CHECK(edited.error() == "");
  CHECK(read_scene(edited.file()).bodies[0].contact == BodyContact::surface);
  edited.content["bodies"][0]["body_contact"] = true;
  CHECK_THAT(edited.error(), ContainsSubstring("/bodies/0/body_contact"));
}

TEST_CASE("a setting under the name that it had before is refused with the one that it has now", "[unit]") {
  for (const ogc::tests::Renamed& setting : ogc::tests::renamed_settings) {
    Edited edited(solid_scene());
    const bool is_of_bodies = setting.now == "body_contact";
    const std::string key(setting.before);
    (is_of_bodies ? edited.content["bodies"][0] : edited.content["settings"])[key] = 1;
    CHECK_THAT(edited.error(),
               ContainsSubstring((is_of_bodies ? "/bodies/0/" : "/settings/") + key + ": " + setting.refusal()));
  }
}

TEST_CASE("rods come back from their files bit for bit, and bad ones are named with their path", "[unit]") {
  Scene scene = recorded_scene();
  scene.orientations = {{0, 0, 0, 1}, {0.6f, 0, 0.8f, 0}};
  Edited edited(scene);
  CHECK(read_scene(edited.file()) == scene);
  const auto yarn = [&]() -> json& { return edited.content["bodies"][2]; };
  const json good = edited.content;
  yarn()["material"]["rod"]["stretch"] = 0;
  CHECK_THAT(edited.error(), ContainsSubstring("/bodies/2/material/rod/stretch: is 0; give a number from"));
  edited.content = good;
  yarn()["material"]["rod"]["stiffness"] = 1;
  CHECK_THAT(edited.error(), ContainsSubstring("/bodies/2/material/rod") && ContainsSubstring("stiffness"));
  edited.content = good;
  yarn()["material"].erase("rod");
  CHECK_THAT(edited.error(), ContainsSubstring("of body 'yarn'") && ContainsSubstring("it has no mass"));
  edited.content = good;
  yarn()["orientations"] = "gone.h5";
  CHECK_THAT(edited.error(), ContainsSubstring("/bodies/2/orientations: ") && ContainsSubstring("gone.h5"));
  edited.content = good;
  const std::filesystem::path file = edited.file().parent_path() / yarn()["orientations"].get<std::string>();
  write_orientations(file, std::vector<Quaternion>{{0, 0, 0, 1}});
  CHECK_THAT(edited.error(), ContainsSubstring("1 entries for 2 segments"));
  write_orientations(file, std::vector<Quaternion>{{0, 0, 0, 1}, {0, 0, 0, 2}});
  CHECK_THAT(edited.error(), ContainsSubstring("orientation 1 is no unit quaternion"));
  yarn().erase("orientations");
  CHECK(edited.error() == "");
  CHECK(read_scene(edited.file()).orientations.empty());
}

TEST_CASE("keyframes come back from their file bit for bit", "[unit]") {
  const Scratch scratch;
  const Scene scene = keyframed_scene();
  CHECK(read_scene(write_scene(scratch / "new", scene)) == scene);
}

TEST_CASE("bad keyframes are named with their file, their path and a remedy", "[unit]") {
  Edited edited(keyframed_scene());
  const std::filesystem::path frames = edited.file().parent_path() / "small_path.h5";
  REQUIRE(std::filesystem::exists(frames));
  const auto with = [&](const Keyframes& keyframes) {
    write_keyframes(frames, keyframes);
    return edited.error();
  };
  const Keyframes good = keyframed_scene().motions[0].keyframes;
  SECTION("no file") {
    edited.content["motions"][0]["keyframes"] = "gone.h5";
    CHECK_THAT(edited.error(), ContainsSubstring("small.json: /motions/0/keyframes: ") && ContainsSubstring("gone.h5"));
  }
  SECTION("no HDF5 file") {
    write_bytes(frames, "time,x,y,z");
    CHECK_THAT(edited.error(), ContainsSubstring("/motions/0/keyframes: ") && ContainsSubstring("small_path.h5"));
  }
  SECTION("no number for a name") {
    edited.content["motions"][0]["keyframes"] = 3;
    CHECK_THAT(edited.error(), ContainsSubstring("/motions/0/keyframes: is 3"));
  }
  SECTION("times that do not rise") {
    CHECK_THAT(with({{0, 0.5, 0.5}, good.positions}),
               ContainsSubstring("motion 'path': has keyframes whose times do not rise"));
  }
  SECTION("one frame") {
    CHECK_THAT(with({{0}, {good.positions.begin(), good.positions.begin() + 2}}),
               ContainsSubstring("motion 'path': has 1 keyframes; give at least two"));
  }
  SECTION("positions of other vertices") {
    edited.content["motions"][0]["vertices"][0]["indices"] = {3};
    CHECK_THAT(edited.error(), ContainsSubstring("motion 'path': has 6 positions in 3 keyframes of 1 vertices"));
  }
  SECTION("a position that is none") {
    Keyframes bad = good;
    bad.positions[3].z = std::numeric_limits<float>::quiet_NaN();
    CHECK_THAT(with(bad), ContainsSubstring("motion 'path', keyframe 1, vertex 1 of body 'sheet' (") &&
                              ContainsSubstring("): position is not finite"));
  }
  SECTION("velocities besides") {
    edited.content["motions"][0]["velocity"] = {0, 1, 0};
    CHECK_THAT(edited.error(), ContainsSubstring("motion 'path': has keyframes and velocities"));
  }
}

TEST_CASE("bad stitches and excluded pairs are named with their path and a remedy", "[unit]") {
  Edited edited;
  json& content = edited.content;
  SECTION("a ratio beyond the edge") {
    content["springs"][2]["ratio"] = 1.5;
    CHECK_THAT(edited.error(),
               ContainsSubstring("spring 2: has no such point on the line of its second and third vertex: third "
                                 "vertex 2 of body 'floor' (") &&
                   ContainsSubstring("6 in the scene), ratio 1.5"));
  }
  SECTION("a ratio without a third vertex") {
    content["springs"][2].erase("third");
    CHECK_THAT(edited.error(), ContainsSubstring("spring 2") && ContainsSubstring("no third vertex"));
  }
  SECTION("an edge that is none") {
    content["springs"][2]["third"] = content["springs"][2]["second"];
    CHECK_THAT(edited.error(), ContainsSubstring("spring 2") && ContainsSubstring("third vertex 1 of body 'floor'"));
  }
  SECTION("a pair of unknown bodies") {
    content["excluded_pairs"][0]["bodies"][1] = "flor";
    CHECK_THAT(edited.error(),
               ContainsSubstring("/excluded_pairs/0/bodies/1: unknown body 'flor'; did you mean 'floor'?"));
  }
  SECTION("a pair of three") {
    content["excluded_pairs"][0]["vertices"][0] = {0, 1, 2};
    CHECK_THAT(edited.error(), ContainsSubstring("/excluded_pairs/0/vertices/0"));
  }
  SECTION("a vertex beyond its body") {
    content["excluded_pairs"][0]["vertices"][1][1] = 3;
    CHECK_THAT(edited.error(),
               ContainsSubstring("/excluded_pairs/0/vertices/1/1: is 3; body 'floor' has vertices 0 to 2"));
  }
  SECTION("a vertex beside itself") {
    content["excluded_pairs"][1]["vertices"][0] = {1, 1};
    CHECK_THAT(edited.error(),
               ContainsSubstring("excluded pair 2: does not name two vertices: vertex 1 of body 'sheet' ("));
  }
}

TEST_CASE("reading rounds to single precision", "[unit]") {
  const Scratch scratch;
  Scene scene = small_scene();
  scene.settings.time_step = 1.0 / 300;
  const Scene again = read_scene(write_scene(scratch.folder(), scene));
  CHECK_FALSE(again == scene);
  round_to_single(scene);
  CHECK(again == scene);
}

TEST_CASE("loose edges belong to the body of their vertices", "[unit]") {
  const Scratch scratch;
  Scene scene;
  scene.name = "yarns";
  const Mesh yarn{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, {{0, 1}, {1, 2}}};
  Material material;
  material.rod.emplace();
  append_body(scene, {.name = "one", .material = material}, yarn);
  append_body(scene, {.name = "two", .material = material}, yarn);
  round_to_single(scene);
  CHECK(read_scene(write_scene(scratch.folder(), scene)) == scene);
}

TEST_CASE("a scene file needs no more than a name and a body with a mesh", "[unit]") {
  const Scratch scratch;
  write_mesh(scratch / "cloth.obj", {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}, {}});
  write_bytes(scratch / "scene.json",
              R"({"format_version": 1, "name": "mine", "bodies": [{"name": "cloth", "mesh": "cloth.obj"}]})");
  const Scene scene = read_scene(scratch / "scene.json");
  Scene defaults;
  round_to_single(defaults);
  CHECK(scene.settings == defaults.settings);
  CHECK(scene.gravity == defaults.gravity);
  CHECK(scene.rest_positions == scene.mesh.positions);
  CHECK(scene.velocities == std::vector<Vec3>(3));
  CHECK_FALSE(scene.bodies[0].fixed);
}

TEST_CASE("a scene and a body without a name are called as their files are, with letters that names may have",
          "[unit]") {
  const Scratch scratch;
  write_mesh(scratch / "my cloth.obj", {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}}, {}});
  write_bytes(scratch / "first try.json", R"({"format_version": 1, "bodies": [{"mesh": "my cloth.obj"}]})");
  const Scene scene = read_scene(scratch / "first try.json");
  CHECK(scene.name == "first_try");
  CHECK(scene.bodies.at(0).name == "my_cloth");
  write_bytes(scratch / "empty.json", R"({"format_version": 1, "bodies": [{"mesh": "my cloth.obj", "name": ""}]})");
  CHECK_THROWS_WITH(read_scene(scratch / "empty.json"),
                    ContainsSubstring("body ''") && ContainsSubstring("can't be used"));
}

TEST_CASE(
    "no number of a scene file may vanish in single precision or be beyond its range; the message names it, and is "
    "short",
    "[property]") {
  Edited edited;
  const json good = edited.content;
  const auto check_refused = [&](const std::string& path, const json& value) {
    edited.content = good;
    edited.content[json::json_pointer(path)] = value;
    const std::string error = edited.error();
    INFO(path << " " << value << ": " << error);
    CHECK_THAT(error, ContainsSubstring(path.substr(path.rfind('/') + 1)));
    CHECK(error.size() < 500);
  };
  for (const SettingInfo& info : setting_table()) {
    const std::string path = "/settings/" + std::string(info.name);
    for (const json& value : {json(-1), json(1e300), json(1e38), json("nan"), json(nullptr)})
      check_refused(path, value);
    if (kind_of(info) == SettingKind::real) check_refused(path, 1e-46);
  }
  for (const MaterialInfo& info : material_table())
    for (const double value : {-1.0, 1e300, 1e20, 1e-46})
      check_refused("/bodies/0/material/" + std::string(info.name), value);
  for (const char* number : {"angular_velocity", "start"}) check_refused("/motions/0/" + std::string(number), "inf");
  edited.content = good;
  edited.content["motions"][0]["angular_velocity"] = 1e20;
  CHECK_THAT(edited.error(), ContainsSubstring("motion '") && ContainsSubstring("angular velocity above 2²⁰"));
}

TEST_CASE("motions select all vertices of a body, those in a closed box, or those listed", "[unit]") {
  Edited edited;
  json& parts = edited.content["motions"][0]["vertices"];
  edited.content["motions"].erase(1);
  const auto selected = [&] {
    const std::string error = edited.error();
    INFO(error);
    REQUIRE(error.empty());
    return read_scene(edited.file()).motions[0].vertices;
  };
  parts = {{{"body", "sheet"}}};
  CHECK(selected() == std::vector<Index>{0, 1, 2, 3});
  parts = {{{"body", "sheet"}, {"indices", {3, 1}}}};
  CHECK(selected() == std::vector<Index>{3, 1});
  // The corner (0.1, 0, 0.1) is stored in single precision, a little above 0.1.
  const double corner = static_cast<double>(0.1f);
  parts = {{{"body", "sheet"}, {"box", {{"minimum", {corner, 0, -1}}, {"maximum", {corner, 0, corner}}}}}};
  CHECK(selected() == std::vector<Index>{2, 3});
  parts = {{{"body", "sheet"}, {"indices", {3}}},
           {{"body", "sheet"}, {"box", {{"minimum", {-1, -1, -1}}, {"maximum", {0, 0, 0}}}}}};
  CHECK(selected() == std::vector<Index>{3, 0});
}

TEST_CASE("the reader reads every key of the schema and no other", "[unit]") {
  const json schema = json::parse(scene_schema());
  Edited edited;
  edited.content["bodies"][0]["velocity"] = {0, 0, 0};
  edited.content["bodies"][1]["rest_mesh"] = edited.content["bodies"][1]["mesh"];
  edited.content["motions"][0]["vertices"][0]["box"] = {{"minimum", {-1, -1, -1}}, {"maximum", {1, 1, 1}}};
  const json complete = edited.content;
  std::size_t keys = 0;
  each_object(schema, complete, json::json_pointer(), [&](const json::json_pointer& at, const json& object) {
    for (const auto& [key, inner] : object["properties"].items()) {
      INFO((at / key).to_string());
      edited.content = complete;
      edited.content[at / key] = json::array({json::object()});
      CHECK_THAT(edited.error(), ContainsSubstring((at / key).to_string()));
      ++keys;
    }
    edited.content = complete;
    edited.content[at / "surprise"] = 1;
    CHECK_THAT(edited.error(), ContainsSubstring((at / "surprise").to_string() + ": unknown key 'surprise'"));
    for (const json& key : object.value("required", json::array())) {
      INFO((at / key.get<std::string>()).to_string());
      edited.content = complete;
      edited.content[at].erase(key.get<std::string>());
      CHECK_THAT(edited.error(), ContainsSubstring("has no '" + key.get<std::string>() + "'"));
    }
  });
  CHECK(keys > 70);  // the walk has reached settings, two materials and both selections
}

TEST_CASE("the schema describes every key that the writer writes, with the defaults of the structs", "[unit]") {
  const json schema = json::parse(scene_schema());
  const Edited edited;
  each_object(schema, edited.content, json::json_pointer(), [&](const json::json_pointer& at, const json& object) {
    for (const auto& [key, value] : edited.content[at].items()) {
      INFO((at / key).to_string());
      CHECK(object["properties"].contains(key));
    }
    CHECK(object["additionalProperties"] == false);
  });
  const json& settings = schema["properties"]["settings"]["properties"];
  for (const SettingInfo& info : setting_table()) {
    INFO(info.name);
    const json& standard = settings[std::string(info.name)]["default"];
    if (info.choices.empty())
      CHECK(standard == get_setting(Settings{}, info));
    else
      CHECK(standard == setting_text(Settings{}, info));
  }
}

TEST_CASE("a newer format is refused by name, before anything else is said about the file", "[unit]") {
  Edited edited;
  edited.content["format_version"] = 3;
  edited.content["novelty"] = true;
  CHECK_THAT(edited.error(),
             ContainsSubstring("small.json: /format_version: scene format 3 is newer than 2, the newest that "
                               "this ogc reads; use a newer ogc"));
  CHECK_THAT(edited.error(), !ContainsSubstring("novelty"));
  edited.content["format_version"] = 0;
  CHECK_THAT(edited.error(), ContainsSubstring("there is no scene format 0"));
  edited.content["format_version"] = "1";
  CHECK_THAT(edited.error(), ContainsSubstring("/format_version: is \"1\"; give a whole number"));
}

TEST_CASE("each bad value is named with its file, its path and a remedy", "[unit]") {
  Edited edited;
  json& content = edited.content;
  SECTION("unknown key") {
    content["bodies"][0]["material"]["densty"] = 1;
    CHECK_THAT(
        edited.error(),
        ContainsSubstring("small.json: /bodies/0/material/densty: unknown key 'densty'; did you mean 'density'?"));
  }
  SECTION("wrong type: text for number") {
    content["bodies"][0]["material"]["density"] = "heavy";
    CHECK_THAT(edited.error(),
               ContainsSubstring("small.json: /bodies/0/material/density: is \"heavy\"; give a number"));
  }
  SECTION("wrong type: fraction for count") {
    content["settings"]["iterations"] = 1.5;
    CHECK_THAT(edited.error(), ContainsSubstring("/settings/iterations: is 1.5; give a whole number"));
  }
  SECTION("wrong type: object for array") {
    content["bodies"] = json::object();
    CHECK_THAT(edited.error(), ContainsSubstring("/bodies: is {}; give an array"));
  }
  SECTION("wrong type: two numbers for a vector") {
    content["gravity"] = {0, 1};
    CHECK_THAT(edited.error(), ContainsSubstring("/gravity: is [0,1]; give three numbers"));
  }
  SECTION("null") {
    content["bodies"][1]["fixed"] = nullptr;
    CHECK_THAT(edited.error(), ContainsSubstring("/bodies/1/fixed: is null; give true or false"));
  }
  SECTION("material out of range") {
    content["bodies"][1]["material"]["friction"] = -0.5;
    CHECK_THAT(edited.error(), ContainsSubstring("/bodies/1/material/friction: is -0.5; give a number from 0"));
  }
  SECTION("setting out of range") {
    content["settings"]["contact_radius"] = 0;
    CHECK_THAT(edited.error(),
               ContainsSubstring("/settings/contact_radius: is 0; give a number from") && ContainsSubstring(" m "));
  }
  SECTION("setting too large for any integer") {
    content["settings"]["steps"] = std::numeric_limits<std::uint64_t>::max();
    CHECK_THAT(edited.error(), ContainsSubstring("/settings/steps: is 18446744073709551615; give a whole number"));
  }
  SECTION("unknown model") {
    content["bodies"][0]["material"]["membrane"] = "st_venant";
    CHECK_THAT(edited.error(),
               ContainsSubstring(
                   "/bodies/0/material/membrane: unknown model 'st_venant'; did you mean 'st_venant_kirchhoff'?"));
  }
  SECTION("missing mesh") {
    content["bodies"][0]["mesh"] = "gone.ply";
    CHECK_THAT(edited.error(),
               ContainsSubstring("small.json: /bodies/0/mesh: ") && ContainsSubstring("gone.ply: no such file"));
  }
  SECTION("rest mesh with other faces") {
    content["bodies"][0]["rest_mesh"] = content["bodies"][1]["mesh"];
    CHECK_THAT(edited.error(),
               ContainsSubstring("/bodies/0/rest_mesh: has other vertices, faces, edges or tetrahedra"));
  }
  SECTION("two kinds of velocity") {
    content["bodies"][0]["velocity"] = {0, 0, 0};
    CHECK_THAT(edited.error(), ContainsSubstring("/bodies/0/velocities: stands beside 'velocity'"));
  }
  SECTION("unknown body") {
    content["motions"][0]["vertices"][0]["body"] = "shet";
    CHECK_THAT(edited.error(),
               ContainsSubstring("/motions/0/vertices/0/body: unknown body 'shet'; did you mean 'sheet'?"));
  }
  SECTION("index out of range") {
    content["motions"][0]["vertices"][0]["indices"] = {0, 4};
    CHECK_THAT(edited.error(),
               ContainsSubstring("/motions/0/vertices/0/indices/1: is 4; body 'sheet' has vertices 0 to 3"));
  }
  SECTION("negative index") {
    content["motions"][0]["vertices"][0]["indices"] = {-1};
    CHECK_THAT(edited.error(), ContainsSubstring("/motions/0/vertices/0/indices/0: is -1; give an index"));
  }
  SECTION("empty box") {
    content["motions"][0]["vertices"][0] = {{"body", "sheet"},
                                            {"box", {{"minimum", {5, 5, 5}}, {"maximum", {6, 6, 6}}}}};
    CHECK_THAT(edited.error(), ContainsSubstring("/motions/0/vertices/0/box: holds no vertex of body 'sheet'"));
  }
  SECTION("fixed vertex moved") {
    content["motions"][0]["vertices"][0] = {{"body", "floor"}};
    CHECK_THAT(edited.error(), ContainsSubstring("small.json: motion 'left', vertex 0 of body 'floor' (") &&
                                   ContainsSubstring("4 in the scene): moves a vertex of a fixed body"));
  }
  SECTION("several problems at once") {
    content["settings"]["lanes"] = 3;
    content["nmae"] = "x";
    content["bodies"][0]["mesh"] = "gone.ply";
    CHECK_THAT(edited.error(), ContainsSubstring("/settings/lanes: is 3") && ContainsSubstring("/nmae: unknown key") &&
                                   ContainsSubstring("gone.ply"));
  }
}

TEST_CASE("what is wrong with a mesh is said of the body that names it", "[unit]") {
  Edited edited(small_scene());
  const auto write = [&](const Mesh& mesh) { write_mesh(edited.scratch() / "small_sheet.ply", mesh); };
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  // Returns the notes about a scene that is accepted, without the folder.
  const auto notes = [&] {
    CHECK(edited.error() == "");
    std::string text;
    for (const std::string& note : load_scene_file(edited.file()).notes) text += note.substr(note.rfind('/') + 1);
    return text;
  };
  SECTION("duplicate face") {
    write({corners, {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}}, {}});
    CHECK(notes() == "small_sheet.ply: 1 face was left out: 1 has the same vertices as another; the first: face 2");
  }
  SECTION("degenerate triangle") {
    write({{{0, 0, 0}, {1, 0, 1}, {2, 0, 2}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}, {}});
    CHECK_THAT(notes(), ContainsSubstring("small_sheet.ply: 1 face was left out: 1 has no area; the first: face 0"));
  }
  SECTION("degenerate edge") {
    write({{{0, 0, 0}, {1, 0, 1}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 3}, {0, 2, 3}}, {{1, 2}}});
    CHECK_THAT(edited.error(), ContainsSubstring("loose edge 0 (vertices 1, 2): edge of zero length: vertices 1, 2"));
  }
  SECTION("an unused vertex is left out, and nothing may name it") {
    write({{{5, 5, 5}, corners[1], corners[2], corners[3]}, {{1, 2, 3}}, {}});
    CHECK_THAT(edited.error(), ContainsSubstring("/motions/0/vertices/0/indices/0: is 0, which no face or edge of ") &&
                                   ContainsSubstring("small_sheet.ply uses"));
    edited.content["motions"] = json::array();
    CHECK(edited.error() == "");
    const SceneFile loaded = load_scene_file(edited.file());
    CHECK(loaded.scene.bodies[0].vertex_count == 3);
    REQUIRE(loaded.notes.size() == 1);
    CHECK_THAT(
        loaded.notes[0],
        ContainsSubstring(
            "small_sheet.ply: 1 vertex position that no face and no edge uses was left out, the first: vertex 0"));
  }
  SECTION("not a number") {
    write({{{0, 0, std::numeric_limits<double>::quiet_NaN()}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},
           {{0, 1, 2}, {0, 2, 3}},
           {}});
    CHECK_THAT(edited.error(),
               ContainsSubstring("/bodies/0/mesh: ") && ContainsSubstring("vertex 0: a coordinate is not finite"));
  }
  SECTION("index out of range") {
    write({corners, {{0, 1, 2}, {0, 2, 9}}, {}});
    CHECK_THAT(edited.error(), ContainsSubstring("face 1: vertex 9 does not exist"));
  }
  SECTION("zero length only after rounding to single precision") {
    write({{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {1, 0, 1 + 0x1p-19}}, {{0, 1, 2}, {0, 2, 3}}, {}});
    CHECK(edited.error().empty());
    write({{{512, 0, 0}, {513, 0, 0}, {513, 0, 1024}, {513, 0, 1024 + 0x1p-19}}, {{0, 1, 2}, {0, 2, 3}}, {}});
    CHECK_THAT(notes(), ContainsSubstring("small_sheet.ply: 1 face was left out: 1 has no area; the first: face 1"));
  }
}

TEST_CASE("text that is no JSON is refused with its place", "[unit]") {
  const Edited edited;
  const auto error = [&](const std::string& text) {
    write_bytes(edited.file(), text);
    return edited.error_of_file();
  };
  CHECK_THAT(error(""), ContainsSubstring("small.json: no valid JSON"));
  CHECK_THAT(error("{\n\"name\": }"), ContainsSubstring("line 2"));
  CHECK_THAT(error("{\"gravity\": [0, NaN, 0]}"), ContainsSubstring("no valid JSON"));
  CHECK_THAT(error("{\"gravity\": [0, 1e999, 0]}"), ContainsSubstring("no valid JSON") && ContainsSubstring("1e999"));
  CHECK_THAT(error("{\"name\": \"a\", \"name\": \"b\"}"), ContainsSubstring("the key 'name' stands twice"));
  CHECK_THAT(error("[]"), ContainsSubstring("small.json: /: is []; give an object"));
  CHECK_THAT(error("{} trailing"), ContainsSubstring("no valid JSON"));
  const std::string whole = edited.content.dump();
  for (std::size_t size = 0; size < whole.size(); size += 7)
    CHECK_THAT(error(whole.substr(0, size)), ContainsSubstring("no valid JSON"));
}

TEST_CASE("a missing scene file is named, and a scene that could not be read back is not written", "[unit]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(read_scene(scratch / "none.json"), ContainsSubstring("none.json: no such file"));
  Scene scene = small_scene();
  scene.name = "../elsewhere";
  CHECK_THROWS_AS(write_scene(scratch.folder(), scene), InputError);
  CHECK(std::filesystem::is_empty(scratch.folder()));
}
