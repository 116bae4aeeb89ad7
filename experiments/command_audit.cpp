// `ogc audit`: does anything intersect? Exactly, for a mesh of any origin or for each frame of a run.
#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "compare/files/mesh_files.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/auditor.hpp"
#include "experiments/commands.hpp"
#include "experiments/interrupt.hpp"
#include "experiments/output.hpp"
#include "experiments/progress.hpp"

namespace ogc::experiments {

namespace {

using compare::SmallestDistances;

struct State {
  std::string name;  ///< "step 12", or the mesh's file
  Json json;
  std::string text;
  std::size_t count = 0;
  SmallestDistances distances;
};

Json to_json(const SmallestDistances& distances, const compare::Topology& topology) {
  Json json{{"vertex_triangle", nullptr}, {"edge_edge", nullptr}};
  if (distances.vertex >= 0) {
    json["vertex_triangle"] = {{"distance", distances.vertex_triangle}, {"vertex", distances.vertex}, {"triangle", distances.triangle},
                               {"triangle_vertices", topology.triangles[static_cast<std::size_t>(distances.triangle)]}};
  }
  if (distances.edge >= 0) {
    const auto vertices = [&](compare::Index e) { return topology.edges[static_cast<std::size_t>(e)]; };
    json["edge_edge"] = {{"distance", distances.edge_edge}, {"edge", distances.edge}, {"edge_vertices", vertices(distances.edge)},
                         {"other_edge", distances.other_edge}, {"other_edge_vertices", vertices(distances.other_edge)}};
  }
  return json;
}

State state_of(const std::string& name, const compare::AuditResult& result, const SmallestDistances& distances, const compare::Topology& topology,
               const std::string& text) {
  State state{name, {{"state", name}, {"count", result.count}, {"intersections", Json::array()}}, text, result.count, distances};
  state.json["smallest_distances"] = to_json(distances, topology);
  for (const compare::Intersection& pair : result.intersections) {
    const bool is_edge = pair.kind == compare::IntersectionKind::edge_triangle;
    const auto first = static_cast<std::size_t>(pair.first);
    Json entry{{"kind", is_edge ? "edge_triangle" : "vertex_triangle"}};
    if (is_edge) {
      entry["edge"] = pair.first;
      entry["edge_vertices"] = topology.edges[first];
    } else {
      entry["vertex"] = pair.first;
    }
    entry["triangle"] = pair.second;
    entry["triangle_vertices"] = topology.triangles[static_cast<std::size_t>(pair.second)];
    state.json["intersections"].push_back(entry);
  }
  return state;
}

compare::Topology topology_of(const compare::Mesh& mesh) {
  return compare::build_topology(static_cast<compare::Index>(mesh.positions.size()), mesh.triangles, mesh.loose_edges);
}

std::vector<State> audit_mesh(const std::string& file) {
  const compare::Mesh mesh = compare::read_mesh(file);
  const std::string problems = compare::describe(compare::validate(mesh));
  if (!problems.empty()) throw compare::InputError(file + ":\n" + problems);
  const compare::Topology topology = topology_of(mesh);
  const compare::AuditResult result = compare::audit(topology, mesh.positions);
  return {state_of(file, result, compare::smallest_distances(topology, mesh.positions), topology, compare::describe(result, topology))};
}

std::vector<State> audit_run(const std::string& folder) {
  const compare::RunReader reader(folder);
  const compare::Topology topology = topology_of(reader.scene().mesh);
  const StateJudge judge(reader.scene());
  const auto count = static_cast<std::int64_t>(reader.frame_count());
  if (count == 0) throw compare::InputError(folder + ": holds no frame yet; there is nothing to audit");
  catch_interrupts();
  Progress progress(0, count, "frame");
  std::vector<State> states;
  for (std::int64_t i = 0; i < count && !interrupted(); ++i) {
    const compare::Frame frame = reader.frame(static_cast<std::size_t>(i));
    const compare::AuditResult result = judge.audit(frame.positions);
    states.push_back(state_of("step " + std::to_string(frame.step), result, judge.smallest_distances(frame.positions), topology, judge.describe(result)));
    progress.show(i + 1, counted(result.count, "intersection"));
  }
  return states;
}

std::string list(std::span<const compare::Index> vertices) {
  std::string text;
  for (const compare::Index v : vertices) text += (text.empty() ? " (vertices " : ", ") + std::to_string(v);
  return text + ")";
}

/// The smallest distances of all states, in words; of equal ones the first state's.
std::string describe_distances(const std::vector<State>& states) {
  const auto in_state = [&](const State& state) { return states.size() == 1 ? "" : ", " + state.name; };
  const auto vertices = [](const Json& pair, const char* key) { return list(pair.at(key).get<std::vector<compare::Index>>()); };
  const auto& facet = *std::ranges::min_element(states, {}, [](const State& state) { return state.distances.vertex_triangle; });
  const auto& edges = *std::ranges::min_element(states, {}, [](const State& state) { return state.distances.edge_edge; });
  std::string text = "smallest distance of a vertex to a triangle without it: ";
  if (facet.distances.vertex < 0) {
    text += "there is no such pair\n";
  } else {
    const Json& pair = facet.json.at("smallest_distances").at("vertex_triangle");
    text += number(facet.distances.vertex_triangle, 9) + " m, vertex " + std::to_string(facet.distances.vertex) + " and triangle " +
            std::to_string(facet.distances.triangle) + vertices(pair, "triangle_vertices") + in_state(facet) + "\n";
  }
  text += "smallest distance of two edges without a common vertex: ";
  if (edges.distances.edge < 0) return text + "there is no such pair\n";
  const Json& pair = edges.json.at("smallest_distances").at("edge_edge");
  return text + number(edges.distances.edge_edge, 9) + " m, edge " + std::to_string(edges.distances.edge) + vertices(pair, "edge_vertices") + " and edge " +
         std::to_string(edges.distances.other_edge) + vertices(pair, "other_edge_vertices") + in_state(edges) + "\n";
}

int run(const std::string& path, const CommandContext& context) {
  const bool is_run = std::filesystem::is_directory(path);
  const std::vector<State> states = is_run ? audit_run(path) : audit_mesh(path);
  const std::string left_out = is_run ? left_out_of_audits(compare::RunReader(path).scene()) : "";
  std::size_t total = 0;
  std::string text;
  Json json{{"audited", path}, {"states", Json::array()}};
  for (const State& state : states) {
    total += state.count;
    json["states"].push_back(state.json);
    if (state.count > 0) text += state.name + ": " + counted(state.count, "intersection") + "\n" + state.text + "\n";
  }
  json["intersections"] = total;
  json["clean"] = total == 0;
  json["complete"] = !interrupted();
  if (!left_out.empty()) json["left_out"] = left_out;
  if (context.json) {
    print_result(json);
  } else {
    print_result(text + counted(states.size(), "state") + " audited exactly, " + counted(total, "intersection") +
                 (interrupted() ? "; interrupted, the rest was not looked at" : "") + "\n" +
                 (left_out.empty() ? "" : "left out: " + left_out + "\n") + (states.empty() ? "" : describe_distances(states)));
  }
  if (total > 0) return exit_check_failed;
  return interrupted() ? exit_interrupted : static_cast<int>(exit_success);
}

}  // namespace

void add_audit_command(CLI::App& app, CommandContext& context) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("audit", "Exact self-intersection audit of a mesh, or of each frame of a run");
  command->add_option("MESH|RUN", *path, "An .obj or .ply file, or a run folder")->required();
  command->add_flag("--json", context.json, "Print the result as JSON on standard output");
  command->footer("An edge that meets a triangle with which it shares no vertex is an intersection, and so is a vertex on a triangle without it; touching\n"
                  "counts. No rounding decides. In a run, pairs inside one fixed or prescribed body, and the scene's excluded pairs, are left out. Exit status\n"
                  "1: there is one.\n"
                  "The smallest distances of a vertex to a triangle without it, and of two edges without a common vertex, are found exactly too, and\n"
                  "rounded down; of pairs equally near the one with the lowest numbers is named.\n\n"
                  "Examples:\n"
                  "  ogc audit shirt.obj\n"
                  "  ogc audit runs/twist-small-20250801-120000");
  command->callback([path, &context] { context.status = run(*path, context); });
}

}  // namespace ogc::experiments
