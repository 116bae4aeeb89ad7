#include "compare/judge/corpus_rest.hpp"

#include <algorithm>
#include <array>

#include "compare/judge/rest_cases.hpp"
#include "compare/judge/topology_json.hpp"
#include "compare/problem/material_table.hpp"

namespace ogc::compare {

namespace {

constexpr std::array<std::string_view, 2> question_kinds{"vertex_in_surface", "edge_in_edges"};
constexpr std::array<std::string_view, 3> face_kinds{"vertex", "edge", "triangle"};

/// The place of a name in a list of all names.
template <class Names>
int number_of(const Json& name, const Names& names) {
  const auto found = std::find(names.begin(), names.end(), name.get<std::string>());
  if (found == names.end())
    throw InputError("'" + name.get<std::string>() + "' is none of the names that may stand there");
  return static_cast<int>(found - names.begin());
}

Json question_to_json(const BlockQuestion& question) {
  return {{"kind", question_kinds[static_cast<std::size_t>(question.kind)]},
          {"of", question.of},
          {"face", face_kinds[static_cast<std::size_t>(question.face.kind)]},
          {"index", question.face.index}};
}

BlockQuestion to_question(const Json& json) {
  return {static_cast<BlockQuestion::Kind>(number_of(json.at("kind"), question_kinds)),
          json.at("of").get<Index>(),
          {static_cast<FaceKind>(number_of(json.at("face"), face_kinds)), json.at("index").get<Index>()}};
}

void check_question(const BlockQuestion& question, const Topology& topology) {
  const auto names = [](Index i, std::size_t count) { return i >= 0 && static_cast<std::size_t>(i) < count; };
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  const bool is_edge = question.kind == BlockQuestion::Kind::edge_in_edges;
  const std::array<std::size_t, 3> counts{vertices, topology.edges.size(), topology.triangles.size()};
  if (!names(question.of, is_edge ? topology.edges.size() : vertices) ||
      !names(question.face.index, counts[static_cast<std::size_t>(question.face.kind)]) ||
      (is_edge && question.face.kind == FaceKind::triangle))
    throw InputError("a question names a face that does not exist: of " + std::to_string(question.of) + ", index " +
                     std::to_string(question.face.index));
}

Json wide_points_to_json(const std::vector<Vec3>& points) { return points_to_json(to_single(points)); }

std::vector<Vec3> to_wide_points(const Json& json) {
  std::vector<Vec3f> points;
  for (const Json& p : json) points.push_back(to_point(p));
  return to_double(points);
}

Json body_to_json(const Body& body) {
  Json json{{"name", body.name},
            {"vertices", body.vertex_count},
            {"triangles", body.triangle_count},
            {"fixed", body.fixed},
            {"membrane", name_of(body.material.membrane)},
            {"bending", name_of(body.material.bending)}};
  for (const MaterialInfo& info : material_table())
    json[std::string(info.name)] = hexadecimal(static_cast<float>(body.material.*info.field));
  return json;
}

/// The next body after those that the scene has.
Body to_body(const Json& json, const Scene& scene) {
  Body body;
  body.name = json.at("name").get<std::string>();
  if (!scene.bodies.empty()) {
    body.first_vertex = scene.bodies.back().first_vertex + scene.bodies.back().vertex_count;
    body.first_triangle = scene.bodies.back().first_triangle + scene.bodies.back().triangle_count;
  }
  body.vertex_count = json.at("vertices").get<Index>();
  body.triangle_count = json.at("triangles").get<Index>();
  body.fixed = json.at("fixed").get<bool>();
  body.material.membrane = static_cast<MembraneModel>(number_of(json.at("membrane"), membrane_model_names()));
  body.material.bending = static_cast<BendingModel>(number_of(json.at("bending"), bending_model_names()));
  for (const MaterialInfo& info : material_table()) body.material.*info.field = number(json.at(std::string(info.name)));
  return body;
}

}  // namespace

Json case_to_json(const BlockCase& c) {
  Json questions = Json::array();
  for (const BlockQuestion& question : c.questions) questions.push_back(question_to_json(question));
  return {
      {"mesh", topology_to_json(*c.topology)}, {"positions", points_to_json(c.positions)}, {"questions", questions}};
}

BlockCase to_block_case(const Json& data) {
  BlockCase c{to_topology(data.at("mesh")), {}, {}};
  for (const Json& p : data.at("positions")) c.positions.push_back(to_point(p));
  if (c.positions.size() != static_cast<std::size_t>(c.topology->vertex_count))
    throw InputError("positions need one entry a vertex");
  for (const Json& question : data.at("questions")) {
    c.questions.push_back(to_question(question));
    check_question(c.questions.back(), *c.topology);
  }
  return c;
}

Json case_to_json(const RestStateCase& c) {
  const Scene& scene = *c.scene;
  Json bodies = Json::array(), held = Json::array();
  for (const Body& body : scene.bodies) bodies.push_back(body_to_json(body));
  for (const PrescribedMotion& motion : scene.motions)
    held.push_back({{"name", motion.name}, {"vertices", motion.vertices}});
  return {{"rest_positions", wide_points_to_json(scene.rest_positions)},
          {"positions", wide_points_to_json(scene.mesh.positions)},
          {"triangles", scene.mesh.triangles},
          {"loose_edges", scene.mesh.loose_edges},
          {"bodies", bodies},
          {"motions", held}};
}

RestStateCase to_rest_state_case(const Json& data) {
  Scene scene;
  scene.name = "rest";
  scene.rest_positions = to_wide_points(data.at("rest_positions"));
  scene.mesh.positions = to_wide_points(data.at("positions"));
  scene.mesh.triangles = data.at("triangles").get<std::vector<Triangle>>();
  scene.mesh.loose_edges = data.at("loose_edges").get<std::vector<Edge>>();
  scene.velocities.resize(scene.mesh.positions.size());
  for (const Json& body : data.at("bodies")) scene.bodies.push_back(to_body(body, scene));
  for (const Json& json : data.at("motions")) {
    PrescribedMotion motion;
    motion.name = json.at("name").get<std::string>();
    motion.vertices = json.at("vertices").get<std::vector<Index>>();
    scene.motions.push_back(std::move(motion));
  }
  round_to_single(scene);
  RestStateCase c;
  c.topology = std::make_shared<Topology>(build_topology(scene));
  c.scene = std::make_shared<Scene>(std::move(scene));
  if (const std::string problems = problems_of(c); !problems.empty()) throw InputError(problems);
  return c;
}

Json case_to_json(const InitialGuessCase& c) {
  return {{"start", to_json(c.start)},
          {"velocity", to_json(c.velocity)},
          {"acceleration", to_json(c.acceleration)},
          {"time_step", hexadecimal(c.time_step)},
          {"previous", to_json(c.previous)},
          {"bound", hexadecimal(c.bound)},
          {"held", c.held != 0}};
}

InitialGuessCase to_initial_guess_case(const Json& data) {
  return {to_point(data.at("start")),   to_point(data.at("velocity")), to_point(data.at("acceleration")),
          number(data.at("time_step")), to_point(data.at("previous")), number(data.at("bound")),
          data.at("held").get<bool>()};
}

}  // namespace ogc::compare
