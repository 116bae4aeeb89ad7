// Forms of closest_face, closest_points and block.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "compare/judge/explain/form_tools.hpp"

namespace ogc::compare {

namespace {

/// Thresholds that people write: the first ones of lengths, all of them of squares and products (a length below 1e-9 m
/// is less than any tolerance here).
constexpr std::size_t lengths = 7;
constexpr std::array<std::pair<const char*, double>, 10> thresholds{{{"1e-3", 1e-3},
                                                                     {"1e-4", 1e-4},
                                                                     {"1e-5", 1e-5},
                                                                     {"1e-6", 1e-6},
                                                                     {"1e-7", 1e-7},
                                                                     {"1e-8", 1e-8},
                                                                     {"1e-9", 1e-9},
                                                                     {"1e-10", 1e-10},
                                                                     {"1e-11", 1e-11},
                                                                     {"1e-12", 1e-12}}};

Vec3 difference(const Vec3f& a, const Vec3f& b) { return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z}; }
double squared(const Vec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }
double squared_length(const std::array<Vec3f, 2>& edge) { return squared(difference(edge[1], edge[0])); }

/// The least number that is surely above a distance known to the tolerance of `distance`.
float surely_above(double distance, double size) {
  const double above = distance + closest_face_distance_tolerance * unit_roundoff * std::max(distance, size);
  return std::nextafter(static_cast<float>(above), std::numeric_limits<float>::infinity());
}

/// The truth about each case is changed, and its rounded answer with it: `change(in, i, truth)`.
template <class Change>
WrongForm face_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::closest_face,
              [change](const ClosestFaceIn& in, ClosestFaceTruth& truth) {
                for (std::size_t i = 0; i < in.point.size(); ++i) {
                  change(in, i, truth);
                  truth.exact.distance[i] = static_cast<float>(truth.distance[i]);
                  for (std::size_t k = 0; k < 3; ++k)
                    truth.exact.weights[i][k] = static_cast<float>(truth.weights[i][k]);
                }
              });
}

/// Σ|δ| of the case.
double size_of(const ClosestFaceIn& in, std::size_t i) {
  double size = 0;
  for (const Vec3f& corner : in.triangle[i]) {
    const Vec3 d = difference(corner, in.point[i]);
    size += std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  }
  return size;
}

WrongForm weights_swapped(int a, int b) {
  const std::string which = std::to_string(a) + std::to_string(b);
  return face_told("weights_swapped_" + which,
                   "the weights of vertices " + std::to_string(a) + " and " + std::to_string(b) + " exchanged",
                   [a, b](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
                     std::swap(truth.weights[i][a], truth.weights[i][b]);
                   });
}

/// An interior point with a weight below epsilon counts as on the edge.
void without_small_weights(ClosestFaceTruth& truth, std::size_t i, double epsilon) {
  constexpr std::array opposite{TriangleFeature::edge_12, TriangleFeature::edge_20, TriangleFeature::edge_01};
  if (truth.exact.feature[i] != TriangleFeature::interior) return;
  const auto least = std::min_element(truth.weights[i].begin(), truth.weights[i].end());
  if (*least >= epsilon) return;
  truth.exact.feature[i] = opposite[static_cast<std::size_t>(least - truth.weights[i].begin())];
  truth.accepted[i] = static_cast<std::uint8_t>(1u << static_cast<unsigned>(truth.exact.feature[i]));
}

}  // namespace

std::vector<WrongForm> closest_face_forms() {
  std::vector<WrongForm> forms{
      weights_swapped(0, 1),
      weights_swapped(1, 2),
      weights_swapped(0, 2),
      face_told("squared_distance", "d² for d",
                [](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
                  truth.distance[i] *= truth.distance[i];
                  truth.exact.distance_below[i] = surely_above(truth.distance[i], 0);
                }),
      face_told("not_rounded_down",
                "`distance_below` as exact as `distance`, but rounded to nearest: it may lie above the exact distance",
                [](const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
                  truth.exact.distance_below[i] = surely_above(truth.distance[i], size_of(in, i));
                }),
      face_told(
          "distance_below_is_zero", "`distance_below` is 0 everywhere: a bound, and no use",
          [](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) { truth.exact.distance_below[i] = 0; })};
  for (const auto& [text, epsilon] : std::span(thresholds).first(lengths)) {
    forms.push_back(face_told("distance_floor_" + std::string(text),
                              "distances never below an absolute epsilon of " + std::string(text) + " m",
                              [e = epsilon](const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
                                if (truth.distance[i] >= e) return;
                                truth.distance[i] = e;
                                truth.exact.distance_below[i] = surely_above(e, size_of(in, i));
                              }));
    forms.push_back(
        face_told("floor_" + std::string(text) + "_of_distance_alone",
                  "`distance` never below an absolute epsilon of " + std::string(text) + " m, `distance_below` right",
                  [e = epsilon](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
                    truth.distance[i] = std::max(truth.distance[i], e);
                  }));
    forms.push_back(face_told(
        "weights_below_" + std::string(text) + "_are_zero",
        "an interior point with a weight below an absolute epsilon of " + std::string(text) + " counts as on the edge",
        [e = epsilon](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
          without_small_weights(truth, i, e);
        }));
  }
  return forms;
}

