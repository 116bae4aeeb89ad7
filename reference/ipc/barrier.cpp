#include "reference/ipc/barrier.hpp"

#include <algorithm>
#include <cmath>

#include "reference/ipc/stages.hpp"

namespace ogc::reference {

compare::BarrierTruth barrier_truth(const compare::BarrierIn& in) {
  compare::BarrierTruth truth;
  for (const compare::BarrierCase& c : in.cases) {
    const BarrierShape shape{c.activation_distance, c.thickness};
    const double gap = shape.gap(c.squared_distance), support = shape.support();
    const Second<1> b = barrier_slopes(gap, support);
    truth.energy.push_back(b.value);
    truth.slope.push_back(b.slope[0]);
    truth.curvature.push_back(b.bend(0));
    const double depth = support - gap, log = std::abs(std::log(gap / support));
    // Each scale is the number's modulus (`terms`), plus the effects of relative errors of D, ξ² and the support H. The
    // effect of an error of q is |q| times the modulus of the derivative by q. All terms of a derivative have the same
    // sign.
    const double of_gap = c.squared_distance + double{c.thickness} * c.thickness, ratio = depth / gap;
    const bool acts = depth > 0;
    const auto scale = [&](double terms, double by_gap, double by_support) {
      return acts ? std::max(terms + by_gap * of_gap + by_support * support, 0x1p-102) : 0;
    };
    truth.energy_scale.push_back(
        scale(std::abs(b.value), std::abs(b.slope[0]), 2 * depth * log + depth * depth / support));
    truth.slope_scale.push_back(
        scale(std::abs(b.slope[0]), std::abs(b.bend(0)), 2 * log + 2 * depth / support + 2 * ratio));
    truth.curvature_scale.push_back(
        scale(std::abs(b.bend(0)), (6 + 6 * ratio + 2 * ratio * ratio) / gap, 2 / support + (4 + 2 * ratio) / gap));
  }
  return truth;
}

}  // namespace ogc::reference
