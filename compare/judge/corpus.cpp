#include "compare/judge/corpus.hpp"

#include <algorithm>
#include <sstream>

#include "compare/files/bytes.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/judge/case_hdf5.hpp"
#include "compare/judge/corpus_forces.hpp"
#include "compare/judge/corpus_rest.hpp"
#include "compare/judge/corpus_scenes.hpp"
#include "compare/judge/numbers_json.hpp"
#include "compare/judge/shape.hpp"
#include "compare/judge/topology_json.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate.hpp"

namespace ogc::compare {

namespace {

std::vector<std::array<Index, 2>> to_pairs(const Json& json, std::size_t count) {
  const auto pairs = json.get<std::vector<std::array<Index, 2>>>();
  for (const auto& [a, b] : pairs)
    if (std::min(a, b) < 0 || static_cast<std::size_t>(std::max(a, b)) >= count || a == b)
      throw InputError("excluded_pairs need two vertices each");
  return pairs;
}

struct ToJson {
  Json operator()(const ClosestFaceCase& c) const {
    return {{"point", to_json(c.point)}, {"triangle", points_to_json(c.triangle)}};
  }
  Json operator()(const ClosestPointsCase& c) const {
    return {{"first", points_to_json(c.first)}, {"second", points_to_json(c.second)}};
  }
  Json operator()(const MeshCase& c) const {
    Json json{{"mesh", topology_to_json(*c.topology)},
              {"rigid_groups", c.rigid_groups},
              {"positions", points_to_json(c.positions)},
              {"contact_radius", hexadecimal(c.contact_radius)},
              {"query_radius", hexadecimal(c.query_radius)}};
    if (c.partners.rows() > 0) json["excluded_pairs"] = pairs_of(c.partners);
    return json;
  }
  Json operator()(const BoundCase& c) const {
    return {{"mesh", topology_to_json(*c.topology)},
            {"d_min_vertex", numbers_to_json(c.d_min_vertex)},
            {"d_min_edge", numbers_to_json(c.d_min_edge)},
            {"d_min_triangle", numbers_to_json(c.d_min_triangle)},
            {"bound_relaxation", hexadecimal(c.bound_relaxation)}};
  }
  Json operator()(const ActivationCase& c) const {
    return {{"distance", hexadecimal(c.distance)},
            {"contact_radius", hexadecimal(c.contact_radius)},
            {"stiffness", hexadecimal(c.stiffness)},
            {"activation", activation_names()[static_cast<std::size_t>(c.activation)]}};
  }
  Json operator()(const TruncateCase& c) const {
    return {{"previous", to_json(c.previous)}, {"position", to_json(c.position)}, {"bound", hexadecimal(c.bound)}};
  }
  Json operator()(const SweepCase& c) const { return sweep_case_to_json(c); }
  Json operator()(const StepCase& c) const { return {{"scene", scene_to_json(*c.scene)}}; }
  Json operator()(const RestStateCase& c) const { return case_to_json(c); }
  Json operator()(const BlockCase& c) const { return case_to_json(c); }
  Json operator()(const InitialGuessCase& c) const { return case_to_json(c); }
  template <class ForceCase>
  Json operator()(const ForceCase& c) const {
    return force_case_to_json(c);
  }
};

MeshCase to_mesh_case(const Json& data) {
  MeshCase c{to_topology(data.at("mesh")),
             data.at("rigid_groups").get<std::vector<Index>>(),
             {},
             number(data.at("contact_radius")),
             number(data.at("query_radius"))};
  for (const Json& p : data.at("positions")) c.positions.push_back(to_point(p));
  const auto count = static_cast<std::size_t>(c.topology->vertex_count);
  if (c.positions.size() != count || c.rigid_groups.size() != count)
    throw InputError("positions and rigid_groups need one entry a vertex");
  if (data.contains("excluded_pairs")) c.partners = partner_rows(count, to_pairs(data.at("excluded_pairs"), count));
  return c;
}

BoundCase to_bound_case(const Json& data) {
  BoundCase c{to_topology(data.at("mesh")), to_numbers(data.at("d_min_vertex")), to_numbers(data.at("d_min_edge")),
              to_numbers(data.at("d_min_triangle")), number(data.at("bound_relaxation"))};
  if (c.d_min_vertex.size() != static_cast<std::size_t>(c.topology->vertex_count) ||
      c.d_min_edge.size() != c.topology->edges.size() || c.d_min_triangle.size() != c.topology->triangles.size())
    throw InputError("d_min_vertex, d_min_edge and d_min_triangle need one entry a vertex, edge and triangle");
  return c;
}

ActivationCase to_activation_case(const Json& data) {
  const auto name = data.at("activation").get<std::string>();
  const auto found = std::find(activation_names().begin(), activation_names().end(), name);
  if (found == activation_names().end()) throw InputError(unknown_name("activation", name, activation_names()));
  return {number(data.at("distance")), number(data.at("contact_radius")), number(data.at("stiffness")),
          static_cast<ContactActivation>(found - activation_names().begin())};
}

StepCase to_step_case(const Json& data) {
  Scene scene = to_scene(data.at("scene"));
  if (const auto problems = validate(scene); !problems.empty()) throw InputError(describe(problems));
  auto topology = std::make_shared<Topology>(build_topology(scene));
  return {std::make_shared<Scene>(std::move(scene)), std::move(topology)};
}

CaseData to_data(Stage stage, const Json& data) {
  switch (stage) {
    case Stage::closest_face: return ClosestFaceCase{to_point(data.at("point")), to_points<3>(data.at("triangle"))};
    case Stage::closest_points:
      return ClosestPointsCase{to_points<2>(data.at("first")), to_points<2>(data.at("second"))};
    case Stage::rest_state: return to_rest_state_case(data);
    case Stage::block: return to_block_case(data);
    case Stage::initial_guess: return to_initial_guess_case(data);
    case Stage::bound: return to_bound_case(data);
    case Stage::sweep: return to_sweep_case(data);
    case Stage::step: return to_step_case(data);
    case Stage::activation: return to_activation_case(data);
    case Stage::truncate:
      return TruncateCase{to_point(data.at("previous")), to_point(data.at("position")), number(data.at("bound"))};
    case Stage::detect_vertex_facet:
    case Stage::detect_edge_edge: return to_mesh_case(data);
    default: return to_force_case(stage, data);
  }
}

}  // namespace

nlohmann::ordered_json case_to_json(const TestCase& test, const std::string& message) {
  return {{"format", case_format_version},
          {"problem", print_problem(test.name)},
          {"message", message},
          {"data", std::visit(ToJson{}, test.data)}};
}

std::filesystem::path save_case(const std::filesystem::path& folder, const TestCase& test, const std::string& message) {
  const CaseName& name = test.name;
  std::string stem = std::string(stage_name(name.stage)) + "." + name.generator + "." + std::to_string(name.seed) +
                     "." + std::to_string(name.index);
  for (const Override& parameter : name.overrides) stem += "." + parameter.name + "=" + hexadecimal(parameter.value);
  const std::filesystem::path path = folder / (stem + ".h5");
  write_case_hdf5(path, case_to_json(test, message));
  const Shape shape = shape_of(test.data);
  if (shape.points.empty()) return path;
  if (const std::string mesh = print_shape_obj(shape); !mesh.empty()) write_bytes(folder / (stem + ".obj"), mesh);
  write_bytes(folder / (stem + ".svg"), print_shape_svg(shape, print_problem(name) + ": " + message));
  return path;
}

TestCase load_case(const std::filesystem::path& path) {
  const bool is_text = path.extension() == ".json";
  const std::string text = is_text ? read_bytes(path) : "";
  try {
    const Json json = is_text ? parse_json(text, path.string()) : read_case_hdf5(path);
    const int format = json.at("format").get<int>();
    if (format != case_format_version)
      throw InputError("format " + std::to_string(format) + " is not the one this program reads (" +
                       std::to_string(case_format_version) + ")");
    TestCase test{parse_problem(json.at("problem").get<std::string>()), {}};
    test.data = to_data(test.name.stage, json.at("data"));
    return test;
  } catch (const nlohmann::json::exception& problem) {
    throw InputError(path.string() + ": " + problem.what());
  } catch (const InputError& problem) {
    throw InputError(path.string() + ": " + problem.what());
  } catch (const std::out_of_range& problem) {
    throw InputError(path.string() + ": mesh: " + problem.what());
  }
}

std::vector<CaseName> load_batch(const std::filesystem::path& path) {
  std::istringstream file(read_bytes(path));
  std::vector<CaseName> names;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line[0] == '#') continue;
    try {
      names.push_back(parse_problem(line));
    } catch (const InputError& problem) {
      throw InputError(path.string() + ", line " + std::to_string(number) + ": " + problem.what());
    }
  }
  return names;
}

}  // namespace ogc::compare
