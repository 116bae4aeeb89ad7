// Finds contact sets, distances and bounds of one mesh with a selected engine, and prints them.
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

/// Selects the implementation that finds the contacts.
enum class Engine { exact, cpu, cuda };

/// Holds results that only the reference computes.
struct ExactGeometry {
  std::vector<reference::VertexKind> vertex_kind;     ///< by vertex
  std::vector<std::vector<compare::Index>> ipc, sdf;  ///< F_IPC (Eq. 3) and F_SDF (Eq. 4) by vertex, if requested
};

/// Holds all data that `ogc contacts` prints.
struct ContactReport {
  compare::Topology topology;
  std::vector<compare::Vec3f> positions;       ///< by vertex [m]
  float contact_radius = 0, query_radius = 0;  ///< r, r_q [m]
  compare::DetectVertexFacetOut vertex_facet;  ///< F_OGC and smallest distances
  compare::DetectEdgeEdgeOut edge_edge;        ///< E_OGC and smallest distances
  /// Distance of each contact [m]: from the vertex to the owner, or between the two contact points.
  std::vector<double> vertex_facet_distance, edge_edge_distance;
  std::vector<float> bound;  ///< b_v, Eq. 21 [m]
  std::optional<ExactGeometry> exact;
  /// number of calls of each predicate for this report; all zero unless the engine is exact
  reference::FilterCounts filters;
};

/// Selects contact sets that an exact report has besides OGC's. Each of them tests all pairs of vertices and triangles.
struct FurtherSets {
  bool ipc = false, sdf = false;  ///< F_IPC (Eq. 3), F_SDF (Eq. 4)
};

/// Returns the report of a valid mesh. Throws compare::ResourceError if the engine is not available.
ContactReport find_contacts(const compare::Mesh& mesh, Engine engine, float contact_radius, float query_radius,
                            float bounds_relaxation, FurtherSets further = {});

/// Returns the mean length of all edges [m].
double mean_edge_length(const compare::Mesh& mesh);

/// Returns d_min² and b_v² of Eq. 21–26 as exact fractions [m²], by primitive (reference::ExactSquares).
Json exact_squares(const ContactReport& report, float bounds_relaxation);
/// Prints the members of `head` and then the report, as contacts.schema.json describes. Contacts are printed one by
/// one, because they may take gigabytes. The margins of an exact report are computed during printing; without
/// `with_margins` they are left out.
void print_json(const Json& head, const ContactReport& report, bool with_margins);
/// Returns the JSON Schema of `ogc contacts --json` (contacts.schema.json).
std::string contacts_schema();
/// Returns the report as text. `names`: names of the mesh's elements.
std::string describe(const ContactReport& report, const compare::ElementNames& names);

}  // namespace ogc::experiments
