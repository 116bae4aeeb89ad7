// Computes the contact sets of the paper by plain definitions, to compare them with the detections and with each other.
// Every function visits all pairs.
#pragma once

#include <span>
#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Returns the contacts of F_OGC with d < r by Eq. 12, sorted. Tests all faces of triangles with DefinedBlocks, in
/// quadratic time.
std::vector<compare::VertexFacetContact> vertex_facet_by_definition(const compare::DetectIn& in);

/// Returns F_OGC by Algorithm 1 with the half-spaces of Eq. 8–10, over all pairs.
std::vector<compare::VertexFacetContact> vertex_facet_over_all_pairs(const compare::DetectIn& in);

/// Returns E_OGC by Eq. 17 (corrected: method.md §1.2, §1.3). Compares the distances of all pairs of features as exact
/// quotients, then tests the closest points with DefinedBlocks.
std::vector<compare::EdgeEdgeContact> edge_edge_by_definition(const compare::DetectIn& in);

/// Returns E_OGC by Algorithm 2 (corrected: method.md §1.2, §1.3), over all pairs. Uses the half-spaces of Eq. 14 and
/// 15.
std::vector<compare::EdgeEdgeContact> edge_edge_over_all_pairs(const compare::DetectIn& in);

/// Returns V_OGC(t) for each triangle t: the vertices of the contacts with faces that t owns, ascending. A vertex with
/// several of these contacts appears several times.
std::vector<std::vector<Index>> vertices_near_facets(const compare::Topology& topology,
                                                     std::span<const compare::VertexFacetContact> contacts);

/// Returns E_OGC(e): for each edge the indices of the contacts that have it as `first_edge` or `second_edge`.
std::vector<std::vector<std::size_t>> contacts_of_edges(const compare::Topology& topology,
                                                        std::span<const compare::EdgeEdgeContact> contacts);

/// Returns |F_OGC(v)| by vertex, the number of layers (§3.3).
std::vector<Index> layers(const compare::Topology& topology, std::span<const compare::VertexFacetContact> contacts);

/// Returns the depth r − d (Eq. 13) of each contact [m], within 1 ulp of double.
std::vector<double> penetration_depths(const Complex& mesh, std::span<const compare::VertexFacetContact> contacts,
                                       float contact_radius);

/// Returns F_IPC(v) (Eq. 3), ascending: the triangles that are nearer than r and do not contain v.
std::vector<Index> ipc_face_set(const Complex& mesh, Index vertex, float contact_radius);

/// Returns F_SDF (Eq. 4) of a point in space: the closest triangles if they are nearer than r. Several triangles may be
/// equally near (the printed argmin is then not unique). A triangle that contains the point counts, as printed: at a
/// vertex of the mesh the result is the vertex's own triangles.
std::vector<Index> sdf_face_set(const Complex& mesh, const Vec3f& x, float contact_radius);

}  // namespace ogc::reference
