#include "compare/record/manifest.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <stdexcept>

#include "compare/files/bytes.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {
namespace {

struct TextField {
  std::string_view name;
  std::string Provenance::*field;
};

constexpr std::array<TextField, 11> text_fields{{{"status", &Provenance::status},
                                                 {"started", &Provenance::started},
                                                 {"ended", &Provenance::ended},
                                                 {"command", &Provenance::command},
                                                 {"solver", &Provenance::solver},
                                                 {"backend", &Provenance::backend},
                                                 {"device", &Provenance::device},
                                                 {"version", &Provenance::version},
                                                 {"commit", &Provenance::commit},
                                                 {"compiler", &Provenance::compiler},
                                                 {"cuda", &Provenance::cuda}}};

constexpr std::array<std::string_view, 9> other_fields{"format", "format_version", "dirty",  "warnings", "seed",
                                                       "scene",  "settings",       "stages", "origin"};

bool is_known(std::string_view key) {
  return std::any_of(text_fields.begin(), text_fields.end(),
                     [&](const TextField& entry) { return entry.name == key; }) ||
         std::find(other_fields.begin(), other_fields.end(), key) != other_fields.end();
}

Json quantity(double value, std::string_view unit) { return {{"value", value}, {"unit", unit}}; }

Json settings_json(const Settings& settings) {
  Json json = Json::object();
  for (const SettingInfo& info : setting_table()) {
    Json& entry = json[std::string(info.name)] = quantity(get_setting(settings, info), info.unit);
    switch (kind_of(info)) {
      case SettingKind::real: break;
      case SettingKind::whole: entry["value"] = static_cast<std::int64_t>(get_setting(settings, info)); break;
      case SettingKind::choice: entry["value"] = setting_text(settings, info); break;
    }
    entry["meaning"] = info.meaning;
  }
  return json;
}

Json material_json(const Material& material) {
  Json json = {{"membrane", name_of(material.membrane)}, {"bending", name_of(material.bending)}};
  for (const MaterialInfo& info : material_table())
    json[std::string(info.name)] = quantity(material.*info.field, info.unit);
  if (!material.rod) return json;
  for (const RodInfo& info : rod_table())
    json["rod"][std::string(info.name)] = quantity((*material.rod).*info.field, info.unit);
  return json;
}

std::int64_t prescribed_count(const Scene& scene, const Body& body) {
  const auto is_in = [&](Index v) { return v >= body.first_vertex && v < body.first_vertex + body.vertex_count; };
  std::int64_t count = 0;
  for (const PrescribedMotion& motion : scene.motions) count += std::ranges::count_if(motion.vertices, is_in);
  return count;
}

Json bodies_json(const Scene& scene) {
  Json json = Json::array();
  for (const Body& body : scene.bodies) {
    Json& entry = json.emplace_back(
        Json{{"name", body.name}, {"first_vertex", body.first_vertex}, {"vertex_count", body.vertex_count}});
    for_each_of<MeshLists>([&]<class List, std::size_t>() {
      if constexpr (HasRange<List>) {
        entry[std::string("first_") + List::name] = body.*List::first;
        entry[std::string(List::name) + "_count"] = body.*List::count;
      }
    });
    entry["fixed"] = body.fixed;
    entry["body_contact"] = name_of(body.contact);
    entry["prescribed_vertices"] = prescribed_count(scene, body);
    entry["material"] = material_json(body.material);
  }
  return json;
}

Json scene_json(const Manifest& manifest, const Scene& scene) {
  Json json{{"name", manifest.scene_name}, {"file", manifest.scene_file}, {"vertices", scene.mesh.positions.size()}};
  for_each_of<MeshLists>([&]<class List, std::size_t>() { json[List::key] = (scene.mesh.*List::list).size(); });
  for_each_of<SceneLists>([&]<class List, std::size_t>() { json[List::key] = (scene.*List::list).size(); });
  json["excluded_pairs"] = scene.excluded_pairs.size();
  json["gravity"] = {{"value", {scene.gravity.x, scene.gravity.y, scene.gravity.z}}, {"unit", "m/s²"}};
  json["bodies"] = bodies_json(scene);
  return json;
}

Json extra_json(const std::string& value) {
  return value == "yes" || value == "no" ? Json(value == "yes") : Json(value);
}

std::string extra_text(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

Provenance provenance_of(const Json& json) {
  Provenance provenance;
  for (const TextField& entry : text_fields)
    provenance.*entry.field = json.at(std::string(entry.name)).get<std::string>();
  provenance.dirty = json.at("dirty").get<bool>();
  provenance.warnings = json.value("warnings", std::vector<std::string>{});
  if (json.contains("origin")) {
    const auto origin = json.at("origin").at("value").get<std::array<double, 3>>();
    provenance.origin = {origin[0], origin[1], origin[2]};
  }
  for (const auto& [key, value] : json.items())
    if (!is_known(key)) provenance.extra[key] = extra_text(value);
  return provenance;
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text;
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

std::string manifest_text(const Manifest& manifest, const Scene& scene) {
  Json json = {{"format", "ogc run"}, {"format_version", run_format_version}};
  for (const TextField& entry : text_fields) json[std::string(entry.name)] = manifest.provenance.*entry.field;
  json["dirty"] = manifest.provenance.dirty;
  json["warnings"] = manifest.provenance.warnings;
  if (const auto& [x, y, z] = manifest.provenance.origin; manifest.provenance.origin != Vec3{})
    json["origin"] = {{"value", {x, y, z}}, {"unit", "m"}};
  for (const auto& [key, value] : manifest.provenance.extra) {
    if (is_known(key))
      throw std::invalid_argument("run.json: '" + key + "' has a meaning of its own and can't be an extra entry");
    json[key] = extra_json(value);
  }
  json["seed"] = scene.settings.seed;
  json["scene"] = scene_json(manifest, scene);
  json["settings"] = settings_json(scene.settings);
  json["stages"] = manifest.stage_names;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest read_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "run.json";
  if (!std::filesystem::exists(path))
    throw InputError(path.string() + ": is missing: name a folder that `ogc run` has written");
  const Json json = parse_json(read_bytes(path), path.string());
  try {
    if (json.at("format").get<std::string>() != "ogc run")
      throw InputError(path.string() + ": is not of a run: name a folder that `ogc run` has written");
    if (const auto version = json.at("format_version").get<std::int64_t>(); version > run_format_version)
      throw InputError(path.string() + ": is of run format " + std::to_string(version) + ", newer than format " +
                       std::to_string(run_format_version) + ", the newest that this program reads: use a newer ogc");
    return {provenance_of(json), json.at("scene").at("name").get<std::string>(),
            json.at("scene").at("file").get<std::string>(), json.at("stages").get<std::vector<std::string>>()};
  } catch (const Json::exception& error) {
    throw InputError(path.string() + ": " + error.what() +
                     ": the file was changed by hand or is damaged; restore it, or run the scene again");
  }
}

}  // namespace ogc::compare
