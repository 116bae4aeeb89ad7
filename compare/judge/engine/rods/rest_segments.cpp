#include "compare/judge/engine/rods/rest_segments.hpp"

#include <algorithm>
#include <cmath>

namespace ogc::compare {

namespace {

/// Returns ‖a − b‖ for the nearer sign of a; 1 where the stored one is no unit quaternion.
double apart(const Quaternion& stored, const std::array<double, 4>& exact) {
  double same = 0, other = 0, squared = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double q = stored[k];
    same += (q - exact[k]) * (q - exact[k]);
    other += (q + exact[k]) * (q + exact[k]);
    squared += q * q;
  }
  if (!(std::abs(squared - 1) <= unit_quaternion_slack)) return 1;
  return std::sqrt(std::min(same, other));
}

}  // namespace

void SegmentVerdict::judge(const RestStateTruth& truth, const RestStateOut& out) const {
  for (std::size_t e = 0; e < out.segments.size(); ++e) {
    const RestSegment &a = out.segments[e], &b = truth.exact.segments[e];
    if (a.end != b.end || a.body != b.body) return wrong("segment has other ends, or another body", e);
    if (a.neighbour != b.neighbour) return wrong("segment has other neighbours", e);
    const auto one = [&](const char* what, double value, double exact, double scale) {
      error(what, e, std::abs(value - exact), scale, value, exact);
    };
    one("length of segment", a.length, truth.segment_length[e], truth.segment_length_scale[e]);
    const auto frame = [&](const char* what, const Quaternion& q, const std::array<double, 4>& exact) {
      const double off = apart(q, exact), scale = truth.segment_frame_scale[e];
      error(what, e, std::isinf(scale) ? (off == 1 ? 1 : 0) : off, std::isinf(scale) ? 1 : scale, double{q[3]},
            exact[3]);
    };
    frame("frame of segment", a.orientation, truth.segment_orientation[e]);
    for (std::size_t end = 0; end < 2; ++end) {
      if (b.neighbour[end] < 0) {
        if (a.weight[end] != 0) wrong("segment has a weight where it has no neighbour", e);
        continue;
      }
      one("weight of segment", a.weight[end], truth.segment_weight[e][end], truth.segment_weight_scale[e][end]);
      const double scale = std::max(truth.segment_frame_scale[e],
                                    truth.segment_frame_scale[static_cast<std::size_t>(b.neighbour[end])]);
      const double off = apart(a.relative[end], truth.segment_relative[e][end]);
      error("relative rotation of segment", e, std::isinf(scale) ? (off == 1 ? 1 : 0) : off,
            std::isinf(scale) ? 1 : scale, double{a.relative[end][3]}, truth.segment_relative[e][end][3]);
    }
  }
}

}  // namespace ogc::compare
