// Contact sets, distances and bounds of one mesh, by any of the engines.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "experiments/output.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

enum class Engine { exact, cpu, cuda };

struct ContactReport {
  compare::Topology topology;
  float contact_radius = 0, query_radius = 0;  ///< r, r_q [m]
  compare::DetectVertexFacetOut vertex_facet;
  compare::DetectEdgeEdgeOut edge_edge;
  std::vector<double> vertex_facet_distance, edge_edge_distance;  ///< [m], one each contact: of the vertex and the owner; between the contact points
  std::vector<float> bound;                                       ///< b_v, Eq. 21 [m]
  std::vector<double> vertex_facet_margin;  ///< one each contact: the smallest distance to a boundary of the face's block [m]; empty unless exact
  std::vector<const char*> vertex_kind;     ///< "convex", "mixed", "saddle" (Fig. 5) by vertex; empty unless exact
  reference::FilterCounts filters;          ///< predicates asked for all of this; all zero unless exact
};

/// Throws compare::ResourceError where the engine is not available. The mesh must be valid.
ContactReport find_contacts(const compare::Mesh& mesh, Engine engine, float contact_radius, float query_radius, float bound_relaxation);

/// Mean length of all edges [m].
double mean_edge_length(const compare::Mesh& mesh);

Json to_json(const ContactReport& report);

/// d_min² and b_v² of Eq. 21–26 as fractions [m²] (reference::ExactSquares), by primitive, for the mesh that the report is about.
Json exact_squares(const ContactReport& report, const compare::Mesh& mesh, float bound_relaxation);
std::string describe(const ContactReport& report);

}  // namespace ogc::experiments
