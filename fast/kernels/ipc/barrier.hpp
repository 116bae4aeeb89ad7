// IPC's barrier over the squared distance (Li et al. 2020, Eq. 6; with a thickness Li et al. 2021, Eq. 10). No step
// asks it; it stands here for solvers that do, and for the judge.
#pragma once

#include "compare/stages/barrier.hpp"
#include "fast/kernels/arithmetic/logarithm.hpp"
#include "fast/kernels/arithmetic/rounding.hpp"

namespace ogc::fast {

/// b [m⁴], db/dD [m²], d²b/dD² [1].
struct BarrierValue {
  float energy = 0, slope = 0, curvature = 0;
};

/// At a squared distance D [m²] with an activation distance d̂ and a thickness ξ [m]. Gap, support and their difference
/// come from doubles, so that nothing cancels in single precision; all terms that follow have one sign.
OGC_HD inline BarrierValue ipc_barrier(float squared_distance, float activation_distance, float thickness) {
  const double distance = activation_distance, thick = thickness;
  const double gap = sub(static_cast<double>(squared_distance), mul(thick, thick));
  const double support = mul(distance, add(distance, add(thick, thick)));
  if (!(gap < support)) return {};
  const float g = static_cast<float>(gap), h = static_cast<float>(support),
              depth = static_cast<float>(sub(support, gap));
  const float log = h < 2.0F * g ? twice_artanh(depth / static_cast<float>(add(support, gap))) : log_ratio(h, g);
  const float ratio = depth / g;
  return {depth * depth * log, -depth * (2.0F * log + ratio), 2.0F * log + ratio * (4.0F + ratio)};
}

}  // namespace ogc::fast
