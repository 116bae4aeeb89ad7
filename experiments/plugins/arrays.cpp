#include "experiments/plugins/arrays.hpp"

namespace ogc::experiments {

using namespace ogc::compare;

namespace {

/// Returns the face that the plug-in named. Throws compare::ContestantFailure for an unknown kind.
Face face(std::int32_t kind, std::int32_t index) {
  if (kind < 0 || kind > 2)
    throw ContestantFailure("a contact names a face of kind " + std::to_string(kind) +
                            "; known: 0 vertex, 1 edge, 2 triangle");
  return {static_cast<FaceKind>(kind), index};
}

}  // namespace

QuestionSizes sizes_of(std::size_t cases) {
  QuestionSizes sizes;
  sizes.cases = static_cast<std::int64_t>(cases);
  return sizes;
}

QuestionSizes sizes_of(const Topology& topology) {
  return {0, topology.vertex_count, static_cast<std::int32_t>(topology.edges.size()),
          static_cast<std::int32_t>(topology.triangles.size())};
}

std::vector<Bytes> inputs_of(const Topology& topology) {
  std::vector<Bytes> inputs{bytes_of(topology.edges), bytes_of(topology.triangles), bytes_of(topology.triangle_edges)};
  for (const CompressedRows* rows : {&topology.vertex_edges, &topology.vertex_triangles, &topology.vertex_neighbours,
                                     &topology.edge_triangles, &topology.edge_opposite}) {
    inputs.push_back(bytes_of(rows->offsets));
    inputs.push_back(bytes_of(rows->items));
  }
  return inputs;
}

std::vector<std::uint8_t> inside_solid(const Topology& topology) {
  std::vector<std::uint8_t> inside = topology.off_surface;
  inside.resize(static_cast<std::size_t>(topology.vertex_count));
  return inside;
}

CompressedRows rows_by_vertex(const CompressedRows* partners, std::size_t count) {
  if (partners != nullptr) return *partners;
  CompressedRows none;
  none.offsets.assign(count + 1, 0);
  return none;
}

VertexFacetContact contact_of(const ogc_vertex_facet_contact& c) { return {c.vertex, face(c.kind, c.face), c.owner}; }

VolumeContact contact_of(const ogc_volume_contact& c, const ogc_volume_numbers& numbers) {
  const auto& [weights, n, depth] = numbers;
  VolumeContact contact;
  contact.point = c.point, contact.inside = c.inside != 0 ? 1 : 0, contact.triangle = c.triangle;
  contact.face = face(c.kind, c.face);
  std::copy(weights, weights + 3, contact.weights.begin());
  contact.direction = {n.x, n.y, n.z};
  contact.depth = depth;
  return contact;
}

EdgeEdgeContact contact_of(const ogc_edge_edge_contact& c) {
  return {face(c.first_kind, c.first_face), face(c.second_kind, c.second_face), c.first_edge, c.second_edge};
}

}  // namespace ogc::experiments
