#include "experiments/plugins/table.hpp"

#include <cstddef>

#include <nlohmann/json.hpp>

#include "experiments/plugins/worker.hpp"

namespace ogc::experiments {

namespace {

std::string_view role_name(Role role) {
  switch (role) {
    case Role::field: return "field";
    case Role::value: return "value";
    case Role::input: return "input";
    case Role::output: return "output";
    case Role::capacity: return "capacity";
    case Role::count: return "count";
    case Role::nested: return "nested";
    case Role::reserved: return "reserved";
  }
  return "";
}

std::string_view type_name(const Member& member) {
  switch (member.element) {
    case Element::number: return "float32";
    case Element::byte: return "uint8";
    case Element::index: return "int32";
    case Element::real: return "float64";
    case Element::wide: return "int64";
    case Element::structure: return member.structure->name;
  }
  return "";
}

/// Appends the lengths that a group of outputs has before its own: those of vertices, and so on.
void add_groups(Json& shape, Per per, bool is_list) {
  switch (per) {
    case Per::one:
      if (!is_list) shape.push_back(1);
      return;
    case Per::item: shape.push_back("n"); return;
    case Per::vertex: shape.push_back("vertex_count"); return;
    case Per::edge: shape.push_back("edge_count"); return;
    case Per::triangle: shape.push_back("triangle_count"); return;
    case Per::two_bodies:
      shape.push_back("body_count");
      shape.push_back("body_count");
      return;
  }
}

/// Returns the name of the member that counts the list.
std::string_view counter_of(List list, const Structure& structure) {
  for (const Member& member : structure.members)
    if (member.role == Role::count && member.list == list) return member.name;
  return "";
}

Json shape_of(const Member& member, const Structure& structure) {
  Json shape = Json::array();
  if (member.role == Role::input) {
    constexpr std::string_view times = " * ";
    std::string_view words = member.length;
    for (auto at = words.find(times); at != std::string_view::npos; at = words.find(times)) {
      shape.push_back(words.substr(0, at));
      words.remove_prefix(at + times.size());
    }
    shape.push_back(words);
  }
  if (member.role == Role::output) {
    if (member.list != List::none) shape.push_back(counter_of(member.list, structure));
    add_groups(shape, member.per, member.list != List::none);
  }
  for (const std::size_t length : member.fixed)
    if (length > 0) shape.push_back(length);
  return shape;
}

Json member_json(const Member& member, const Structure& structure) {
  Json json{{"name", member.name}, {"offset", member.offset}, {"role", role_name(member.role)}};
  if (member.role == Role::reserved) return json;
  json["type"] = type_name(member);
  json["shape"] = shape_of(member, structure);
  if (member.list != List::none) json["list"] = static_cast<std::size_t>(member.list);
  if (member.role == Role::value) json["question"] = member.question;
  return json;
}

}  // namespace

Json plugin_table() {
  Json stages = Json::array(), structures = Json::array();
  for (const PluginStage& stage : plugin_stages())
    stages.push_back({{"name", stage.name},
                      {"function", "ogc_" + std::string(stage.name)},
                      {"in", stage.in->name},
                      {"out", stage.out->name},
                      {"inputs", stage.inputs}});
  for (const Structure* structure : plugin_structures()) {
    Json members = Json::array();
    for (const Member& member : structure->members) members.push_back(member_json(member, *structure));
    structures.push_back({{"name", structure->name}, {"bytes", structure->bytes}, {"members", members}});
  }
  return {{"version", OGC_PLUGIN_VERSION}, {"stages", stages}, {"structures", structures}};
}

std::string python_layout() {
  return Json{{"table", plugin_table()},
              {"request",
               {{"stage", offsetof(CallRequest, stage)},
                {"sizes", offsetof(CallRequest, sizes)},
                {"limit_seconds", offsetof(CallRequest, limit_seconds)}}},
              {"result",
               {{"bytes", sizeof(CallResult)},
                {"status", offsetof(CallResult, status)},
                {"counts", offsetof(CallResult, counts)},
                {"seconds", offsetof(CallResult, seconds)}}},
              {"kernels", python_kernels()}}
      .dump();
}

}  // namespace ogc::experiments
