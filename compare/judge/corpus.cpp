#include "compare/judge/corpus.hpp"

#include <cstdio>
#include <fstream>

#include "compare/judge/corpus_forces.hpp"
#include "compare/judge/corpus_rest.hpp"
#include "compare/judge/corpus_scenes.hpp"
#include "compare/judge/numbers_json.hpp"
#include "compare/judge/topology_json.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"

namespace ogc::compare {

namespace {

struct ToJson {
  Json operator()(const ClosestFaceCase& c) const { return {{"point", to_json(c.point)}, {"triangle", points_to_json(c.triangle)}}; }
  Json operator()(const ClosestPointsCase& c) const { return {{"first", points_to_json(c.first)}, {"second", points_to_json(c.second)}}; }
  Json operator()(const MeshCase& c) const {
    return {{"mesh", topology_to_json(*c.topology)}, {"rigid_groups", c.rigid_groups}, {"positions", points_to_json(c.positions)},
            {"contact_radius", hexadecimal(c.contact_radius)}, {"query_radius", hexadecimal(c.query_radius)}};
  }
  Json operator()(const BoundCase& c) const {
    return {{"mesh", topology_to_json(*c.topology)}, {"d_min_vertex", numbers_to_json(c.d_min_vertex)}, {"d_min_edge", numbers_to_json(c.d_min_edge)},
            {"d_min_triangle", numbers_to_json(c.d_min_triangle)}, {"bound_relaxation", hexadecimal(c.bound_relaxation)}};
  }
  Json operator()(const ActivationCase& c) const {
    return {{"distance", hexadecimal(c.distance)}, {"contact_radius", hexadecimal(c.contact_radius)}, {"stiffness", hexadecimal(c.stiffness)}};
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
  MeshCase c{to_topology(data.at("mesh")), data.at("rigid_groups").get<std::vector<Index>>(), {}, number(data.at("contact_radius")),
             number(data.at("query_radius"))};
  for (const Json& p : data.at("positions")) c.positions.push_back(to_point(p));
  const auto count = static_cast<std::size_t>(c.topology->vertex_count);
  if (c.positions.size() != count || c.rigid_groups.size() != count) throw InputError("positions and rigid_groups need one entry a vertex");
  return c;
}

BoundCase to_bound_case(const Json& data) {
  BoundCase c{to_topology(data.at("mesh")), to_numbers(data.at("d_min_vertex")), to_numbers(data.at("d_min_edge")), to_numbers(data.at("d_min_triangle")),
              number(data.at("bound_relaxation"))};
  if (c.d_min_vertex.size() != static_cast<std::size_t>(c.topology->vertex_count) || c.d_min_edge.size() != c.topology->edges.size() ||
      c.d_min_triangle.size() != c.topology->triangles.size())
    throw InputError("d_min_vertex, d_min_edge and d_min_triangle need one entry a vertex, edge and triangle");
  return c;
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
    case Stage::closest_points: return ClosestPointsCase{to_points<2>(data.at("first")), to_points<2>(data.at("second"))};
    case Stage::rest_state: return to_rest_state_case(data);
    case Stage::block: return to_block_case(data);
    case Stage::initial_guess: return to_initial_guess_case(data);
    case Stage::bound: return to_bound_case(data);
    case Stage::sweep: return to_sweep_case(data);
    case Stage::step: return to_step_case(data);
    case Stage::activation: return ActivationCase{number(data.at("distance")), number(data.at("contact_radius")), number(data.at("stiffness"))};
    case Stage::truncate: return TruncateCase{to_point(data.at("previous")), to_point(data.at("position")), number(data.at("bound"))};
    case Stage::detect_vertex_facet:
    case Stage::detect_edge_edge: return to_mesh_case(data);
    default: return to_force_case(stage, data);
  }
}

/// OBJ text: vertices in order, then faces and lines with indices from 1. Empty where the case has no shape.
struct ToObj {
  std::string text;
  void point(const Vec3f& p) {
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, "v %.9g %.9g %.9g\n", double{p.x}, double{p.y}, double{p.z});
    text += buffer;
  }
  void operator()(const ClosestFaceCase& c) {
    point(c.point);
    for (const Vec3f& p : c.triangle) point(p);
    text += "p 1\nf 2 3 4\n";
  }
  void operator()(const ClosestPointsCase& c) {
    for (const auto& edge : {c.first, c.second})
      for (const Vec3f& p : edge) point(p);
    text += "l 1 2\nl 3 4\n";
  }
  void operator()(const MeshCase& c) {
    for (const Vec3f& p : c.positions) point(p);
    for (const Triangle& t : c.topology->triangles)
      text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
    for (std::size_t e = 0; e < c.topology->edges.size(); ++e)
      if (c.topology->edge_triangles[e].empty())
        text += "l " + std::to_string(c.topology->edges[e][0] + 1) + " " + std::to_string(c.topology->edges[e][1] + 1) + "\n";
  }
  void operator()(const SweepCase& c) { scene(*c.scene, c.previous); }
  void operator()(const StepCase& c) { scene(*c.scene, to_single(c.scene->mesh.positions)); }
  void scene(const Scene& scene, const std::vector<Vec3f>& positions) {
    for (const Vec3f& p : positions) point(p);
    for (const Triangle& t : scene.mesh.triangles)
      text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  template <class Other>
  void operator()(const Other&) {}
};

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::flush;
  if (!file) throw ResourceError(path.string() + ": cannot be written; check the folder and the space on its disk");
}

}  // namespace

std::filesystem::path save_case(const std::filesystem::path& folder, const TestCase& test, const std::string& message) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw ResourceError(folder.string() + ": cannot be created: " + error.message());
  const CaseName& name = test.name;
  const std::string stem =
      std::string(stage_name(name.stage)) + "." + name.generator + "." + std::to_string(name.seed) + "." + std::to_string(name.index);
  const Json json{{"format", case_format_version}, {"problem", print_problem(test.name)}, {"message", message}, {"data", std::visit(ToJson{}, test.data)}};
  const std::filesystem::path path = folder / (stem + ".json");
  write_text(path, json.dump(1) + "\n");
  ToObj obj;
  std::visit([&](const auto& data) { obj(data); }, test.data);
  if (!obj.text.empty()) write_text(folder / (stem + ".obj"), obj.text);
  return path;
}

TestCase load_case(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + ": cannot be read; give a file that `ogc compare` saved");
  try {
    const Json json = Json::parse(file);
    const int format = json.at("format").get<int>();
    if (format != case_format_version)
      throw InputError("format " + std::to_string(format) + " is not the one this program reads (" + std::to_string(case_format_version) + ")");
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
  std::ifstream file(path);
  if (!file) throw InputError(path.string() + ": cannot be read; give a file with one problem string a line");
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
