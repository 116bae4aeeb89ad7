// Checks the motion certificate (method.md §5.5). Two states without intersections do not prove that the motion between
// them had none. The motion had none if all vertices stayed within their bounds.
#pragma once

#include <cstddef>
#include <span>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Holds whether stored positions satisfy Eq. 27, that is, whether no vertex moved farther than its bound.
struct MotionCertificate {
  /// number of vertices with ‖x − x_prev‖ > b_v, with a number that is not finite, or with b_v < 0
  std::size_t violations = 0;
  Index worst_vertex = -1;  ///< vertex of the largest ratio, the lowest-numbered of equals; −1 if no vertex moved
  /// largest ‖x − x_prev‖ / b_v, rounded; infinite if a vertex moved although b_v = 0 or has numbers that are not
  /// finite
  double worst_ratio = 0;
  bool kept() const { return violations == 0; }
};

/// Compares each vertex's motion with its bound exactly, on the stored single-precision values; only `worst_ratio` is
/// rounded. The arrays are from a Snapshot: positions x, X_prev and b_v of the last detection [m], one entry for each
/// vertex. Throws InputError if their lengths differ.
MotionCertificate motion_certificate(std::span<const Vec3f> positions, std::span<const Vec3f> previous,
                                     std::span<const float> bounds);

}  // namespace ogc::compare
