// Contact sets, distances and bounds of one mesh, by any of the engines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/problem/element_names.hpp"
#include "compare/problem/mesh.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "experiments/program/output.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

/// Who finds the contacts.
enum class Engine { exact, cpu, cuda };

/// What only the reference knows; empty for the other engines.
struct ExactGeometry {
  std::vector<reference::VertexKind> vertex_kind;     ///< by vertex
  std::vector<std::vector<compare::Index>> ipc, sdf;  ///< F_IPC (Eq. 3) and F_SDF (Eq. 4) by vertex, where asked for
};

/// What `ogc contacts` prints.
struct ContactReport {
  compare::Topology topology;                  ///< of the mesh
  std::vector<compare::Vec3f> positions;       ///< by vertex [m]
  float contact_radius = 0, query_radius = 0;  ///< r, r_q [m]
  compare::DetectVertexFacetOut vertex_facet;  ///< F_OGC and smallest distances
  compare::DetectEdgeEdgeOut edge_edge;        ///< E_OGC and smallest distances
  /// [m], one each contact: of the vertex and the owner; between the contact points
  std::vector<double> vertex_facet_distance, edge_edge_distance;
  std::vector<float> bound;  ///< b_v, Eq. 21 [m]
  std::optional<ExactGeometry> exact;
  reference::FilterCounts filters;  ///< predicates asked for all of this; all zero unless exact
};

/// Which sets an exact report has besides OGC's. Each looks at all pairs of vertices and triangles.
struct FurtherSets {
  bool ipc = false, sdf = false;  ///< F_IPC (Eq. 3), F_SDF (Eq. 4)
};

/// Throws compare::ResourceError where the engine is not available. The mesh must be valid.
ContactReport find_contacts(const compare::Mesh& mesh, Engine engine, float contact_radius, float query_radius,
                            float bound_relaxation, FurtherSets further = {});

/// Mean length of all edges [m].
double mean_edge_length(const compare::Mesh& mesh);

/// d_min² and b_v² of Eq. 21–26 as fractions [m²] (reference::ExactSquares), by primitive.
Json exact_squares(const ContactReport& report, float bound_relaxation);
/// Prints the report as the schema says, after the members of `head`, contact by contact: with their margins these may
/// be gigabytes. Margins of an exact report are found on the way; they can be left out.
void print_json(const Json& head, const ContactReport& report, bool with_margins);
/// The JSON Schema of `ogc contacts --json` (contacts.schema.json).
std::string contacts_schema();
/// `names`: what the mesh's elements are called.
std::string describe(const ContactReport& report, const compare::ElementNames& names);

}  // namespace ogc::experiments
