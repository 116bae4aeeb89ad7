// Builds the keys of settings and materials from their tables; the other keys are written here. A test checks that the
// reader knows every key here.
#include "compare/files/json_reader.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {
namespace {

Json value(const char* type, const std::string& description) { return {{"type", type}, {"description", description}}; }

Json vector(const std::string& description) {
  return {{"type", "array"},
          {"items", {{"type", "number"}}},
          {"minItems", 3},
          {"maxItems", 3},
          {"description", description}};
}

Json array(const Json& items, const std::string& description) {
  return {{"type", "array"}, {"items", items}, {"description", description}};
}

// Returns the schema of an object that may have no other keys.
Json object(const Json& properties, const std::vector<std::string>& required) {
  Json json = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) json["required"] = required;
  return json;
}

std::string with_unit(std::string_view meaning, std::string_view unit) {
  return std::string(meaning) + " [" + std::string(unit) + "]";
}

Json model_schema(std::span<const std::string_view> names, std::string_view standard) {
  Json json = {{"enum", Json::array()}, {"default", standard}};
  for (const std::string_view name : names) json["enum"].push_back(name);
  return json;
}

Json settings_schema() {
  const Settings defaults;
  Json properties = Json::object();
  for (const SettingInfo& info : setting_table()) {
    if (!info.choices.empty()) {
      Json& row = properties[std::string(info.name)] = model_schema(info.choices, setting_text(defaults, info));
      row["description"] = info.meaning;
      continue;
    }
    const bool whole = kind_of(info) == SettingKind::whole;
    Json& row = properties[std::string(info.name)] = value(whole ? "integer" : "number",
                                                           with_unit(info.meaning, info.unit));
    row["minimum"] = info.minimum;
    row["maximum"] = info.maximum;
    row["default"] = get_setting(defaults, info);
    if (whole) row["default"] = static_cast<std::int64_t>(get_setting(defaults, info));
  }
  properties["lanes"]["enum"] = {0, 1, 2, 4, 8, 16, 32};
  return object(properties, {});
}

Json rod_schema() {
  const RodMaterial defaults;
  Json properties = Json::object();
  for (const RodInfo& info : rod_table()) {
    Json& row = properties[std::string(info.name)] = value("number", with_unit(info.meaning, info.unit));
    row["minimum"] = info.minimum;
    row["maximum"] = info.maximum;
    row["default"] = defaults.*info.field;
  }
  return object(properties, {});
}

Json material_schema() {
  const Material defaults;
  Json properties = Json::object();
  for (const MaterialInfo& info : material_table()) {
    Json& row = properties[std::string(info.name)] = value("number", with_unit(info.meaning, info.unit));
    row["minimum"] = info.minimum;
    row["maximum"] = info.maximum;
    row["default"] = defaults.*info.field;
  }
  const auto between = [&](const char* name, const char* description, double minimum, double maximum) {
    Json& row = properties[name] = value("number", description);
    row["minimum"] = minimum;
    row["maximum"] = maximum;
  };
  between("solid_young", "tetrahedra: Young's modulus; with solid_poisson in place of Lamé constants [Pa]", least_young,
          most_young);
  between("solid_poisson", "tetrahedra: Poisson's ratio [1]", 0, most_poisson);
  properties["membrane"] = model_schema(choice_names<MembraneModel>, name_of(defaults.membrane));
  properties["bending"] = model_schema(choice_names<BendingModel>, name_of(defaults.bending));
  properties["rod"] = rod_schema();
  properties["rod"]["description"] = "of the body's loose edges, its segments; without it they have no mass";
  return object(properties, {});
}

