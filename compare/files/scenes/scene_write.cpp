// Writes everything, also defaults: a scene file shows what can be edited. Rows of numbers stay on one line, and
// numbers that the reader rounds to single precision are written as short as that allows.
#include <algorithm>
#include <array>
#include <bit>

#include "compare/files/bytes.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/scenes/keyframes.hpp"
#include "compare/files/scenes/orientations.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {
namespace {

Json to_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json rounded_json(const Vec3& v) { return to_json({as_typed(v.x), as_typed(v.y), as_typed(v.z)}); }

// Compares bit for bit, so that a negative zero survives.
bool same_bits(const Vec3& a, const Vec3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

Json settings_json(const Settings& settings) {
  Json json = Json::object();
  for (const SettingInfo& info : setting_table()) {
    Json& value = json[std::string(info.name)];
    switch (kind_of(info)) {
      case SettingKind::real: value = as_typed(get_setting(settings, info)); break;
      case SettingKind::whole: value = static_cast<std::int64_t>(get_setting(settings, info)); break;
      case SettingKind::choice: value = setting_text(settings, info); break;
    }
  }
  return json;
}

Json material_json(const Material& material) {
  Json json = Json::object();
  for (const MaterialInfo& info : material_table()) json[std::string(info.name)] = as_typed(material.*info.field);
  json["membrane"] = name_of(material.membrane);
  json["bending"] = name_of(material.bending);
  if (!material.rod) return json;
  for (const RodInfo& info : rod_table()) json["rod"][std::string(info.name)] = as_typed((*material.rod).*info.field);
  return json;
}

// Returns the body's mesh. Its positions are the body's entries of `values`, an array over the vertices of the scene.
Mesh body_mesh(const Scene& scene, const Body& body, const std::vector<Vec3>& values) {
  Mesh mesh;
  const Index first = body.first_vertex, end = first + body.vertex_count;
  mesh.positions.assign(values.begin() + first, values.begin() + end);
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    std::span<const ElementOf<List>> all(scene.mesh.*List::list);
    if constexpr (HasRange<List>)
      all = all.subspan(static_cast<std::size_t>(body.*List::first), static_cast<std::size_t>(body.*List::count));
    for (ElementOf<List> element : all) {
      if (element[0] < first || element[0] >= end) continue;
      for (Index& v : element) v -= first;
      (mesh.*List::list).push_back(element);
    }
  });
  return mesh;
}

std::vector<Quaternion> orientations_of(const Scene& scene, const Body& body) {
  std::vector<Quaternion> own;
  if (scene.orientations.empty()) return own;
  const std::vector<Index> segments = rod_segments(scene);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Index v = scene.mesh.loose_edges[static_cast<std::size_t>(segments[s])][0];
    if (v >= body.first_vertex && v < body.first_vertex + body.vertex_count) own.push_back(scene.orientations[s]);
  }
  return own;
}

Json body_json(const std::filesystem::path& folder, const Scene& scene, const Body& body) {
  const std::string stem = scene.name + "_" + body.name;
  const std::string extension = body.is_solid() ? ".msh" : ".ply";
  const auto write = [&](const std::string& name, const std::vector<Vec3>& values) {
    write_mesh(folder / name, body_mesh(scene, body, values));
    return name;
  };
  Json json = {{"name", body.name},
               {"fixed", body.fixed},
               {"body_contact", name_of(body.contact)},
               {"mesh", write(stem + extension, scene.mesh.positions)}};
  const auto start = scene.mesh.positions.begin() + body.first_vertex,
             rest = scene.rest_positions.begin() + body.first_vertex;
  if (!std::equal(start, start + body.vertex_count, rest, same_bits))
    json["rest_mesh"] = write(stem + "_rest" + extension, scene.rest_positions);
  const auto velocity = scene.velocities.begin() + body.first_vertex;
  const bool uniform = std::all_of(velocity, velocity + body.vertex_count,
                                   [&](const Vec3& v) { return same_bits(v, *velocity); });
  if (uniform) {
    json["velocity"] = rounded_json(*velocity);
  } else {
    json["velocities"] = write(stem + "_velocities" + extension, scene.velocities);
  }
  json["material"] = material_json(body.material);
  if (const std::vector<Quaternion> own = orientations_of(scene, body); !own.empty()) {
    json["orientations"] = stem + "_orientations.h5";
    write_orientations(folder / json["orientations"].get<std::string>(), own);
  }
  return json;
}

