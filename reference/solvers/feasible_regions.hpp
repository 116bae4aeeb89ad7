// The regions in which the vertices of Newton's method and VBD stay between two detections. Positions are doubles, but
// a detection reads single-precision ones, so X_prev is x rounded. Each region is smaller than its bounds by the error
// of this rounding. So x and its stored value keep the bounds (Eq. 27; method.md §5.6), and so does the way from X_prev
// over x to the next X_prev.
#pragma once

#include <functional>
#include <vector>

#include "compare/problem/settings.hpp"
#include "reference/solvers/detection.hpp"

namespace ogc::reference {

/// Holds for each vertex a ball about X_prev and, if bounds are planes, half-spaces. Without bounds a region is all of
/// space.
class FeasibleRegions {
 public:
  /// Maps n to H⁻¹ n, the direction in which a vertex with the block H leaves a half-space.
  using Metric = std::function<Triple<double>(const Triple<double>&)>;

  FeasibleRegions() = default;
  FeasibleRegions(const Detected& detected, compare::Bounds bounds);

  /// `cut`: x was outside and has been changed.
  struct Inside {
    Triple<double> x;
    bool cut = false;
  };
  /// Returns x if it is inside. Otherwise returns the closest point of the ball or, with half-spaces, a point of the
  /// region near x. Then x slides along the half-spaces in the given metric (none: the shortest way). If it is still
  /// outside, it is scaled towards `from`, which is inside. With bounds=dat x is scaled towards X_prev, also for
  /// prescribed vertices.
  Inside inside(std::size_t vertex, const Triple<double>& from, const Triple<double>& x,
                const Metric& metric = {}) const;
  /// Returns the same for a prescribed vertex, which does not slide.
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
  bool is_scaled_ = false;  ///< whether vertices are scaled instead of sliding
};

}  // namespace ogc::reference
