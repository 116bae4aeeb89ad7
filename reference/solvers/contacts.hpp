// Prepares detected contacts for solvers: their vertices, in the order of the stages contact_force and friction_force,
// and their materials.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "compare/stages/contact_force.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/rest_state.hpp"
#include "compare/stages/volume_depth.hpp"

namespace ogc::reference {

/// All contacts of one detection: between vertices and facets, between edges, and with volumes.
struct ContactSets {
  std::vector<compare::VertexFacetContact> vertex_facet;
  std::vector<compare::EdgeEdgeContact> edge_edge;
  std::vector<compare::VolumeContact> volumes{};  ///< contacts with volumes, in the order of StepEvent
  std::vector<compare::Index> unresolved{};       ///< the point of each sheet without a way to the boundary, ascending
};

/// Returns the vertices of a face in the order of the mesh; unused entries are −1.
std::array<compare::Index, 3> vertices_of(const compare::Topology& topology, const compare::Face& face);

/// A contact's vertices and edges, in the order of the force stages.
struct ContactStencil {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};  ///< first side, then second; unused entries are −1
  /// both edges if each side is the interior of an edge; the energy is then mollified
  std::array<compare::Index, 2> edge{-1, -1};
};
/// Returns the stencil of a contact between a vertex and a facet.
ContactStencil stencil_of(const compare::Topology& topology, const compare::VertexFacetContact& contact);
/// Returns the stencil of a contact between two edges; its sides may be ends of the edges.
ContactStencil stencil_of(const compare::Topology& topology, const compare::EdgeEdgeContact& contact);

/// Returns the squared rest length ‖ē‖² of each edge of an edge–edge contact [m²], which the mollifier needs. Returns 0
/// for an edge without triangles, and zeros for all other contacts.
std::array<float, 2> mollified_rest_squared(const compare::Topology& topology, const compare::RestStateOut& rest,
                                            const ContactStencil& stencil);

/// Returns the contact stiffness and friction of the contact's two bodies. `body`: by vertex.
const compare::MeetingMaterial& material_of(const compare::RestStateOut& rest, std::size_t body_count,
                                            std::span<const compare::Index> body, const ContactStencil& stencil);

}  // namespace ogc::reference
