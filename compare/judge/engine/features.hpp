// Names features for messages and explanations, which would be unclear with bare numbers.
#pragma once

#include <string>

#include "compare/problem/mesh.hpp"
#include "compare/stages/block.hpp"
#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "compare/stages/plane.hpp"

namespace ogc::compare {

// Each function also names a feature that does not exist in the mesh, because an answer may contain one.

/// Returns "vertex 2 of the triangle", "edge (0,1) of the triangle", "the interior of the triangle".
std::string feature_name(TriangleFeature feature);
/// Returns "end 0 of the first edge", "the interior of the second edge"; `which` is "first" or "second".
std::string feature_name(EdgeFeature feature, const std::string& which);
/// Returns "vertex 2", "edge 5 (vertices 1, 4)", "triangle 3 (vertices 0, 1, 4)".
std::string face_name(const Face& face, const Topology& topology);
/// Returns "vertex 7 and edge 5 (vertices 1, 4), owner triangle 3".
std::string contact_name(const VertexFacetContact& contact, const Topology& topology);
/// Returns "vertex 2 and edge 5 (vertices 1, 4), of edges 0 and 5".
std::string contact_name(const EdgeEdgeContact& contact, const Topology& topology);
/// Returns "vertex 7 and triangle 3 (vertices 0, 1, 4)", "edge 2 (vertices 0, 3) and edge 5 (vertices 1, 4)".
std::string pair_name(const PrimitivePair& pair, const Topology& topology);
/// Returns "vertex 7 in the block of triangle 3 (vertices 0, 1, 4)".
std::string question_name(const BlockQuestion& question, const Topology& topology);

}  // namespace ogc::compare
