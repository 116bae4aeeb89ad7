// What a row reports of rods. Terms are in double and only reported.
#pragma once

#include "fast/kernels/metrics.hpp"
#include "fast/kernels/rods/segments.hpp"

namespace ogc::fast {

/// A quaternion in double: energies of small angles are differences of numbers near 1.
struct WideQuat {
  double x, y, z, w;
};
OGC_HD inline WideQuat wide(const Quat& q) { return {q.x, q.y, q.z, q.w}; }
/// ā b.
OGC_HD inline WideQuat between(const WideQuat& a, const WideQuat& b) {
  return {a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y, a.w * b.y - a.y * b.w - a.z * b.x + a.x * b.z,
          a.w * b.z - a.z * b.w - a.x * b.y + a.y * b.x, a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z};
}
/// ‖a − s b‖² for the sign s that makes it smaller.
OGC_HD inline double squared_apart(const WideQuat& a, const WideQuat& b) {
  const double s = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < 0 ? -1.0 : 1.0;
  const double d[4] = {a.x - s * b.x, a.y - s * b.y, a.z - s * b.z, a.w - s * b.w};
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + d[3] * d[3];
}

/// Term of a segment; bend and twist belong to the one that has the other ahead of it, or both halves to each.
struct SegmentTerm {
  const SegmentRest* segments;          ///< by segment
  const SegmentNeighbours* neighbours;  ///< by segment
  const Vec* position;                  ///< x by vertex [m]
  const Quat* orientation;              ///< q by segment

  OGC_HD void operator()(int e, double* sum) const {
    const SegmentRest& rest = segments[e];
    const Vec a = position[rest.end[0]], b = position[rest.end[1]];
    const double l = rest.length, d[3] = {(static_cast<double>(b.x) - a.x) / l, (static_cast<double>(b.y) - a.y) / l,
                                          (static_cast<double>(b.z) - a.z) / l};
    const WideQuat q = wide(orientation[e]);
    const double director[3] = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x),
                                1 - 2 * (q.x * q.x + q.y * q.y)};
    double strain = 0;
    for (int k = 0; k < 3; ++k) strain += (d[k] - director[k]) * (d[k] - director[k]);
    sum[rod_energy] += 0.5 * static_cast<double>(rest.stretch) * l * strain;
    sum[rod_stretch] += sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - 1;
    const SegmentNeighbours& seen = neighbours[e];
    for (int k = 0; k < 2; ++k) {
      if (!(seen.rest[k].weight > 0)) continue;
      // Each of both neighbours adds half of 2 k_b/l̄ ‖…‖² = w/2 ‖…‖².
      const WideQuat other = wide(orientation[seen.number[k]]);
      const WideQuat relative = k == 1 ? between(q, other) : between(other, q);
      sum[rod_energy] += 0.25 * static_cast<double>(seen.rest[k].weight) *
                         squared_apart(relative, wide(seen.rest[k].rest));
    }
  }
};

/// One item: before the extremes of a step are sought.
struct ResetRodExtremes {
  RodExtremes* extremes;  ///< on the backend

  OGC_HD void operator()(int) const { *extremes = {}; }
};

/// for_each over segments: the largest ‖D‖/l.
struct RaiseStretch {
  const SegmentRest* segments;  ///< by segment
  const Vec* position;          ///< x by vertex [m]
  RodExtremes* extremes;        ///< on the backend

  OGC_HD void operator()(int e) const {
    const SegmentRest& rest = segments[e];
    const Vec apart = position[rest.end[1]] - position[rest.end[0]];
    const float ratio = sqrtf(dot(apart, apart)) / rest.length;
    if (is_finite(ratio)) atomic_max(&extremes->stretch, float_bits(ratio));
  }
};

}  // namespace ogc::fast
