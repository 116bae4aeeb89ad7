#include "compare/judge/stages/force_stage.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/engine/units.hpp"

namespace ogc::compare {

namespace {

/// Errors relative to one accepted answer, in units of 2⁻²⁴ · scale.
struct ForceErrors {
  double force = 0, block = 0;
};

ForceErrors errors_of(const Vec3f& force, const std::array<float, 6>& block, const ForceAnswer& exact) {
  double squared = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double error = block[k] - exact.block[k];
    squared += error * error;
  }
  const double off = std::hypot(force.x - exact.force.x, force.y - exact.force.y, force.z - exact.force.z);
  return {in_units(off, exact.force_scale), in_units(std::sqrt(squared), exact.block_scale)};
}

bool is_within(const ForceErrors& errors, std::span<const MetricInfo> infos) {
  return errors.force <= infos[0].tolerance && errors.block <= infos[1].tolerance;
}

/// Returns the accepted answer with the least error. The error is that of the force or of the block, divided by its
/// tolerance, whichever is larger.
const ForceAnswer& nearest(const std::vector<ForceAnswer>& accepted, const Vec3f& force,
                           const std::array<float, 6>& block, std::span<const MetricInfo> infos) {
  const auto share = [&](const ForceAnswer& exact) {
    const ForceErrors errors = errors_of(force, block, exact);
    return std::max(errors.force / infos[0].tolerance, errors.block / infos[1].tolerance);
  };
  return *std::min_element(accepted.begin(), accepted.end(),
                           [&](const ForceAnswer& a, const ForceAnswer& b) { return share(a) < share(b); });
}

}  // namespace

void judge_force(Cases cases, const ForceTruth& truth, const ForceOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  if (out.force.size() != cases.size() || out.block.size() != cases.size()) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  const std::span<const MetricInfo> infos = metrics(tally.stage);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& accepted = truth.accepted[i];
    tally.begin(cases[i].name);
    tally.count(1, 1, accepted.size() > 1, truth.near[i]);
    const Vec3f& force = out.force[i];
    const ForceAnswer& exact = nearest(accepted, force, out.block[i], infos);
    const ForceErrors errors = errors_of(force, out.block[i], exact);
    if (is_within(errors, infos) && !is_within(errors_of(force, out.block[i], accepted.front()), infos))
      tally.answered_not_exactly();
    tally.error(0, errors.force, [&] {
      return text("modulus %.9g, exact %.9g", std::hypot(force.x, force.y, force.z),
                  std::hypot(exact.force.x, exact.force.y, exact.force.z));
    });
    tally.error(1, errors.block, [&] {
      const auto& b = out.block[i];
      return text("trace %.9g, exact %.9g", double{b[0]} + b[3] + b[5],
                  exact.block[0] + exact.block[3] + exact.block[5]);
    });
  }
}

}  // namespace ogc::compare
