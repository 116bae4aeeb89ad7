// Truncates proposed positions to the regions of their vertices (method.md §5). Every kernel that moves a vertex calls
// this.
#pragma once

#include "fast/kernels/control.hpp"
#include "fast/kernels/plane.hpp"
#include "fast/kernels/plane_lists.hpp"

namespace ogc::fast {

/// Returns whether the proposal is so near the region's centre that it lies in the region. Most proposals are; then no
/// half-space is tested. Returns false if the proposal is not finite.
OGC_HD inline bool is_near_centre(const FeasibleRegion& region, const Vec& proposal) {
  return is_certainly_within({region.ball.centre, region.inner}, proposal) &&
         is_certainly_within(region.ball, proposal);
}

/// Returns the proposal for a free vertex, truncated to its region; `cut`: truncation changed it. All lanes of a team
/// must call this together.
template <class Metric, class Lanes = OneLane>
OGC_HD Truncated held(const FeasibleRegion& region, const Vec& current, const Vec& proposal, const Metric& metric,
                      const Lanes& lanes = {}) {
  if (region.count == 0) return truncate(region.ball, proposal);
  if (is_near_centre(region, proposal)) return {proposal, false};
  if (is_within(region, proposal, lanes)) return {proposal, false};
  if (!region.slides) return scale_into(region, region.ball.centre, proposal, lanes);
  return slide_into(region, current, proposal, metric, lanes);
}

/// Returns the target of a prescribed vertex, truncated to its region on the straight line to the target.
OGC_HD inline Truncated held_on_path(const FeasibleRegion& region, const Vec& current, const Vec& target) {
  if (region.count == 0) return truncate(region.ball, target);
  if (is_within(region, target)) return {target, false};
  return scale_into(region, region.slides ? current : region.ball.centre, target, OneLane{});
}

/// Counts a prescribed vertex that did not reach its target: as lagging if regions have half-spaces, else as cut.
/// `previous` is its X_prev.
OGC_HD inline void count_behind(StepControl& control, const Truncated& kept, const Vec& previous,
                                const FeasibleRegions& regions) {
  if (!kept.cut) return;
  const Vec &x = kept.position, &p = previous;
  if (!regions.has_planes())
    control.count_cut();
  else
    control.count_lag(x.x != p.x || x.y != p.y || x.z != p.z);
}

}  // namespace ogc::fast