// Returns the selections of a motion. Successive vertices of the same body share one selection; selections keep the
// order of `vertices`.
Json selections_json(const Scene& scene, const std::vector<Index>& vertices) {
  const std::vector<Index> owner = body_of_vertex(scene);
  Json selections = Json::array();
  Index current = -1;
  for (const Index v : vertices) {
    const Index b = owner[static_cast<std::size_t>(v)];
    const Body& body = scene.bodies[static_cast<std::size_t>(b)];
    if (b != current) selections.push_back({{"body", body.name}, {"indices", Json::array()}});
    current = b;
    selections.back()["indices"].push_back(v - body.first_vertex);
  }
  return selections;
}

Json motion_json(const std::filesystem::path& folder, const Scene& scene, const PrescribedMotion& motion) {
  Json json = {{"name", motion.name}, {"vertices", selections_json(scene, motion.vertices)}};
  if (!motion.keyframes.empty()) {
    const std::string name = scene.name + "_" + motion.name + ".h5";
    write_keyframes(folder / name, motion.keyframes);
    json["keyframes"] = name;
    return json;
  }
  json.update({{"centre", to_json(motion.centre)},
               {"axis", to_json(motion.axis)},
               {"angular_velocity", motion.angular_velocity},
               {"velocity", to_json(motion.velocity)},
               {"start", motion.start},
               {"end", motion.end}});
  return json;
}

template <class List>
Json elements_json(const Scene& scene) {
  const std::vector<Index> owner = body_of_vertex(scene);
  const auto end = [&](Index v) -> Json {
    const Body& body = scene.bodies[static_cast<std::size_t>(owner[static_cast<std::size_t>(v)])];
    return {{"body", body.name}, {"index", v - body.first_vertex}};
  };
  Json elements = Json::array();
  for (const auto& element : scene.*List::list) {
    Json& json = elements.emplace_back(Json::object());
    for (const auto& field : List::fields) {
      if (!has_field(element, field)) continue;
      if (field.vertex != nullptr) json[field.name] = end(element.*field.vertex);
      if (field.number != nullptr) json[field.name] = as_typed(element.*field.number);
    }
  }
  return elements;
}

void print(const Json& value, const std::string& indent, std::string& text) {
  const bool is_row = value.is_array() &&
                      std::all_of(value.begin(), value.end(), [](const Json& x) { return x.is_primitive(); });
  if (value.is_primitive() || value.empty()) {
    text += value.dump();
    return;
  }
  const std::string inner = indent + "  ";
  text += value.is_object() ? "{" : "[";
  const char* separator = "";
  for (const auto& [key, item] : value.items()) {
    text += separator;
    if (!is_row) text += "\n" + inner;
    if (value.is_object()) text += Json(key).dump() + ": ";
    print(item, inner, text);
    separator = is_row ? ", " : ",";
  }
  if (!is_row) text += "\n" + indent;
  text += value.is_object() ? "}" : "]";
}

}  // namespace

Json excluded_pairs_json(std::span<const Body> bodies, std::span<const std::array<Index, 2>> pairs) {
  const auto number_of = [&](Index v) {
    const auto holds = [&](const Body& body) { return v < body.first_vertex + body.vertex_count; };
    return static_cast<std::size_t>(std::ranges::find_if(bodies, holds) - bodies.begin());
  };
  Json runs = Json::array();
  std::array<std::size_t, 2> current{bodies.size(), bodies.size()};
  for (const auto& [a, b] : pairs) {
    const std::array<std::size_t, 2> numbers{number_of(a), number_of(b)};
    const Body &first = bodies[numbers[0]], &second = bodies[numbers[1]];
    if (numbers != current) runs.push_back({{"bodies", {first.name, second.name}}, {"vertices", Json::array()}});
    current = numbers;
    runs.back()["vertices"].push_back({a - first.first_vertex, b - second.first_vertex});
  }
  return runs;
}

std::filesystem::path write_scene(const std::filesystem::path& folder, const Scene& scene) {
  const std::vector<Problem> problems = validate(scene);
  if (!problems.empty()) throw InputError("a scene that can't be read back is not written: " + describe(problems));
  Json json = {
      {"format_version", scene_format_version}, {"name", scene.name}, {"gravity", rounded_json(scene.gravity)}};
  json["settings"] = settings_json(scene.settings);
  json["bodies"] = Json::array();
  for (const Body& body : scene.bodies) json["bodies"].push_back(body_json(folder, scene, body));
  json["motions"] = Json::array();
  for (const PrescribedMotion& motion : scene.motions) json["motions"].push_back(motion_json(folder, scene, motion));
  for_each_of<SceneLists>([&]<class List, std::size_t>() { json[List::key] = elements_json<List>(scene); });
  if (!scene.excluded_pairs.empty()) json["excluded_pairs"] = excluded_pairs_json(scene.bodies, scene.excluded_pairs);
  std::string text;
  print(json, "", text);
  const std::filesystem::path file = folder / (scene.name + ".json");
  write_bytes(file, text + "\n");
  return file;
}

}  // namespace ogc::compare
