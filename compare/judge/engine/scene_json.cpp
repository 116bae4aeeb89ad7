// Writes doubles as JSON numbers, whose shortest text is read back as the same bits. Settings are written as users type
// them; this is exact because a scene's numbers are rounded to single precision.
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
  Json all{{"name", body.name}, {"vertices", {body.first_vertex, body.vertex_count}}};
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasRange<List>) all[List::key] = {body.*List::first, body.*List::count};
  });
  all["fixed"] = body.fixed;
  all["body_contact"] = name_of(body.contact);
  all["material"] = material;
  return all;
}

Body to_body(const Json& json) {
  Body body;
  body.name = json.at("name").get<std::string>();
  body.first_vertex = json.at("vertices").at(0).get<Index>();
  body.vertex_count = json.at("vertices").at(1).get<Index>();
  body.fixed = json.at("fixed").get<bool>();
  if (json.contains("body_contact"))
    body.contact = to_model<BodyContact>(json.at("body_contact"), choice_names<BodyContact>);
  const Json& material = json.at("material");
  body.material.membrane = to_model<MembraneModel>(material.at("membrane"), choice_names<MembraneModel>);
  body.material.bending = to_model<BendingModel>(material.at("bending"), choice_names<BendingModel>);
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasRange<List>) {
      if (HasVolume<List> && !json.contains(List::key)) return;
      body.*List::first = json.at(List::key).at(0).template get<Index>();
      body.*List::count = json.at(List::key).at(1).template get<Index>();
    }
  });
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

/// Writes the elements of a scene's list as rows of their fields.
template <class List>
Json elements_to_json(const Scene& scene) {
  Json json = Json::array();
  for (const auto& element : scene.*List::list) {
    Json& row = json.emplace_back(Json::array());
    for (const auto& field : List::fields) {
      if (!has_field(element, field)) continue;
      if (field.vertex != nullptr) row.push_back(element.*field.vertex);
      if (field.number != nullptr) row.push_back(element.*field.number);
    }
  }
  return json;
}

template <class List>
void to_elements(const Json& json, Scene& scene) {
  for (const Json& row : json) {
    auto& element = (scene.*List::list).emplace_back();
    for (std::size_t k = 0; k < List::fields.size(); ++k) {
      const auto& field = List::fields[k];
      if (field.goes_with != nullptr && k >= row.size()) continue;
      if (field.vertex != nullptr) element.*field.vertex = row.at(k).template get<Index>();
      if (field.number != nullptr) element.*field.number = row.at(k).template get<double>();
    }
  }
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
  Json json{{"name", scene.name}};
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (!HasVolume<List>) json[List::key] = scene.mesh.*List::list;
  });
  json.update(Json{{"positions", vectors_to_json(scene.mesh.positions)},
                   {"rest_positions", vectors_to_json(scene.rest_positions)},
                   {"velocities", vectors_to_json(scene.velocities)},
                   {"bodies", Json::array()},
                   {"motions", Json::array()}});
  for (const Body& body : scene.bodies) json["bodies"].push_back(body_to_json(body));
  for (const PrescribedMotion& motion : scene.motions) json["motions"].push_back(motion_to_json(motion));
  for_each_of<SceneLists>([&]<class List, std::size_t>() { json[List::key] = elements_to_json<List>(scene); });
  json["gravity"] = to_json(scene.gravity);
  if (!scene.excluded_pairs.empty()) json["excluded_pairs"] = scene.excluded_pairs;
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>)
      if (!(scene.mesh.*List::list).empty()) json[List::key] = scene.mesh.*List::list;
  });
  if (!scene.orientations.empty()) json["orientations"] = orientations_to_json(scene.orientations);
  for (const SettingInfo& info : setting_table())
    json["settings"][std::string(info.name)] = setting_text(scene.settings, info);
  return json;
}

Scene to_scene(const Json& json) {
  Scene scene;
  scene.name = json.at("name").get<std::string>();
  scene.mesh.positions = to_vectors(json.at("positions"));
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if (!HasVolume<List> || json.contains(List::key)) json.at(List::key).get_to(scene.mesh.*List::list);
  });
  scene.rest_positions = to_vectors(json.at("rest_positions"));
  scene.velocities = to_vectors(json.at("velocities"));
  for (const Json& body : json.at("bodies")) scene.bodies.push_back(to_body(body));
  for (const Json& motion : json.at("motions")) scene.motions.push_back(to_motion(motion));
  for_each_of<SceneLists>([&]<class List, std::size_t>() { to_elements<List>(json.at(List::key), scene); });
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
