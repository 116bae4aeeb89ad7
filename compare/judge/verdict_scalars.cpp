// Verdicts of activation and truncate.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/exact_sum.hpp"
#include "compare/judge/units.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

namespace {

/// ‖x − p‖ ≤ b, exactly: x² − 2xp + p² by coordinate, products of two floats being exact in double.
bool obeys(const Vec3f& x, const Vec3f& p, float b) {
  ExactSum margin;
  for (const auto [a, c] : {std::array{x.x, p.x}, std::array{x.y, p.y}, std::array{x.z, p.z}}) {
    margin.add(double{a} * a);
    margin.add(-2 * (double{a} * c));
    margin.add(double{c} * c);
  }
  margin.add(-(double{b} * b));
  return margin.sign() <= 0;
}

bool finite(const Vec3f& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

void judge_position(const Vec3f& previous, const Vec3f& asked, float bound, const Vec3& exact, const Vec3f& stored, bool exceeded, Tally& tally) {
  if (!finite(stored)) {
    tally.mismatch("position: not finite");
    return;
  }
  if (!obeys(stored, previous, bound)) {
    const double moved = std::hypot(double{stored.x} - previous.x, double{stored.y} - previous.y, double{stored.z} - previous.z);
    tally.mismatch(text("position: the stored position is %.17g from the previous one, bound %.9g", moved, bound));
    return;
  }
  if (!exceeded && !(stored == asked)) {
    tally.mismatch("position: nothing is exceeded, but the position did not come back bit for bit");
    return;
  }
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  const double size = std::max({std::abs(previous.x), std::abs(previous.y), std::abs(previous.z)});
  tally.error(0, in_units(error, size + bound), [&] { return text("%.4g from the exact position, bound %.9g", error, bound); });
}

}  // namespace

void judge_activation(Cases cases, const ActivationTruth& truth, const ActivationOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  const std::size_t n = cases.size();
  if (out.energy.size() != n || out.slope.size() != n || out.curvature.size() != n) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, 0);
    const auto one = [&](std::size_t metric, float value, double exact, double scale) {
      tally.error(metric, in_units(std::abs(value - exact), scale), [&] { return text("%.9g, exact %.17g", value, exact); });
    };
    one(0, out.energy[i], truth.energy[i], truth.energy_scale[i]);
    one(1, out.slope[i], truth.slope[i], truth.slope_scale[i]);
    one(2, out.curvature[i], truth.curvature[i], truth.curvature_scale[i]);
  }
}

void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  if (out.position.size() != cases.size() || out.exceeded.size() != cases.size()) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, truth.grey[i]);
    if (out.exceeded[i] > 1 || (out.exceeded[i] != truth.exceeded[i] && !truth.grey[i])) {
      tally.mismatch("exceeded: " + std::to_string(out.exceeded[i]) + ", exact " + std::to_string(truth.exceeded[i]));
      continue;
    }
    judge_position(in.previous[i], in.position[i], in.bound[i], truth.position[i], out.position[i], out.exceeded[i], tally);
  }
}

}  // namespace ogc::compare
