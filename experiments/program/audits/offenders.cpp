#include "experiments/program/audits/offenders.hpp"

#include <algorithm>
#include <map>

#include "compare/files/bytes.hpp"
#include "compare/record/vtp.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

namespace {

using compare::at, compare::Index;

void sort_once(std::vector<Index>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Returns the vertices of all offenders, ascending.
std::vector<Index> corners_of(const Offenders& offenders, const compare::Topology& topology) {
  std::vector<Index> corners = offenders.vertices;
  for (const Index e : offenders.edges)
    corners.insert(corners.end(), topology.edges[at(e)].begin(), topology.edges[at(e)].end());
  for (const Index t : offenders.triangles)
    corners.insert(corners.end(), topology.triangles[at(t)].begin(), topology.triangles[at(t)].end());
  sort_once(corners);
  return corners;
}

std::string point_text(const compare::Vec3& p) {
  return "(" + number(p.x, 4) + ", " + number(p.y, 4) + ", " + number(p.z, 4) + ")";
}

/// Makes the name of a file from a state's name, such as "frame 3" or "out/frame_12.obj".
std::string file_name(const std::string& name) {
  std::string stem = std::filesystem::path(name).filename().string();
  if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
  std::ranges::replace_if(
      stem, [](char c) { return c == ' ' || c == '/' || c == '\\' || c == ':'; }, '_');
  return stem;
}

}  // namespace

Offenders offenders_of(const compare::AuditResult& result, const compare::Topology& topology) {
  Offenders found;
  if (!result.intersections.empty()) found.first = result.intersections.front();
  for (const compare::Intersection& pair : result.intersections) {
    const auto add_triangles = [&](std::span<const Index> around) {
      found.triangles.insert(found.triangles.end(), around.begin(), around.end());
    };
    if (pair.kind == compare::IntersectionKind::edge_edge) {
      for (const Index e : {pair.first, pair.second}) {
        found.edges.push_back(e);
        add_triangles(topology.edge_triangles[at(e)]);
      }
      continue;
    }
    const bool is_edge = pair.kind == compare::IntersectionKind::edge_triangle;
    (is_edge ? found.edges : found.vertices).push_back(pair.first);
    found.triangles.push_back(pair.second);
    add_triangles(is_edge ? topology.edge_triangles[at(pair.first)] : topology.vertex_triangles[at(pair.first)]);
  }
  for (auto* numbers : {&found.vertices, &found.edges, &found.triangles}) sort_once(*numbers);
  return found;
}

std::string region_of(const Offenders& offenders, const compare::Topology& topology,
                      const std::vector<compare::Vec3>& positions) {
  const std::vector<Index> corners = corners_of(offenders, topology);
  if (corners.empty()) return "nowhere";
  compare::Vec3 low = positions[at(corners.front())], high = low;
  for (const Index v : corners) {
    const compare::Vec3& p = positions[at(v)];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return "between " + point_text(low) + " and " + point_text(high) + " m";
}

std::string offenders_vtp(const compare::AuditResult& result, const compare::Topology& topology,
                          const std::vector<compare::Vec3>& positions) {
  const Offenders offenders = offenders_of(result, topology);
  compare::LabelledMesh part;
  part.vertex_numbers = corners_of(offenders, topology);
  std::map<Index, Index> new_number;
  for (const Index v : part.vertex_numbers) {
    new_number[v] = static_cast<Index>(part.mesh.positions.size());
    part.mesh.positions.push_back(positions[at(v)]);
  }
  std::map<Index, Index> of_edge, of_triangle;
  for (const compare::Intersection& pair : result.intersections) {
    if (pair.kind != compare::IntersectionKind::vertex_triangle) ++of_edge[pair.first];
    ++(pair.kind == compare::IntersectionKind::edge_edge ? of_edge : of_triangle)[pair.second];
  }
  for (const Index e : offenders.edges) {
    const compare::Edge& edge = topology.edges[at(e)];
    part.mesh.loose_edges.push_back({new_number[edge[0]], new_number[edge[1]]});
    part.cell_numbers.push_back(e);
    part.cell_counts.push_back(of_edge[e]);
  }
  for (const Index t : offenders.triangles) {
    const compare::Triangle& corners = topology.triangles[at(t)];
    part.mesh.triangles.push_back({new_number[corners[0]], new_number[corners[1]], new_number[corners[2]]});
    part.cell_numbers.push_back(t);
    part.cell_counts.push_back(of_triangle[t]);
  }
  return compare::vtp_bytes(part);
}

std::string show_offenders(const std::filesystem::path& folder, const std::string& name,
                           const compare::AuditResult& result, const compare::Topology& topology,
                           const std::vector<compare::Vec3>& positions) {
  const Offenders offenders = offenders_of(result, topology);
  const std::string vtp = (folder / file_name(name)).string() + ".vtp";
  compare::write_bytes(vtp, offenders_vtp(result, topology, positions));
  const bool only_curves = offenders.triangles.empty();
  return name + ": " +
         counted((only_curves ? offenders.edges : offenders.triangles).size(), only_curves ? "edge" : "triangle") +
         " " + region_of(offenders, topology, positions) + ": " + vtp;
}

}  // namespace ogc::experiments
