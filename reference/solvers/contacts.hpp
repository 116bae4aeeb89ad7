// What solvers ask about contacts as they were detected: their vertices, in the order of the stages contact_force and
// friction_force, and their materials.
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

/// All kinds of contacts of one detection.
struct ContactSets {
  std::vector<compare::VertexFacetContact> vertex_facet;
  std::vector<compare::EdgeEdgeContact> edge_edge;
  std::vector<compare::VolumeContact> volumes{};  ///< with volumes: as StepEvent has them
  std::vector<compare::Index> unresolved{};       ///< sheets without any way, likewise
};

/// Vertices of a face, in the order of the mesh; those that it lacks are −1.
std::array<compare::Index, 3> vertices_of(const compare::Topology& topology, const compare::Face& face);

/// A contact as its stages ask for it.
struct ContactStencil {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};  ///< first side, then second; those that it lacks are −1
  std::array<compare::Index, 2> edge{-1, -1};            ///< of two interiors, whose energy is mollified
};
/// The stencil of a vertex and a face.
ContactStencil stencil_of(const compare::Topology& topology, const compare::VertexFacetContact& contact);
/// The stencil of two edges, or of the faces of theirs that meet.
ContactStencil stencil_of(const compare::Topology& topology, const compare::EdgeEdgeContact& contact);

/// Squared rest lengths of two edges that meet [m²]; 0 of one without triangles. Zeros for contacts with a vertex.
std::array<float, 2> mollified_rest_squared(const compare::Topology& topology, const compare::RestStateOut& rest,
                                            const ContactStencil& stencil);

/// Of the two bodies that meet. `body`: by vertex.
const compare::MeetingMaterial& material_of(const compare::RestStateOut& rest, std::size_t body_count,
                                            std::span<const compare::Index> body, const ContactStencil& stencil);

}  // namespace ogc::reference
