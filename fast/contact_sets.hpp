// Finds contact sets, smallest distances and conservative bounds for a solver outside of this project: it gives
// positions and gets everything that Offset Geometric Contact needs for one step. Lists grow by themselves; no contact
// is ever dropped; the same positions give the same bits.
//
//   ogc::fast::ContactFinder finder(vertex_count, triangles, loose_edges);
//   const ogc::fast::ContactSets sets = finder.find(positions, {.contact_radius = 0.005f, .query_radius = 0.01f});
//   // then: contact energy on `sets`, and no vertex farther than sets.bound[v] from its position until the next call
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "compare/problem/exclusions.hpp"
#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "fast/contact_view.hpp"
#include "fast/contestant.hpp"

namespace ogc::fast {

/// Parameters of a detection [m].
struct ContactQuery {
  float contact_radius = 0;         ///< r > 0
  float query_radius = 0;           ///< r_q ≥ r: nothing is searched beyond it, so no bound exceeds γ_p r_q
  float bounds_relaxation = 0.45F;  ///< γ_p of Eq. 21, in (0, 0.5)
};

/// Holds the results on the host, in canonical order (compare/stages); distances and bounds are never above the exact
/// ones.
struct ContactSets {
  std::vector<compare::VertexFacetContact> vertex_facet;        ///< F_OGC(v) for all v
  std::vector<compare::EdgeEdgeContact> edge_edge;              ///< E_OGC; edge numbers: ContactFinder::topology()
  std::vector<float> d_min_vertex, d_min_edge, d_min_triangle;  ///< Eq. 22, 24, 26 [m], at most r_q
  std::vector<float> bound;                                     ///< b_v, Eq. 21 [m]
  friend bool operator==(const ContactSets&, const ContactSets&) = default;
};

/// Runs a ContactFinder; there is one for each backend.
class ContactEngine {
 public:
  virtual ~ContactEngine() = default;
  /// Does the work of ContactFinder::find; its input has been checked.
  virtual ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) = 0;
  /// Does the work of ContactFinder::find_resident; its query has been checked.
  virtual ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) = 0;
};

/// Finds contacts of one mesh at any number of positions. Only one thread at a time may use it.
class ContactFinder {
 public:
  /// `exclusions`: pairs that are left out, by groups of vertices and by partners; a vector of numbers, one for each
  /// vertex, converts to groups. Throws compare::InputError if an index is out of range or repeated, or if exclusions
  /// do not have one entry for each vertex, and compare::ResourceError as `contestant(backend)` does.
  ContactFinder(compare::Index vertex_count, std::span<const compare::Triangle> triangles,
                std::span<const compare::Edge> loose_edges = {}, Backend backend = Backend::cpu,
                const compare::ExclusionView& exclusions = {});

  /// Returns the numbers of edges, and the adjacency.
  const compare::Topology& topology() const { return *topology_; }

  /// Takes positions [m] on the host, and returns results on the host. Throws compare::InputError if the number of
  /// positions is not the mesh's, a coordinate is not finite, or the query is out of range.
  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query);

  /// Takes positions where the backend computes (device memory for Backend::cuda), one for each vertex; results stay
  /// there, complete on return, until the next call. Coordinates are not checked. Throws compare::InputError if the
  /// query is out of range.
  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query);

 private:
  std::unique_ptr<const compare::Topology> topology_;  // the engine refers to it, so it must not move with the finder
  std::unique_ptr<ContactEngine> engine_;
};

}  // namespace ogc::fast
