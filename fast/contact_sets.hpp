// Finds contact sets, smallest distances and conservative bounds for a solver outside this project. The solver passes
// positions and gets everything that Offset Geometric Contact needs for one step. Lists grow by themselves, no contact
// is dropped, and the same positions give the same bits.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "compare/stages/detect_vertex_facet.hpp"
#include "fast/contact_columns.hpp"
#include "fast/contact_view.hpp"
#include "fast/contestant.hpp"
#include "fast/mesh.hpp"

namespace ogc::fast {

/// Parameters of a detection [m].
struct ContactQuery {
  float contact_radius = 0;  ///< r ≥ least_radius
  float query_radius = 0;    ///< r_q ≥ r, ≤ most_query_radius: range of the search; no bound exceeds γ_p r_q
  float bounds_relaxation = 0.45F;  ///< γ_p of Eq. 21, in (0, 0.5)
};

/// Holds the results on the host, in canonical order (compare/stages); distances and bounds are never above the exact
/// ones.
struct ContactSets {
  std::vector<compare::VertexFacetContact> vertex_facet;        ///< F_OGC(v) for all v
  std::vector<compare::EdgeEdgeContact> edge_edge;              ///< E_OGC; edge numbers: Mesh::topology()
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
  /// Implements ContactFinder::find_columns for checked input.
  virtual ContactColumns find_columns(std::span<const compare::Vec3f> positions, const ContactQuery& query) = 0;
  /// Implements ContactFinder::find_columns_resident for a checked query.
  virtual ContactColumns find_columns_resident(const compare::Vec3f* positions, const ContactQuery& query) = 0;
};

/// Finds contacts of one mesh at any number of positions. Only one thread at a time may use it.
class ContactFinder {
 public:
  /// Several finders and guards may share a mesh. Throws compare::ResourceError if `contestant(backend)` throws it.
  explicit ContactFinder(Mesh mesh, Backend backend = Backend::cpu);

  /// Returns the mesh; its topology defines the numbers of edges.
  const Mesh& mesh() const { return mesh_; }

  /// Finds contacts at `positions` [m]; positions and results are on the host. Throws compare::InputError if the number
  /// of positions is not the mesh's, a coordinate is not finite or beyond most_coordinate, or the query is out of
  /// range.
  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query);

  /// Finds contacts at positions in the backend's memory (device memory for Backend::cuda), one for each vertex. The
  /// results stay in that memory, complete on return and valid until the next call. Coordinates are not checked. Throws
  /// compare::InputError if the query is out of range, or if the device cannot read the positions.
  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query);

  /// Do the work of `find` and of `find_resident`, and return the results as columns in the backend's memory, complete
  /// on return. No later call writes to them. Throw as these functions do, and compare::ResourceError if there is no
  /// memory for the columns.
  ContactColumns find_columns(std::span<const compare::Vec3f> positions, const ContactQuery& query);
  ContactColumns find_columns_resident(const compare::Vec3f* positions, const ContactQuery& query);

 private:
  Mesh mesh_;
  std::unique_ptr<ContactEngine> engine_;  // refers to the mesh's topology
};

}  // namespace ogc::fast
