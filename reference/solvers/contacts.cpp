#include "reference/solvers/contacts.hpp"

namespace ogc::reference {

using compare::ContactSides;
using compare::Index;

std::array<Index, 3> vertices_of(const compare::Topology& topology, const compare::Face& face) {
  const auto i = static_cast<std::size_t>(face.index);
  if (face.kind == compare::FaceKind::vertex) return {face.index, -1, -1};
  if (face.kind == compare::FaceKind::edge) return {topology.edges[i][0], topology.edges[i][1], -1};
  return topology.triangles[i];
}

ContactStencil stencil_of(const compare::Topology& topology, const compare::VertexFacetContact& contact) {
  const auto facet = vertices_of(topology, contact.face);
  constexpr std::array sides{ContactSides::point_point, ContactSides::point_edge, ContactSides::point_triangle};
  return {sides[static_cast<std::size_t>(contact.face.kind)], {contact.vertex, facet[0], facet[1], facet[2]}, {-1, -1}};
}

/// Expects first < second. Vertices come before edges in this order, so `first` is an edge only if `second` is one.
ContactStencil stencil_of(const compare::Topology& topology, const compare::EdgeEdgeContact& contact) {
  const auto p = vertices_of(topology, contact.first), q = vertices_of(topology, contact.second);
  if (p[1] >= 0)
    return {ContactSides::edge_edge, {p[0], p[1], q[0], q[1]}, {contact.first.index, contact.second.index}};
  return {q[1] >= 0 ? ContactSides::point_edge : ContactSides::point_point, {p[0], q[0], q[1], -1}, {-1, -1}};
}

std::array<float, 2> mollified_rest_squared(const compare::Topology& topology, const compare::RestStateOut& rest,
                                            const ContactStencil& stencil) {
  if (stencil.edge[0] < 0) return {};
  const auto squared = [&](Index e) {
    const auto i = static_cast<std::size_t>(e);
    return topology.edge_triangles[i].empty() ? 0 : rest.edge_length_squared[i];
  };
  return {squared(stencil.edge[0]), squared(stencil.edge[1])};
}

const compare::MeetingMaterial& material_of(const compare::RestStateOut& rest, std::size_t body_count,
                                            std::span<const Index> body, const ContactStencil& stencil) {
  const auto body_at = [&](std::size_t place) {
    return static_cast<std::size_t>(body[static_cast<std::size_t>(stencil.vertex[place])]);
  };
  return rest.meetings[body_at(0) * body_count + body_at(stencil.sides == ContactSides::edge_edge ? 2 : 1)];
}

}  // namespace ogc::reference
