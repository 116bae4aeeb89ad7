// Detects contacts for solvers that compute in double. A detection reads single-precision positions, so X_prev is x
// rounded.
#pragma once

#include <span>
#include <vector>

#include "reference/geometry/pair_planes.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// The contacts and bounds of a detection, and the positions at which they were found.
struct Detected {
  ContactSets sets;                      ///< contacts up to the contact radius plus the margin
  ContactSets active;                    ///< contacts nearer than r
  std::vector<compare::Vec3f> previous;  ///< X_prev [m]
  std::vector<float> bound;              ///< b_v [m]
  compare::VertexPlanes planes;          ///< filled if bounds are planes
  double smallest_distance = 0;          ///< smallest d_min, at most r_q [m]
};

/// Rounds positions to the nearest single-precision numbers.
std::vector<compare::Vec3f> rounded(const State& x);

/// Returns a query radius between r and `most` [m] that is large enough: the `movable` vertices get the same contacts
/// and bounds as with `most`. Let e be an edge opposite to v that also belongs to a triangle without v. This triangle
/// limits b_v to γ_p times the distance from v to e. The function computes the smallest of these distances for each v,
/// or `most` if there is none, and returns the largest result.
float sufficient_query_radius(const compare::Topology& topology, const compare::ExclusionView& exclusions,
                              const std::vector<std::size_t>& movable, const std::vector<compare::Vec3f>& positions,
                              float contact_radius, float most);

/// Returns the radius up to which contacts are listed: r plus the contact margin [m].
double detection_radius(const compare::Settings& settings);

/// Runs the stages detect_vertex_facet, detect_edge_edge and bound (or plane) at `positions`. `displacement` is needed
/// for bounds=dat (planes of *Divide and Truncate*), which divides each gap in proportion to the displacements of both
/// sides; otherwise it is empty.
Detected detect(const compare::Scene& scene, const compare::Topology& topology,
                const compare::ExclusionView& exclusions, std::vector<compare::Vec3f> positions, float query_radius,
                std::span<const compare::Vec3f> displacement = {});

/// Returns all pairs of primitives within r_q at `positions`, ascending, each with the plane between its sides.
std::vector<NearPair> detect_pairs(const compare::Topology& topology, const compare::ExclusionView& exclusions,
                                   const std::vector<compare::Vec3f>& positions, float query_radius,
                                   double bounds_relaxation);

}  // namespace ogc::reference
