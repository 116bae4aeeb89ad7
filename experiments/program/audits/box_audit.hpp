// Audits a large state in boxes: in each box the contact sets that the fast path found in the whole state are compared
// with the exact ones, and intersections are sought. So lists that lost a contact are noticed in states whose contacts
// the reference cannot find within an hour.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compare/problem/exclusions.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"

namespace ogc::experiments {

/// Selects the boxes of an audit. Boxes are cells of a grid that begins at the least coordinates.
struct BoxRequest {
  std::size_t count = 0;   ///< number of boxes; half of them, rounded down, are the cells with most contacts
  std::uint64_t seed = 0;  ///< seed of the other half, drawn from all other cells that contain a vertex
  double side = 0;         ///< side of a cell [m]; 0: four mean edges
};

/// The contacts of the whole state, in canonical order.
struct FoundContacts {
  std::vector<compare::VertexFacetContact> vertex_facet;
  std::vector<compare::EdgeEdgeContact> edge_edge;
};

/// The findings of an audit in boxes, added up over boxes.
struct BoxFindings {
  std::size_t cells = 0, boxes = 0, densest = 0;  ///< cells that contain a vertex; boxes; those with most contacts
  double side = 0;                                ///< [m]
  std::size_t most_contacts = 0, least_of_densest = 0;  ///< contacts of the densest box and of the last of these
  std::size_t vertices = 0, triangles = 0;              ///< whose surroundings are complete in their box
  std::size_t pairs_tested = 0, intersections = 0;      ///< as in compare::AuditResult
  std::size_t contacts = 0;                             ///< exact contacts among these vertices
  std::size_t missing = 0, extra = 0;  ///< contacts that are only in the exact sets, only in the found ones
  std::size_t grey = 0;                ///< such differences that method.md §3 accepts; not counted in the two numbers
  std::string first{};                 ///< the first difference or intersection in words; empty if there is none
};

/// Audits boxes of a state. `found`: contacts of the whole state for this radius [m]. A box's vertices are those in its
/// cell and the corners of triangles whose boxes meet it. A contact is compared if all vertices of its two faces are
/// among them; their triangles and loose edges determine it. Throws compare::InputError for a state with vertices off
/// the surface.
BoxFindings audit_boxes(const compare::Topology& topology, std::span<const compare::Vec3f> positions,
                        const compare::ExclusionView& exclusions, const FoundContacts& found, float contact_radius,
                        const BoxRequest& request);

}  // namespace ogc::experiments
