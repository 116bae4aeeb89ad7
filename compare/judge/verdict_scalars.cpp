// Verdicts of activation, truncate and initial_guess.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/judge/exact_sum.hpp"
#include "compare/judge/units.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

namespace {

/// Whether d lies near r, or near τ = r/2 where the stages of the activation meet.
bool near_join(double d, double r) { return std::min(std::abs(d - r), std::abs(d - r / 2)) <= near_factor * d; }

bool finite(const Vec3f& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

/// One vertex that truncation has answered about; `metric`: the number of the position's error.
void judge_position(const Vec3f& previous, const Vec3f& asked, float bound, const Vec3& exact, const Vec3f& stored,
                    bool exceeded, std::size_t metric, Tally& tally) {
  if (!finite(stored)) {
    tally.mismatch("position: not finite");
    return;
  }
  if (!obeys_bound(stored, previous, bound)) {
    const double moved = std::hypot(double{stored.x} - previous.x, double{stored.y} - previous.y,
                                    double{stored.z} - previous.z);
    tally.mismatch(text("position: the stored position is %.17g from the previous one, bound %.9g", moved, bound));
    return;
  }
  if (!exceeded && !(stored == asked)) {
    tally.mismatch("position: nothing is exceeded, but the position did not come back bit for bit");
    return;
  }
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  const double size = std::max({std::abs(previous.x), std::abs(previous.y), std::abs(previous.z)});
  tally.error(metric, in_units(error, size + bound),
              [&] { return text("%.4g from the exact position, bound %.9g", error, bound); });
}

}  // namespace

void judge_activation(Cases cases, const ActivationIn& in, const ActivationTruth& truth, const ActivationOut& out,
                      Tally& tally) {
  tally.begin(cases[0].name);
  const std::size_t n = cases.size();
  if (out.energy.size() != n || out.slope.size() != n || out.curvature.size() != n) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, 0, near_join(in.distance[i], in.contact_radius[i]));
    const auto one = [&](std::size_t metric, float value, double exact, double scale) {
      tally.error(metric, in_units(std::abs(value - exact), scale),
                  [&] { return text("%.9g, exact %.17g", value, exact); });
    };
    one(0, out.energy[i], truth.energy[i], truth.energy_scale[i]);
    one(1, out.slope[i], truth.slope[i], truth.slope_scale[i]);
    one(2, out.curvature[i], truth.curvature[i], truth.curvature_scale[i]);
  }
}

void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out,
                    Tally& tally) {
  tally.begin(cases[0].name);
  if (out.position.size() != cases.size() || out.exceeded.size() != cases.size()) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, truth.grey[i], truth.near[i]);
    if (out.exceeded[i] > 1 || (out.exceeded[i] != truth.exceeded[i] && !truth.grey[i])) {
      tally.mismatch("exceeded: " + std::to_string(out.exceeded[i]) + ", exact " + std::to_string(truth.exceeded[i]));
      continue;
    }
    if (out.exceeded[i] != truth.exceeded[i]) tally.answered_not_exactly();
    judge_position(in.previous[i], in.position[i], in.bound[i], truth.position[i], out.position[i], out.exceeded[i], 0,
                   tally);
  }
}

TruncateIn cut_question(const InitialGuessIn& in, const InitialGuessOut& out) {
  TruncateIn cut;
  for (std::size_t i = 0; i < in.cases.size(); ++i) {
    const bool is_point = i < out.target.size() && finite(out.target[i]);
    cut.previous.push_back(in.cases[i].previous);
    cut.position.push_back(is_point ? out.target[i] : in.cases[i].previous);
    cut.bound.push_back(in.cases[i].bound);
  }
  return cut;
}

void judge_initial_guess(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth,
                         const TruncateTruth& cut, const InitialGuessOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  const std::size_t n = cases.size();
  if (out.target.size() != n || out.position.size() != n || out.cut.size() != n) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const InitialGuessCase& c = in.cases[i];
    const Vec3f& y = out.target[i];
    tally.begin(cases[i].name);
    tally.count(1, 1, cut.grey[i] && !c.held, cut.near[i] && !c.held);
    const Vec3& exact = truth.target[i];
    const double error = std::max({std::abs(y.x - exact.x), std::abs(y.y - exact.y), std::abs(y.z - exact.z)});
    tally.error(0, finite(y) ? in_units(error, truth.target_scale[i]) : std::numeric_limits<double>::infinity(), [&] {
      return text("a coordinate is %.4g from the exact one, terms of %.4g", error, truth.target_scale[i]);
    });
    if (!finite(y)) continue;
    if (c.held) {
      if (out.cut[i] != 0 || !(out.position[i] == c.previous))
        tally.mismatch("position: the vertex is held, but it was moved or counted as cut");
      continue;
    }
    if (out.cut[i] > 1 || (out.cut[i] != cut.exceeded[i] && !cut.grey[i])) {
      tally.mismatch("cut: " + std::to_string(out.cut[i]) + ", exact " + std::to_string(cut.exceeded[i]));
      continue;
    }
    if (out.cut[i] != cut.exceeded[i]) tally.answered_not_exactly();
    judge_position(c.previous, y, c.bound, cut.position[i], out.position[i], out.cut[i], 1, tally);
  }
}

}  // namespace ogc::compare
