// Makes a question of a sweep case. The authority finds contacts and bounds at X_prev, so that every question is one
// that a step could ask, and a case holds nothing but positions.
#pragma once

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/stages/sweep.hpp"

namespace ogc::compare {

/// Owns what a SweepIn points to; must not move.
class SweepQuestion {
 public:
  /// Asks the authority for rest state, contact sets, contacts with volumes, and bounds.
  SweepQuestion(const SweepCase& test, const Authority& authority);
  SweepQuestion(const SweepQuestion&) = delete;
  SweepQuestion& operator=(const SweepQuestion&) = delete;

  const SweepIn& in() const { return in_; }  ///< valid as long as the question

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

/// Returns `wish` where it obeys the bound; otherwise the point at the bound of the segment that leads there, its
/// rounded coordinates stepped towards `previous` until the stored point obeys. The step must be finite in single
/// precision.
Vec3f within_bound(const Vec3f& wish, const Vec3f& previous, float bound);

}  // namespace ogc::compare
