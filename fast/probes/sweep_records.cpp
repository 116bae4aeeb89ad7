#include "fast/probes/sweep_records.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ogc::fast {
namespace {

/// Returns the vertices of a face as a detection records them: three numbers, −1 for a vertex that the face lacks.
std::array<int, 3> corners_of(const compare::Face& face, const compare::Topology& topology) {
  const auto i = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case compare::FaceKind::vertex: return {face.index, -1, -1};
    case compare::FaceKind::edge: return {topology.edges[i][0], topology.edges[i][1], -1};
    case compare::FaceKind::triangle: return topology.triangles[i];
  }
  __builtin_unreachable();
}

class IncidenceCounts {
 public:
  explicit IncidenceCounts(const std::vector<int>& places)
      : rows_{places.data(), static_cast<int>(places.size())}, counts_(static_cast<std::size_t>(rows_.count()), 0) {}
  void add(int vertex, bool edge_edge) {
    if (vertex >= 0) ++counts_[static_cast<std::size_t>(rows_(vertex, edge_edge))];
  }
  std::vector<int> offsets() const {
    std::vector<int> offsets{0};
    for (const int count : counts_) offsets.push_back(offsets.back() + count);
    return offsets;
  }

 private:
  RowNumbers rows_;
  std::vector<int> counts_;
};

}  // namespace

ContactRecords contact_records(const compare::SweepIn& in, const std::vector<int>& places) {
  ContactRecords records;
  IncidenceCounts counts(places);
  for (const compare::VertexFacetContact& contact : in.vertex_facet) {
    const auto corner = corners_of(contact.face, *in.topology);
    records.vertex_facet.push_back({contact.vertex, {corner[0], corner[1], corner[2]}});
    counts.add(contact.vertex, false);
    for (const int v : corner) counts.add(v, false);
  }
  for (const compare::EdgeEdgeContact& contact : in.edge_edge) {
    const auto p = corners_of(contact.first, *in.topology), q = corners_of(contact.second, *in.topology);
    records.edge_edge.push_back({{p[0], p[1]}, {q[0], q[1]}, contact.first_edge, contact.second_edge});
    for (std::size_t k = 0; k < 2; ++k) counts.add(p[k], true), counts.add(q[k], true);
  }
  records.offsets = counts.offsets();
  return records;
}

std::vector<std::vector<VolumeIncidence>> volume_rows(const compare::SweepIn& in, const RestState& rest,
                                                      const AskerRows& asked) {
  const auto body = [&](int v) { return static_cast<std::size_t>(rest.body[static_cast<std::size_t>(v)]); };
  std::vector<std::vector<VolumeIncidence>> of_vertex(in.old.size()), rows;
  for (const compare::VolumeContact& contact : in.volumes) {
    const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(contact.triangle)];
    const ContactMaterial material = rest.contact[body(contact.point) * in.scene->bodies.size() + body(corners[0])];
    VolumeIncidence incidence;
    for (std::size_t k = 0; k < 3; ++k) {
      incidence.corner[k] = corners[k];
      incidence.contact.weights[k] = contact.weights[k];
    }
    incidence.point = contact.point;
    incidence.contact.normal = {contact.direction.x, contact.direction.y, contact.direction.z};
    incidence.contact.stiffness = material.stiffness;
    incidence.contact.friction = material.friction;
    of_vertex[static_cast<std::size_t>(contact.point)].push_back(incidence);
  }
  for (const int v : asked.askers)
    rows.push_back(v < 0 ? std::vector<VolumeIncidence>{} : std::move(of_vertex[static_cast<std::size_t>(v)]));
  return rows;
}

Colouring colouring_of(std::span<const compare::Index> colour) {
  Colouring colouring;
  colouring.colour.assign(colour.begin(), colour.end());
  for (const int c : colouring.colour) colouring.count = std::max(colouring.count, c + 1);
  std::vector<std::vector<int>> classes(static_cast<std::size_t>(colouring.count));
  for (std::size_t v = 0; v < colouring.colour.size(); ++v) {
    if (colouring.colour[v] >= 0) classes[static_cast<std::size_t>(colouring.colour[v])].push_back(static_cast<int>(v));
  }
  for (const std::vector<int>& members : classes) {
    colouring.order.insert(colouring.order.end(), members.begin(), members.end());
    colouring.begin.push_back(static_cast<int>(colouring.order.size()));
  }
  return colouring;
}

}  // namespace ogc::fast
