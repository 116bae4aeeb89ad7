// Contact detection at Newton's positions, and the balls that keep them free of penetration. Positions are doubles
// between two detections; a detection is asked about single-precision ones. So X_prev is x rounded, and each ball is
// smaller than its bound by what rounding can move a point: x and what will be stored of it both lie within the bound
// (Eq. 27), and the way from X_prev over x to the next X_prev stays inside, too.
#pragma once

#include <vector>

#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// What a detection found, and where.
struct Detected {
  ContactSets sets;
  std::vector<compare::Vec3f> previous;  ///< X_prev [m]
  std::vector<float> bound;              ///< b_v [m]
  double smallest_distance = 0;          ///< smallest d_min, at most r_q [m]
};

/// Rounds to nearest.
std::vector<compare::Vec3f> rounded(const State& x);

/// A query radius, between r and `most`, that gives the `movable` vertices the contacts and bounds of `most` at these
/// positions. Beyond a side opposite v lies a triangle without v, so b_v is γ_p times the distance to the nearest such
/// side at most, and the largest of these distances is enough; `most` where a vertex has no such triangle. Both radii
/// in metres, r ≤ most.
float sufficient_query_radius(const compare::Topology& topology, const compare::ExclusionView& exclusions,
                              const std::vector<std::size_t>& movable, const std::vector<compare::Vec3f>& positions,
                              float contact_radius, float most);

/// Stages detect_vertex_facet, detect_edge_edge and bound at `positions`.
Detected detect(const compare::Scene& scene, const compare::Topology& topology,
                const compare::ExclusionView& exclusions, std::vector<compare::Vec3f> positions, float query_radius);

/// Balls about X_prev.
class Balls {
 public:
  Balls() = default;
  explicit Balls(const Detected& detected);
  /// x, or the point of the vertex's ball closest to it; `cut` says which.
  struct Inside {
    Triple<double> x;
    bool cut = false;
  };
  /// Where the ball lets this vertex go.
  Inside inside(std::size_t vertex, const Triple<double>& x) const;
  /// The largest share in [0, 1] of `step` that stays in the ball.
  double share_inside(std::size_t vertex, const Triple<double>& x, const Triple<double>& step) const;

 private:
  State centre_;
  std::vector<double> radius_;
};

}  // namespace ogc::reference
