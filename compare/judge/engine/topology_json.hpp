// Writes and reads the mesh of a saved case in the form of a mesh file; reading builds adjacency again.
#pragma once

#include <memory>
#include <vector>

#include "compare/judge/engine/numbers_json.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// Writes vertex count, triangles, loose edges, and flags of vertices inside solids if there are any.
inline Json topology_to_json(const Topology& topology) {
  Json loose = Json::array();
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edge_triangles[e].empty()) loose.push_back(topology.edges[e]);
  Json json{{"vertex_count", topology.vertex_count}, {"triangles", topology.triangles}, {"loose_edges", loose}};
  if (!topology.off_surface.empty()) json["inside_solid"] = topology.off_surface;
  return json;
}

/// Reads a mesh. `vertices` is the number of vertices for which the file has entries. Throws InputError if the mesh has
/// another number of vertices (before memory is allocated for them) or if inside_solid has another number of entries.
/// Also throws the exceptions of the JSON library and of build_topology.
inline std::shared_ptr<const Topology> to_topology(const Json& json, std::size_t vertices) {
  if (json.at("vertex_count").get<std::int64_t>() != static_cast<std::int64_t>(vertices))
    throw InputError("a mesh of " + json.at("vertex_count").dump() + " vertices comes with entries for " +
                     std::to_string(vertices) + "; give one a vertex");
  const auto triangles = json.at("triangles").get<std::vector<Triangle>>();
  const auto loose = json.at("loose_edges").get<std::vector<Edge>>();
  auto topology = std::make_shared<Topology>(build_topology(json.at("vertex_count").get<Index>(), triangles, loose));
  if (json.contains("inside_solid")) topology->off_surface = json.at("inside_solid").get<std::vector<std::uint8_t>>();
  if (!topology->off_surface.empty() &&
      topology->off_surface.size() != static_cast<std::size_t>(topology->vertex_count))
    throw InputError("inside_solid needs one entry a vertex");
  return topology;
}

}  // namespace ogc::compare