Json body_schema() {
  Json contact = model_schema(choice_names<BodyContact>, name_of(Body{}.contact));
  contact["description"] = "surface: nothing passes through it; volume: others may enter it, and are pushed out";
  const Json properties = {
      {"name", value("string", "letters, digits, _ and -; default: that of the mesh's file")},
      {"fixed", value("boolean", "never moves; default false")},
      {"mesh", value("string",
                     "mesh file (.ply, .obj, .stl, .off, .gltf, .glb, .vtp, of tetrahedra .msh, .mesh, .vtu, .vtk), "
                     "relative to this file; start positions [m]. The surface of tetrahedra is their boundary")},
      {"rest_mesh", value("string", "the same faces or tetrahedra at their rest positions [m]; default: the mesh")},
      {"velocity", vector("of all vertices at the start [m/s]; default 0")},
      {"velocities",
       value("string", "the same faces with velocities [m/s] in the place of positions; instead of 'velocity'")},
      {"material", material_schema()},
      {"body_contact", contact},
      {"orientations", value("string",
                             "of a rod: HDF5 file, relative to this file, with the start orientations [segments][4] of "
                             "its edges as unit quaternions x, y, z, w; default: those of its rest shape, turned")},
  };
  return object(properties, {"mesh"});
}

Json motion_schema() {
  const Json box = object({{"minimum", vector("[m]")}, {"maximum", vector("[m]")}}, {"minimum", "maximum"});
  const Json selection = object(
      {{"body", value("string", "name of a body; all of its vertices unless 'box' or 'indices' says which")},
       {"box", box},
       {"indices", array(value("integer", "number in the body's mesh file, from 0"), "vertices")}},
      {"body"});
  const Json properties = {
      {"name", value("string", "letters, digits, _ and -")},
      {"vertices", array(selection, "what moves, as one rigid group")},
      {"centre", vector("a point of the axis [m]; default 0")},
      {"axis", vector("direction, right-hand rule; default [1, 0, 0]")},
      {"angular_velocity", value("number", "[rad/s]; default 0")},
      {"velocity", vector("[m/s]; default 0")},
      {"start", value("number", "at rest before [s]; default 0")},
      {"end", value("number", "at rest after [s]; default 1e30")},
      {"keyframes", value("string",
                          "in place of the rigid motion: HDF5 file, relative to this file, with time [frames] in s and "
                          "position [frames · vertices][3] in m")},
  };
  return object(properties, {"name", "vertices"});
}

template <class List>
Json elements_schema() {
  const Json end = object({{"body", value("string", "name of a body")},
                           {"index", value("integer", "vertex in the body's mesh file, from 0")}},
                          {"body", "index"});
  Json properties = Json::object();
  std::vector<std::string> required;
  for (const auto& field : List::fields) {
    if (field.is_required) required.emplace_back(field.name);
    Json& row = properties[field.name] = field.vertex != nullptr ? end : value("number", field.meaning);
    if (field.number != nullptr) row["minimum"] = 0;
    if (field.maximum) row["maximum"] = *field.maximum;
  }
  return array(object(properties, required), List::meaning);
}

Json excluded_schema() {
  const auto two = [](const Json& items, const std::string& description) {
    Json json = array(items, description);
    json["minItems"] = json["maxItems"] = 2;
    return json;
  };
  const Json pairs = array(
      two({{"type", "integer"}},
          "a vertex of the first body and one of the second, each numbered within its body from 0"),
      "pairs");
  return object({{"bodies", two({{"type", "string"}}, "names; may be the same")}, {"vertices", pairs}},
                {"bodies", "vertices"});
}

}  // namespace

std::string scene_schema() {
  Json properties = {
      {"format_version", {{"type", "integer"}, {"minimum", 1}, {"maximum", scene_format_version}}},
      {"name", value("string", "letters, digits, _ and -; default: that of this file")},
      {"gravity", vector("[m/s²]; default [0, -9.81, 0]")},
      {"settings", settings_schema()},
      {"bodies", array(body_schema(), "in the order of their vertices")},
      {"motions", array(motion_schema(), "prescribed motions")},
  };
  for_each_of<SceneLists>([&]<class List, std::size_t>() { properties[List::key] = elements_schema<List>(); });
  properties.update(Json{
      {"excluded_pairs", array(excluded_schema(),
                               "two faces are no contact, and not audited, where a vertex of one and a vertex of the "
                               "other are such a pair")},
      {"body_pairs",
       {{"type", "array"}, {"maxItems", 0}, {"description", "reserved for materials of pairs of bodies"}}},
  });
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "OGC Testbed scene"}};
  schema.update(object(properties, {"format_version", "bodies"}));
  return schema.dump(2) + "\n";
}

}  // namespace ogc::compare
