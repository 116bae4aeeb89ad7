// Verdicts of closest_face and closest_points. The scale Σ|δ| is that of method.md §2.5: the moduli of all coordinates
// relative to the case's first vertex.
#include <algorithm>
#include <cmath>

#include "compare/judge/features.hpp"
#include "compare/judge/units.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

namespace {

double modulus(const Vec3f& p, const Vec3f& from) {
  return std::abs(double{p.x} - from.x) + std::abs(double{p.y} - from.y) + std::abs(double{p.z} - from.z);
}

bool right_length(std::size_t n, std::initializer_list<std::size_t> lengths, Tally& tally) {
  for (const std::size_t length : lengths) {
    if (length == n) continue;
    tally.mismatch("an array of the answer has " + std::to_string(length) + " entries for " + std::to_string(n) +
                   " cases");
    return false;
  }
  return true;
}

/// One-sided: false where `below` is above the exact distance, or no number.
bool judge_below(float below, float exact, double distance, double scale, std::size_t metric, Tally& tally) {
  if (!(below <= exact)) {
    tally.mismatch(text("distance_below: %.9g is above the exact distance %.17g", below, distance));
    return false;
  }
  tally.error(metric, in_units(double{exact} - below, scale),
              [&] { return text("%.9g, exact %.17g", below, distance); });
  return true;
}

void judge_face(std::size_t i, const ClosestFaceTruth& truth, const ClosestFaceOut& out, double size, Tally& tally) {
  const auto feature = static_cast<unsigned>(out.feature[i]);
  if (feature > 6 || !(truth.accepted[i] >> feature & 1)) {
    tally.mismatch("feature: " + feature_name(out.feature[i]) + ", exact " + feature_name(truth.exact.feature[i]));
    return;
  }
  if (out.feature[i] != truth.exact.feature[i]) tally.answered_not_exactly();
  const double scale = std::max(truth.distance[i], size);
  tally.error(0, in_units(std::abs(out.distance[i] - truth.distance[i]), scale),
              [&] { return text("%.9g, exact %.17g", out.distance[i], truth.distance[i]); });
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const double error = std::abs(out.weights[i][k] - truth.weights[i][k]);
    if (!(out.weights[i][k] >= 0)) {
      tally.mismatch(text("weights: weight %g is %.9g; a weight is never negative", k, out.weights[i][k]));
      return;
    }
    worst = std::max(worst, error);
  }
  tally.error(1, in_units(worst, truth.weight_condition[i]),
              [&] { return text("condition %.4g, largest error %.4g", truth.weight_condition[i], worst); });
  judge_below(out.distance_below[i], truth.exact.distance_below[i], truth.distance[i], scale, 2, tally);
}

unsigned code(const ClosestPointsOut& out, std::size_t i) {
  const auto first = static_cast<unsigned>(out.first_feature[i]), second = static_cast<unsigned>(out.second_feature[i]);
  return first > 2 || second > 2 || out.nearly_parallel[i] > 1 ? 31 : first + 3 * second + 9u * out.nearly_parallel[i];
}

std::string features(const ClosestPointsOut& out, std::size_t i) {
  const std::string parallel = out.nearly_parallel[i] == 0 ? ""
                               : out.nearly_parallel[i] == 1
                                   ? ", nearly parallel"
                                   : ", nearly_parallel is " + std::to_string(out.nearly_parallel[i]);
  return feature_name(out.first_feature[i], "first") + " and " + feature_name(out.second_feature[i], "second") +
         parallel;
}

void judge_points(std::size_t i, const ClosestPointsTruth& truth, const ClosestPointsOut& out, double size,
                  Tally& tally) {
  const unsigned answer = code(out, i), exact = code(truth.exact, i);
  if (!(truth.accepted[i] >> answer & 1)) {
    tally.mismatch("features: " + features(out, i) + "; exact " + features(truth.exact, i));
    return;
  }
  if (answer != exact) tally.answered_not_exactly();
  for (const float t : out.parameters[i]) {
    if (t >= 0 && t <= 1) continue;
    tally.mismatch(text("parameters: (%.9g, %.9g) is not within [0, 1]", out.parameters[i][0], out.parameters[i][1]));
    return;
  }
  if (!judge_below(out.distance_below[i], truth.exact.distance_below[i], truth.distance[i],
                   std::max(truth.distance[i], size), 2, tally))
    return;
  // On the other side of the rule for nearly parallel edges the contact points are others: only the distance_below
  // above can be compared.
  if (out.nearly_parallel[i] != truth.exact.nearly_parallel[i]) {
    if (!(out.contact_distance[i] >= out.distance_below[i]))
      tally.mismatch(
          text("contact_distance: %.9g is below distance_below %.9g", out.contact_distance[i], out.distance_below[i]));
    return;
  }
  const double distance = truth.contact_distance[i];
  tally.error(0, in_units(std::abs(out.contact_distance[i] - distance), std::max(distance, size)),
              [&] { return text("%.9g, exact %.17g", out.contact_distance[i], distance); });
  const double worst = std::max(std::abs(out.parameters[i][0] - truth.parameters[i][0]),
                                std::abs(out.parameters[i][1] - truth.parameters[i][1]));
  tally.error(1, in_units(worst, truth.parameter_condition[i]),
              [&] { return text("condition %.4g, largest error %.4g", truth.parameter_condition[i], worst); });
}

/// More than one bit set: there is more than one acceptable answer.
bool is_grey(std::uint32_t accepted) { return (accepted & (accepted - 1)) != 0; }

}  // namespace

void judge_closest_face(Cases cases, const ClosestFaceIn& in, const ClosestFaceTruth& truth, const ClosestFaceOut& out,
                        Tally& tally) {
  tally.begin(cases[0].name);
  if (!right_length(cases.size(),
                    {out.feature.size(), out.weights.size(), out.distance.size(), out.distance_below.size()}, tally))
    return;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, is_grey(truth.accepted[i]), truth.near[i]);
    double size = 0;
    for (const Vec3f& corner : in.triangle[i]) size += modulus(corner, in.point[i]);
    judge_face(i, truth, out, size, tally);
  }
}

void judge_closest_points(Cases cases, const ClosestPointsIn& in, const ClosestPointsTruth& truth,
                          const ClosestPointsOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  if (!right_length(cases.size(),
                    {out.first_feature.size(), out.second_feature.size(), out.nearly_parallel.size(),
                     out.parameters.size(), out.contact_distance.size(), out.distance_below.size()},
                    tally))
    return;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, is_grey(truth.accepted[i]), truth.near[i]);
    const Vec3f& from = in.first[i][0];
    judge_points(i, truth, out,
                 modulus(in.first[i][1], from) + modulus(in.second[i][0], from) + modulus(in.second[i][1], from),
                 tally);
  }
}

}  // namespace ogc::compare
