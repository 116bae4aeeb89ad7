// Makes the question of a sweep case. The authority finds contacts and bounds at X_prev, so a case holds only
// positions, and its question could occur in a step.
#pragma once

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/stages/sweep.hpp"

namespace ogc::compare {

/// Owns the data that a SweepIn views; must not move.
class SweepQuestion {
 public:
  /// Gets rest state, contact sets, contacts with volumes, and bounds from the authority.
  SweepQuestion(const SweepCase& test, const Authority& authority);
  SweepQuestion(const SweepQuestion&) = delete;
  SweepQuestion& operator=(const SweepQuestion&) = delete;

  const SweepIn& in() const { return in_; }  ///< valid as long as this object

 private:
  SweepIn in_;
  Topology topology_;
  RestStateOut rest_;
  DetectVertexFacetOut vertex_facet_;
  DetectEdgeEdgeOut edge_edge_;
  std::vector<float> bound_;
  std::vector<Vec3f> old_;
  std::vector<VolumeContact> volumes_;
};

/// Returns `wish` if it obeys the bound. Otherwise returns the point at the bound on the segment from `previous` to
/// `wish`; its rounded coordinates move towards `previous` until the stored point obeys. The step must be finite in
/// single precision.
Vec3f within_bound(const Vec3f& wish, const Vec3f& previous, float bound);

}  // namespace ogc::compare
