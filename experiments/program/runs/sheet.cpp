#include "experiments/program/runs/sheet.hpp"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/runs/run_options.hpp"
#include "experiments/scenes/registry.hpp"

namespace ogc::experiments {

namespace {

namespace fs = std::filesystem;

template <class T>
std::string_view bytes_of(const std::vector<T>&& values) = delete;  // the bytes would not outlive them

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

void write_faces(const fs::path& sheet, const std::vector<compare::Triangle>& triangles,
                 const std::vector<compare::Edge>& edges) {
  compare::write_bytes(sheet / "triangles", bytes_of(triangles));
  compare::write_bytes(sheet / "edges", bytes_of(edges));
}

/// Returns whether all vertices of the body move as prescribed or not at all.
bool is_still(const compare::Body& body, const std::vector<compare::Index>& groups) {
  const auto first = groups.begin() + body.first_vertex;
  return std::all_of(first, first + body.vertex_count, [](compare::Index group) { return group >= 0; });
}

void write_scene_sheet(const fs::path& sheet, const compare::Scene& scene) {
  const std::vector<compare::Index> groups = compare::rigid_groups(scene);
  Json bodies = Json::array();
  for (const compare::Body& body : scene.bodies)
    bodies.push_back({{"name", body.name},
                      {"first_vertex", body.first_vertex},
                      {"vertex_count", body.vertex_count},
                      {"still", is_still(body, groups)}});
  write_faces(sheet, scene.mesh.triangles, scene.mesh.loose_edges);
  const std::vector<compare::Vec3f> positions = compare::to_single(scene.mesh.positions);
  compare::write_bytes(sheet / "positions", bytes_of(positions));
  const Json json{{"name", scene.name}, {"frames", 1}, {"radius", scene.settings.contact_radius}, {"bodies", bodies}};
  compare::write_bytes(sheet / "sheet.json", json.dump());
}

std::vector<compare::Edge> loose_edges(const compare::Topology& topology) {
  std::vector<compare::Edge> edges;
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edge_triangles[e].empty()) edges.push_back(topology.edges[e]);
  return edges;
}

void write_frames_sheet(const fs::path& sheet, AuditSource& source, const SheetRequest& request) {
  const std::string name = fs::path(request.source.paths.front()).stem().string();
  const std::size_t count = source.size(), every = static_cast<std::size_t>(request.every);
  Progress progress(0, static_cast<std::int64_t>(count), "frame read");
  std::shared_ptr<const compare::Topology> topology;
  std::ofstream positions(sheet / "positions", std::ios::binary);
  std::size_t frames = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const AuditedState state = source.next();
    if (topology && topology != state.topology)
      throw compare::InputError(state.name + ": has other faces than the frame before; show it alone");
    topology = state.topology;
    if (count > 1) progress.show(static_cast<std::int64_t>(i + 1), "");
    if ((count - 1 - i) % every != 0) continue;
    const std::vector<compare::Vec3f> single = compare::to_single(state.positions);
    const std::string_view bytes = bytes_of(single);
    positions.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    ++frames;
  }
  positions.close();
  if (!positions)
    throw compare::ResourceError((sheet / "positions").string() + ": can't be written; is the disk full?");
  write_faces(sheet, topology->triangles, loose_edges(*topology));
  const Json json{
      {"name", name},
      {"frames", frames},
      {"radius", request.radius > 0 ? Json(request.radius) : Json(nullptr)},
      {"bodies", {{{"name", name}, {"first_vertex", 0}, {"vertex_count", topology->vertex_count}, {"still", false}}}}};
  compare::write_bytes(sheet / "sheet.json", json.dump());
}

bool is_scene(const std::string& path) {
  const auto named = [&](const SceneInfo& info) { return info.name == path; };
  std::error_code ignored;
  return path.ends_with(".json") || (!fs::exists(path, ignored) && std::ranges::any_of(scenes(), named));
}

}  // namespace

void write_run_sheet(const fs::path& sheet, const fs::path& folder, const compare::Mesh& mesh) {
  write_faces(sheet, mesh.triangles, mesh.loose_edges);
  compare::write_bytes(sheet / "sheet.json", Json{{"run", fs::absolute(folder).string()}}.dump());
}

void write_sheet(const fs::path& sheet, const SheetRequest& request) {
  const std::string& first = request.source.paths.front();
  std::error_code ignored;
  if (request.source.paths.size() == 1 && is_scene(first)) {
    RunOptions options;
    options.scene = first;
    options.scale = request.scale;
    return write_scene_sheet(sheet, request_of(options, {}).scene);
  }
  if (!request.scale.empty()) log_line("ogc: " + first + ": has one size; --scale belongs to the built-in scenes");
  if (request.source.paths.size() == 1 && fs::is_regular_file(fs::path(first) / "run.json", ignored))
    return write_run_sheet(sheet, first, compare::RunReader(first).scene().mesh);
  write_frames_sheet(sheet, *open_audit(request.source), request);
}

}  // namespace ogc::experiments
