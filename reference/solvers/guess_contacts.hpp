// Prepares the contacts of a detection for the guess loop: vertex–facet contacts first, then edge–edge contacts.
#pragma once

#include <span>
#include <vector>

#include "reference/solvers/contacts.hpp"
#include "reference/solvers/guess/held_moves.hpp"

namespace ogc::reference {

/// Returns whether the mesh has this face. A contestant's answer may contain faces that the mesh lacks.
inline bool is_there(const compare::Topology& topology, const compare::Face& face) {
  if (face.index < 0) return false;
  const auto i = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case compare::FaceKind::vertex: return face.index < topology.vertex_count;
    case compare::FaceKind::edge: return i < topology.edges.size();
    case compare::FaceKind::triangle: return i < topology.triangles.size();
  }
  return false;
}

/// Converts detected contacts. `rest` has the friction of each pair of bodies. The contacts may come from any
/// contestant's answer; contacts with faces that the mesh lacks are left out.
inline std::vector<GuessContact> guess_contacts(const compare::Scene& scene, const compare::Topology& topology,
                                                const compare::RestStateOut& rest,
                                                std::span<const compare::VertexFacetContact> vertex_facet,
                                                std::span<const compare::EdgeEdgeContact> edge_edge) {
  const std::vector<compare::Index> body = compare::body_of_vertex(scene);
  std::vector<GuessContact> all;
  const auto add = [&](const ContactStencil& stencil) {
    const double friction = double{material_of(rest, scene.bodies.size(), body, stencil).friction};
    all.push_back({stencil.sides, stencil.vertex, friction});
  };
  for (const compare::VertexFacetContact& contact : vertex_facet)
    if (is_there(topology, {compare::FaceKind::vertex, contact.vertex}) && is_there(topology, contact.face))
      add(stencil_of(topology, contact));
  for (const compare::EdgeEdgeContact& contact : edge_edge)
    if (is_there(topology, contact.first) && is_there(topology, contact.second)) add(stencil_of(topology, contact));
  return all;
}

}  // namespace ogc::reference
