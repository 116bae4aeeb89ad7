// Writes doubles as JSON numbers, whose shortest text comes back to the same bits. Settings stand as typed, which
// rounding to single precision makes exact.
#include "compare/judge/engine/scene_json.hpp"

#include <algorithm>

#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/settings.hpp"
#include "compare/problem/validate.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

namespace {

Json to_json(const Vec3& p) { return {p.x, p.y, p.z}; }
Vec3 to_vector(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json vectors_to_json(const std::vector<Vec3>& vectors) {
  Json json = Json::array();
  for (const Vec3& v : vectors) json.push_back(to_json(v));
  return json;
}

std::vector<Vec3> to_vectors(const Json& json) {
  std::vector<Vec3> vectors;
  for (const Json& v : json) vectors.push_back(to_vector(v));
  return vectors;
}

/// Returns the model of this name.
template <class Model>
Model to_model(const Json& json, std::span<const std::string_view> names) {
  const auto found = std::find(names.begin(), names.end(), json.get<std::string>());
  if (found == names.end()) throw InputError("there is no model '" + json.get<std::string>() + "'");
  return static_cast<Model>(found - names.begin());
}

Json body_to_json(const Body& body) {
  Json material{{"membrane", name_of(body.material.membrane)}, {"bending", name_of(body.material.bending)}};
  for (const MaterialInfo& info : material_table()) material[std::string(info.name)] = body.material.*info.field;
  if (body.material.rod)
    for (const RodInfo& info : rod_table()) material["rod"][std::string(info.name)] = (*body.material.rod).*info.field;
  return {{"name", body.name},
          {"vertices", {body.first_vertex, body.vertex_count}},
          {"triangles", {body.first_triangle, body.triangle_count}},
          {"tetrahedra", {body.first_tetrahedron, body.tetrahedron_count}},
          {"fixed", body.fixed},
          {"body_contact", name_of(body.contact)},
          {"material", material}};
}

Body to_body(const Json& json) {
  Body body;
  body.name = json.at("name").get<std::string>();
  body.first_vertex = json.at("vertices").at(0).get<Index>();
  body.vertex_count = json.at("vertices").at(1).get<Index>();
  body.first_triangle = json.at("triangles").at(0).get<Index>();
  body.triangle_count = json.at("triangles").at(1).get<Index>();
  body.fixed = json.at("fixed").get<bool>();
  if (json.contains("body_contact"))
    body.contact = to_model<BodyContact>(json.at("body_contact"), choice_names<BodyContact>);
  const Json& material = json.at("material");
  body.material.membrane = to_model<MembraneModel>(material.at("membrane"), choice_names<MembraneModel>);
  body.material.bending = to_model<BendingModel>(material.at("bending"), choice_names<BendingModel>);
  if (json.contains("tetrahedra")) {
    body.first_tetrahedron = json.at("tetrahedra").at(0).get<Index>();
    body.tetrahedron_count = json.at("tetrahedra").at(1).get<Index>();
  }
  // A saved case may be older than a constant of the table; that constant keeps its default.
  for (const MaterialInfo& info : material_table())
    body.material.*info.field = material.value(std::string(info.name), body.material.*info.field);
  if (!material.contains("rod")) return body;
  body.material.rod.emplace();
  for (const RodInfo& info : rod_table())
    (*body.material.rod).*info.field = material.at("rod").at(std::string(info.name)).get<double>();
  return body;
}

Json motion_to_json(const PrescribedMotion& motion) {
  Json json{{"name", motion.name},
            {"vertices", motion.vertices},
            {"centre", to_json(motion.centre)},
            {"axis", to_json(motion.axis)},
            {"angular_velocity", motion.angular_velocity},
            {"velocity", to_json(motion.velocity)},
            {"start", motion.start},
            {"end", motion.end}};
  if (!motion.keyframes.empty())
    json["keyframes"] = {{"times", motion.keyframes.times}, {"positions", points_to_json(motion.keyframes.positions)}};
  return json;
}

PrescribedMotion to_motion(const Json& json) {
  PrescribedMotion motion{json.at("name").get<std::string>(),
                          json.at("vertices").get<std::vector<Index>>(),
                          to_vector(json.at("centre")),
                          to_vector(json.at("axis")),
                          json.at("angular_velocity").get<double>(),
                          to_vector(json.at("velocity")),
                          json.at("start").get<double>(),
                          json.at("end").get<double>(),
                          {}};
  if (!json.contains("keyframes")) return motion;
  motion.keyframes.times = json.at("keyframes").at("times").get<std::vector<double>>();
  for (const Json& p : json.at("keyframes").at("positions")) motion.keyframes.positions.push_back(to_point(p));
  return motion;
}

Json spring_to_json(const Spring& s) {
  Json json{s.first, s.second, s.stiffness, s.rest_length, s.damping};
  if (s.third >= 0) json.push_back(s.third), json.push_back(s.ratio);
  return json;
}

Spring to_spring(const Json& json) {
  Spring spring{json.at(0).get<Index>(), json.at(1).get<Index>(), json.at(2).get<double>(), json.at(3).get<double>(),
                json.at(4).get<double>()};
  if (json.size() > 5) spring.third = json.at(5).get<Index>(), spring.ratio = json.at(6).get<double>();
  return spring;
}

std::vector<Vec3f> to_vertices(const Json& json, std::size_t count) {
  std::vector<Vec3f> points;
  for (const Json& p : json) points.push_back(to_point(p));
  if (points.size() != count) throw InputError("old, start, target and previous need one entry a vertex");
  return points;
}

Json orientations_to_json(const std::vector<Quaternion>& orientations) {
  Json json = Json::array();
  for (const Quaternion& q : orientations) json.push_back(numbers_to_json({q.begin(), q.end()}));
  return json;
}

std::vector<Quaternion> to_orientations(const Json& json) {
  std::vector<Quaternion> all;
  for (const Json& q : json) {
    const std::vector<float> numbers = to_numbers(q);
    if (numbers.size() != 4) throw InputError("orientations need four numbers each");
    all.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
  }
  return all;
}

}  // namespace

Json scene_to_json(const Scene& scene) {
  Json json{{"name", scene.name},
            {"triangles", scene.mesh.triangles},
            {"loose_edges", scene.mesh.loose_edges},
            {"positions", vectors_to_json(scene.mesh.positions)},
            {"rest_positions", vectors_to_json(scene.rest_positions)},
            {"velocities", vectors_to_json(scene.velocities)},
            {"bodies", Json::array()},
            {"motions", Json::array()},
            {"springs", Json::array()},
            {"gravity", to_json(scene.gravity)}};
  for (const Body& body : scene.bodies) json["bodies"].push_back(body_to_json(body));
  for (const PrescribedMotion& motion : scene.motions) json["motions"].push_back(motion_to_json(motion));
  for (const Spring& spring : scene.springs) json["springs"].push_back(spring_to_json(spring));
  if (!scene.excluded_pairs.empty()) json["excluded_pairs"] = scene.excluded_pairs;
  if (!scene.mesh.tetrahedra.empty()) json["tetrahedra"] = scene.mesh.tetrahedra;
  if (!scene.orientations.empty()) json["orientations"] = orientations_to_json(scene.orientations);
  for (const SettingInfo& info : setting_table())
    json["settings"][std::string(info.name)] = setting_text(scene.settings, info);
  return json;
}

Scene to_scene(const Json& json) {
  Scene scene;
  scene.name = json.at("name").get<std::string>();
  scene.mesh = {to_vectors(json.at("positions")), json.at("triangles").get<std::vector<Triangle>>(),
                json.at("loose_edges").get<std::vector<Edge>>()};
  if (json.contains("tetrahedra")) scene.mesh.tetrahedra = json.at("tetrahedra").get<std::vector<Tetrahedron>>();
  scene.rest_positions = to_vectors(json.at("rest_positions"));
  scene.velocities = to_vectors(json.at("velocities"));
  for (const Json& body : json.at("bodies")) scene.bodies.push_back(to_body(body));
  for (const Json& motion : json.at("motions")) scene.motions.push_back(to_motion(motion));
  for (const Json& spring : json.at("springs")) scene.springs.push_back(to_spring(spring));
  if (json.contains("excluded_pairs"))
    scene.excluded_pairs = json.at("excluded_pairs").get<std::vector<std::array<Index, 2>>>();
  if (json.contains("orientations")) scene.orientations = to_orientations(json.at("orientations"));
  scene.gravity = to_vector(json.at("gravity"));
  for (const auto& [name, value] : json.at("settings").items())
    set_setting(scene.settings, name, value.get<std::string>());
  round_to_single(scene);
  return scene;
}

Json sweep_case_to_json(const SweepCase& c) {
  Json json{{"scene", scene_to_json(*c.scene)},
            {"colour", c.colour},
            {"old", points_to_json(c.old)},
            {"start", points_to_json(c.start)},
            {"target", points_to_json(c.target)},
            {"previous", points_to_json(c.previous)},
            {"largest_bound", numbers_to_json(c.largest_bound)},
            {"query_radius", hexadecimal(c.query_radius)}};
  if (c.segment_colour.empty()) return json;
  json["segment_colour"] = c.segment_colour;
  json["orientation"] = orientations_to_json(c.orientation);
  json["orientation_start"] = orientations_to_json(c.orientation_start);
  return json;
}

SweepCase to_sweep_case(const Json& json) {
  SweepCase c;
  c.scene = std::make_shared<Scene>(to_scene(json.at("scene")));
  if (const auto problems = validate(*c.scene); !problems.empty()) throw InputError(describe(problems));
  const std::size_t count = c.scene->mesh.positions.size();
  c.colour = json.at("colour").get<std::vector<Index>>();
  c.old = to_vertices(json.at("old"), count);
  c.start = to_vertices(json.at("start"), count);
  c.target = to_vertices(json.at("target"), count);
  c.previous = to_vertices(json.at("previous"), count);
  c.largest_bound = to_numbers(json.at("largest_bound"));
  c.query_radius = number(json.at("query_radius"));
  if (c.colour.size() != count || c.largest_bound.size() != count)
    throw InputError("colour and largest_bound need one entry a vertex");
  if (json.contains("segment_colour")) {
    c.segment_colour = json.at("segment_colour").get<std::vector<Index>>();
    c.orientation = to_orientations(json.at("orientation"));
    c.orientation_start = to_orientations(json.at("orientation_start"));
  }
  const std::size_t segments = rod_segments(*c.scene).size();
  if (c.segment_colour.size() != segments || c.orientation.size() != segments || c.orientation_start.size() != segments)
    throw InputError("segment_colour, orientation and orientation_start need one entry a segment");
  return c;
}

}  // namespace ogc::compare
