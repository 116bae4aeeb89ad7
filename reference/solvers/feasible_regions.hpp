// Computes the regions in which Newton's method and VBD keep the vertices between two detections. Positions are
// doubles, but a detection reads single-precision positions, so X_prev is x rounded. Each region is smaller than its
// bounds by this rounding error. So x, its stored value, and the path from X_prev over x to the next X_prev keep the
// bounds (Eq. 27; method.md §5.6).
#pragma once

#include <functional>
#include <vector>

#include "compare/problem/settings.hpp"
#include "reference/solvers/detection.hpp"

namespace ogc::reference {

/// Holds the region of each vertex: a ball about X_prev and, if bounds are planes, half-spaces. Without bounds the
/// region is all of space.
class FeasibleRegions {
 public:
  /// Maps a half-space's normal n to H⁻¹ n, where H is the vertex's block. A vertex outside the half-space slides back
  /// into it in this direction.
  using Metric = std::function<Triple<double>(const Triple<double>&)>;

  FeasibleRegions() = default;
  FeasibleRegions(const Detected& detected, compare::Bounds bounds);

  /// A truncated position; `cut` is whether it differs from the given position.
  struct Inside {
    Triple<double> x;
    bool cut = false;
  };
  /// Returns x if it is inside the region; otherwise a point of the region near x. Without half-spaces this is the
  /// closest point of the ball. With half-spaces, x slides along them in the given metric, or to their closest points
  /// if there is no metric. A point that is still outside is scaled towards `from`, which must be inside. With
  /// bounds=dat, x is only scaled, towards X_prev.
  Inside inside(std::size_t vertex, const Triple<double>& from, const Triple<double>& x,
                const Metric& metric = {}) const;
  /// Truncates a prescribed vertex, which does not slide: the result is on the path from `from` to x.
  Inside inside_on_path(std::size_t vertex, const Triple<double>& from, const Triple<double>& x) const;
  /// Returns the largest share in [0, 1] of `step` for which x + share · step is inside.
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
  bool is_scaled_ = false;  ///< whether moves are scaled; otherwise vertices slide along half-spaces
};

}  // namespace ogc::reference
