// The regions in which Newton's and VBD's vertices stay between two detections. Positions are doubles then, but a
// detection reads single-precision ones. So X_prev is x rounded, and each region is smaller than its bounds by what
// rounding can move a point: both x and its stored value keep the bounds (Eq. 27; method.md §5.6), and the way from
// X_prev over x to the next X_prev stays inside, too.
#pragma once

#include <functional>
#include <vector>

#include "compare/problem/settings.hpp"
#include "reference/solvers/detection.hpp"

namespace ogc::reference {

/// For each vertex a ball about X_prev and, where bounds are planes, half-spaces; without bounds all of space.
class FeasibleRegions {
 public:
  /// Maps n to H⁻¹ n, the direction in which a vertex with the block H leaves a half-space.
  using Metric = std::function<Triple<double>(const Triple<double>&)>;

  FeasibleRegions() = default;
  FeasibleRegions(const Detected& detected, compare::Bounds bounds);

  /// `cut`: x lay outside and was changed.
  struct Inside {
    Triple<double> x;
    bool cut = false;
  };
  /// Returns x if it lies inside. Otherwise returns the point of the ball closest to it or, with half-spaces, a point
  /// of the region near it: x slides along the half-spaces in the given metric (none: the shortest way); if it is still
  /// outside, it is scaled back towards `from`, which lies inside. With bounds=dat x is scaled towards X_prev, for
  /// prescribed vertices, too.
  Inside inside(std::size_t vertex, const Triple<double>& from, const Triple<double>& x,
                const Metric& metric = {}) const;
  /// Does the same for a prescribed vertex, which does not slide.
  Inside inside_on_path(std::size_t vertex, const Triple<double>& from, const Triple<double>& x) const;
  /// Returns the largest share in [0, 1] of `step` that stays inside.
  double share_inside(std::size_t vertex, const Triple<double>& x, const Triple<double>& step) const;

 private:
  struct HalfSpace {
    Triple<double> normal;
    double offset = 0;
  };
  bool holds(std::size_t vertex, const Triple<double>& x) const;
  Triple<double> into_ball(std::size_t vertex, const Triple<double>& x) const;
  Inside scaled(std::size_t vertex, const Triple<double>& from, const Triple<double>& x) const;
  void add_planes(std::size_t vertex, const Detected& detected, double rounding);

  State centre_;
  std::vector<double> radius_;
  std::vector<std::vector<HalfSpace>> planes_;
  bool is_scaled_ = false;  ///< vertices are scaled and do not slide
};

}  // namespace ogc::reference
