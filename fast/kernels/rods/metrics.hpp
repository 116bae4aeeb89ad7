// Adds the energy and the stretch of rods to a step's sums. Terms are in double; no position depends on them.
#pragma once

#include "fast/kernels/metrics.hpp"
#include "fast/kernels/rods/segments.hpp"

namespace ogc::fast {

/// Returns q in double, because energies of small angles are small differences of numbers near 1.
OGC_HD inline QuatOf<double> wide(const Quat& q) { return {q.x, q.y, q.z, q.w}; }
/// Returns the smaller of ‖a − b‖² and ‖a + b‖²: b and −b are the same rotation.
OGC_HD inline double squared_apart(const QuatOf<double>& a, const QuatOf<double>& b) {
  const QuatOf<double> apart = dot(a, b) < 0 ? a + b : a - b;
  return dot(apart, apart);
}

/// Adds a segment's energy and ‖D‖/l − 1 to the sums. The energy of bend and twist between two segments is added in two
/// halves, one by each segment. Returns ‖D‖/l; 0 if it is not finite.
struct SegmentTerm {
  const SegmentRest* segments;          ///< by segment
  const SegmentNeighbours* neighbours;  ///< by segment
  const Vec* position;                  ///< x by vertex [m]
  const Quat* orientation;              ///< q by segment

  OGC_HD float operator()(int e, double* sum) const {
    const SegmentRest& rest = segments[e];
    const Vec a = position[rest.end[0]], b = position[rest.end[1]];
    const double l = rest.length, d[3] = {(static_cast<double>(b.x) - a.x) / l, (static_cast<double>(b.y) - a.y) / l,
                                          (static_cast<double>(b.z) - a.z) / l};
    const QuatOf<double> q = wide(orientation[e]);
    const double director[3] = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
                                1 - 2 * (q.x * q.x + q.y * q.y)};
    double strain = 0;
    for (int k = 0; k < 3; ++k) strain += (d[k] - director[k]) * (d[k] - director[k]);
    sum[sum_rod] += 0.5 * static_cast<double>(rest.stretch) * l * strain;
    sum[sum_stretch] += sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - 1;
    const SegmentNeighbours& seen = neighbours[e];
    for (int k = 0; k < 2; ++k) {
      if (!(seen.rest[k].weight > 0)) continue;
      // half of the energy w/2 ‖…‖² of bend and twist between two segments; w = 4 k_b/l̄
      const QuatOf<double> other = wide(orientation[seen.number[k]]);
      const QuatOf<double> relative = k == 1 ? conjugate(q) * other : conjugate(other) * q;
      sum[sum_rod] += 0.25 * static_cast<double>(seen.rest[k].weight) *
                      squared_apart(relative, wide(seen.rest[k].rest));
    }
    const Vec apart = b - a;
    const float ratio = sqrtf(dot(apart, apart)) / rest.length;
    return is_finite(ratio) ? ratio : 0.0f;
  }
};

}  // namespace ogc::fast
