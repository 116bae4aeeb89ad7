// Finds contact sets, smallest distances and conservative bounds for a solver outside this project. The solver passes
// positions and gets everything that Offset Geometric Contact needs for one step. Lists grow by themselves, no contact
// is dropped, and the same positions give the same bits.
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
  float query_radius = 0;           ///< r_q ≥ r: range of the search, so no bound exceeds γ_p r_q
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

/// Does the work of a ContactFinder on one backend.
class ContactEngine {
 public:
  virtual ~ContactEngine() = default;
  /// Implements ContactFinder::find for checked input.
  virtual ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) = 0;
  /// Implements ContactFinder::find_resident for a checked query.
  virtual ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) = 0;
};

/// Finds contacts of one mesh at any number of positions. Only one thread at a time may use it.
class ContactFinder {
 public:
  /// `exclusions`: pairs that are excluded by groups of vertices or by partners. A vector with one number per vertex
  /// converts to groups. Throws compare::InputError if an index is out of range or repeated, or if groups or partners
  /// do not have one entry per vertex. Throws compare::ResourceError if `contestant(backend)` throws it.
  ContactFinder(compare::Index vertex_count, std::span<const compare::Triangle> triangles,
                std::span<const compare::Edge> loose_edges = {}, Backend backend = Backend::cpu,
                const compare::ExclusionView& exclusions = {});

  /// Returns the mesh's topology, which defines the numbers of edges.
  const compare::Topology& topology() const { return *topology_; }

  /// Finds contacts at `positions` [m]; positions and results are on the host. Throws compare::InputError if the number
  /// of positions is not the mesh's, a coordinate is not finite, or the query is out of range.
  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query);

  /// Finds contacts at positions in the backend's memory (device memory for Backend::cuda), one for each vertex. The
  /// results stay in that memory, complete on return and valid until the next call. Coordinates are not checked. Throws
  /// compare::InputError if the query is out of range.
  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query);

 private:
  // the engine refers to this topology, so the topology's address must stay when the finder is moved
  std::unique_ptr<const compare::Topology> topology_;
  std::unique_ptr<ContactEngine> engine_;
};

}  // namespace ogc::fast