namespace {

template <class Change>
WrongForm points_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::closest_points,
              [change](const ClosestPointsIn&, ClosestPointsTruth& truth) {
                for (std::size_t i = 0; i < truth.accepted.size(); ++i) {
                  change(truth, i);
                  truth.exact.contact_distance[i] = static_cast<float>(truth.contact_distance[i]);
                  for (std::size_t k = 0; k < 2; ++k)
                    truth.exact.parameters[i][k] = static_cast<float>(truth.parameters[i][k]);
                }
              });
}

/// Accepts this triple of features alone.
void accept(ClosestPointsTruth& truth, std::size_t i) {
  const auto& exact = truth.exact;
  truth.accepted[i] = 1u << (static_cast<unsigned>(exact.first_feature[i]) +
                             3 * static_cast<unsigned>(exact.second_feature[i]) + 9u * exact.nearly_parallel[i]);
}

EdgeFeature other_end(EdgeFeature feature) {
  return feature == EdgeFeature::end_0   ? EdgeFeature::end_1
         : feature == EdgeFeature::end_1 ? EdgeFeature::end_0
                                         : feature;
}

void without_parallel_rule(ClosestPointsTruth& truth, std::size_t i) {
  if (!truth.exact.nearly_parallel[i]) return;
  constexpr std::uint32_t any_features = (1u << 9) - 1;
  truth.accepted[i] = any_features;
  truth.exact.nearly_parallel[i] = 0;
  truth.contact_distance[i] = truth.distance[i];
  truth.parameter_condition[i] =
      std::numeric_limits<double>::infinity();  // which of the many closest points is meant, the rule alone says
}

/// ‖e × e'‖².
double parallelism(const std::array<Vec3f, 2>& first, const std::array<Vec3f, 2>& second) {
  const Vec3 a = difference(first[1], first[0]), b = difference(second[1], second[0]);
  return squared({a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x});
}

}  // namespace

std::vector<WrongForm> closest_points_forms() {
  std::vector<WrongForm> forms{
      points_told("parallel_rule_missing", "nearly parallel edges are treated as all others", without_parallel_rule),
      points_told("second_ends_swapped", "the second edge read from its other end",
                  [](ClosestPointsTruth& truth, std::size_t i) {
                    truth.exact.second_feature[i] = other_end(truth.exact.second_feature[i]);
                    truth.parameters[i][1] = 1 - truth.parameters[i][1];
                    accept(truth, i);
                  }),
      points_told("edges_swapped", "features and parameters of the two edges exchanged",
                  [](ClosestPointsTruth& truth, std::size_t i) {
                    std::swap(truth.exact.first_feature[i], truth.exact.second_feature[i]);
                    std::swap(truth.parameters[i][0], truth.parameters[i][1]);
                    accept(truth, i);
                  }),
      points_told("squared_distance", "d² for d", [](ClosestPointsTruth& truth, std::size_t i) {
        truth.contact_distance[i] *= truth.contact_distance[i];
        truth.distance[i] *= truth.distance[i];
        truth.exact.distance_below[i] = surely_above(truth.distance[i], 0);
      })};
  for (const auto& [text, epsilon] : thresholds) {
    forms.push_back(asked("edges_of_squared_length_below_" + std::string(text) + "_are_points",
                          "an absolute threshold on squared lengths: an edge with ‖e‖² < " + std::string(text) +
                              " m² counts as its end 0",
                          &Authority::closest_points, [e = epsilon](ClosestPointsIn& in) {
                            for (auto* edges : {&in.first, &in.second})
                              for (auto& edge : *edges)
                                if (squared_length(edge) < e) edge[1] = edge[0];
                          }));
    forms.push_back(asked(
        "end_0_where_cross_product_below_" + std::string(text),
        "an absolute threshold on ‖e × e'‖²: below " + std::string(text) + " m⁴ the first edge counts as its end 0",
        &Authority::closest_points, [e = epsilon](ClosestPointsIn& in) {
          for (std::size_t i = 0; i < in.first.size(); ++i)
            if (parallelism(in.first[i], in.second[i]) < e) in.first[i][1] = in.first[i][0];
        }));
  }
  return forms;
}

std::vector<WrongForm> block_forms() {
  const auto changed = [](std::string name, std::string meaning, std::uint8_t (*change)(std::uint8_t)) {
    return told(std::move(name), std::move(meaning), &Authority::block, [change](const BlockIn&, BlockTruth& truth) {
      for (std::uint8_t& inside : truth.inside) inside = change(inside);
    });
  };
  return {
      changed("inverted", "inside for outside", [](std::uint8_t inside) { return static_cast<std::uint8_t>(!inside); }),
      changed("always_inside", "every point counts as inside: no test at all",
              [](std::uint8_t) { return std::uint8_t{1}; }),
      changed("always_outside", "no point counts as inside", [](std::uint8_t) { return std::uint8_t{0}; })};
}

}  // namespace ogc::compare
