#include "compare/judge/stages/closest_face_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/pairs.hpp"
#include "compare/stages/closest_points.hpp"

namespace ogc::compare {

namespace {

using Weights = std::array<double, 3>;
using Right = Ask<ClosestFaceTruth, ClosestFaceIn>;

constexpr std::array opposite_edge{TriangleFeature::edge_12, TriangleFeature::edge_20, TriangleFeature::edge_01};

/// Accepts only this feature.
void accept(ClosestFaceTruth& truth, std::size_t i, TriangleFeature feature) {
  truth.exact.feature[i] = feature;
  truth.accepted[i] = static_cast<std::uint8_t>(1u << static_cast<unsigned>(feature));
}

/// Rounds distance and weights into the answer.
void round_answer(ClosestFaceTruth& truth, std::size_t i) {
  truth.exact.distance[i] = static_cast<float>(truth.distance[i]);
  for (std::size_t k = 0; k < 3; ++k) truth.exact.weights[i][k] = static_cast<float>(truth.weights[i][k]);
}

/// Makes a form that changes the truth of each case by `change(in, i, truth)`, and rounds the answer again.
template <class Change>
WrongForm face_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::closest_face,
              [change](const ClosestFaceIn& in, ClosestFaceTruth& truth) {
                for (std::size_t i = 0; i < in.point.size(); ++i) {
                  change(in, i, truth);
                  round_answer(truth, i);
                }
              });
}

/// Returns Σ|δ| of the case.
double size_of(const ClosestFaceIn& in, std::size_t i) {
  double size = 0;
  for (const Vec3f& corner : in.triangle[i]) size += modulus(corner, in.point[i]);
  return size;
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The triangle relative to the point.
struct Seen {
  explicit Seen(const ClosestFaceIn& in, std::size_t i)
      : corner{difference(in.triangle[i][0], in.point[i]), difference(in.triangle[i][1], in.point[i]),
               difference(in.triangle[i][2], in.point[i])},
        normal(cross(difference(in.triangle[i][1], in.triangle[i][0]),
                     difference(in.triangle[i][2], in.triangle[i][0]))) {}

  /// Returns the weights of the foot on the triangle's plane; NaN for a triangle without area.
  Weights foot() const {
    Weights w;
    for (std::size_t k = 0; k < 3; ++k)
      w[k] = dot(cross(corner[(k + 1) % 3], corner[(k + 2) % 3]), normal) / dot(normal, normal);
    return w;
  }

  /// Returns twice the areas of the triangles between the point and each edge.
  Weights areas() const {
    Weights a;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 n = cross(corner[(k + 1) % 3], corner[(k + 2) % 3]);
      a[k] = std::sqrt(dot(n, n));
    }
    return a;
  }

  /// Returns the distance to the point with these weights [m].
  double distance(const Weights& w) const {
    Vec3 to{};
    for (std::size_t k = 0; k < 3; ++k)
      to = {to.x + w[k] * corner[k].x, to.y + w[k] * corner[k].y, to.z + w[k] * corner[k].z};
    return std::sqrt(dot(to, to));
  }

  double area() const { return std::sqrt(dot(normal, normal)); }  ///< twice the area [m²]

  std::array<Vec3, 3> corner;
  Vec3 normal;
};

double sum_of(const Weights& w) { return std::accumulate(w.begin(), w.end(), 0.0); }
Weights over_their_sum(Weights w) {
  const double sum = sum_of(w);
  for (double& x : w) x /= sum;
  return w;
}
Weights moduli(Weights w) {
  for (double& x : w) x = std::abs(x);
  return w;
}

/// Makes the point with weights w the truth. These weights are not compared, because the mistake is the choice of the
/// point.
void say_point(const ClosestFaceIn& in, std::size_t i, const Weights& w, ClosestFaceTruth& truth) {
  truth.weights[i] = w;
  truth.weight_condition[i] = std::numeric_limits<double>::infinity();
  truth.distance[i] = Seen(in, i).distance(w);
  truth.exact.distance_below[i] = surely_above(truth.distance[i], size_of(in, i));
}

// Forms that permute corners or weights.

struct NamedOrder {
  const char* name;
  std::array<std::size_t, 3> of;  ///< entry k is replaced by entry of[k]
};
constexpr std::array<NamedOrder, 5> orders{{{"swapped_01", {1, 0, 2}},
                                            {"swapped_12", {0, 2, 1}},
                                            {"swapped_02", {2, 1, 0}},
                                            {"rotated_120", {1, 2, 0}},
                                            {"rotated_201", {2, 0, 1}}}};

std::string order_text(const std::array<std::size_t, 3>& of) {
  return std::to_string(of[0]) + ", " + std::to_string(of[1]) + ", " + std::to_string(of[2]);
}

void add_permutations(std::vector<WrongForm>& forms) {
  for (const auto& [name, of] : orders) {
    forms.push_back(face_told("weights_" + std::string(name),
                              "where the weights of vertices 0, 1, 2 belong, those of " + order_text(of),
                              [order = of](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
                                const Weights w = truth.weights[i];
                                for (std::size_t k = 0; k < 3; ++k) truth.weights[i][k] = w[order[k]];
                              }));
    forms.push_back(asked("corners_" + std::string(name),
                          "feature and weights of the triangle whose vertices 0, 1, 2 are " + order_text(of),
                          &Authority::closest_face, [order = of](ClosestFaceIn& in) {
                            for (auto& t : in.triangle) t = {t[order[0]], t[order[1]], t[order[2]]};
                          }));
  }
  forms.push_back(face_told("weights_swapped_on_edges", "the weights of an edge's two ends exchanged, others right",
                            [](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
                              const auto edge = static_cast<std::size_t>(truth.exact.feature[i]) - 3;
                              if (edge < 3) std::swap(truth.weights[i][edge], truth.weights[i][(edge + 1) % 3]);
                            }));
  forms.push_back(face_told("weights_swapped_on_edge_20", "the weights of edge (2,0) exchanged, others right",
                            [](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
                              if (truth.exact.feature[i] == TriangleFeature::edge_20)
                                std::swap(truth.weights[i][2], truth.weights[i][0]);
                            }));
}

// Forms that choose an edge or corner that is not the nearest.

/// Makes the closest point of one edge the truth. The authority computes it by closest_points; for an edge without
/// length it is the edge's first end.
void take_edge(const Authority& authority, const ClosestFaceIn& in, std::size_t i, std::size_t edge,
               ClosestFaceTruth& truth) {
  const std::size_t from = edge, to = (edge + 1) % 3;
  const ClosestPointsTruth points = authority.closest_points(
      {{{in.point[i], in.point[i]}}, {{in.triangle[i][from], in.triangle[i][to]}}});
  const std::array<std::size_t, 3> feature{from, to, edge + 3};
  truth.exact.feature[i] = static_cast<TriangleFeature>(
      feature.at(static_cast<std::size_t>(points.exact.second_feature[0])));
  truth.accepted[i] = 0;
  for (std::size_t code = 0; code < 9; ++code)
    if ((points.accepted[0] >> code & 1) != 0)
      truth.accepted[i] = static_cast<std::uint8_t>(truth.accepted[i] | 1u << feature[code / 3]);
  truth.weights[i] = {};
  truth.weights[i][to] = points.parameters[0][1];
  truth.weights[i][from] = 1 - points.parameters[0][1];
  truth.weight_condition[i] = points.parameter_condition[0];
  truth.distance[i] = points.distance[0];
  truth.exact.distance_below[i] = points.exact.distance_below[0];
  round_answer(truth, i);
}

void take_corner(const ClosestFaceIn& in, std::size_t i, std::size_t corner, ClosestFaceTruth& truth) {
  Weights w{};
  w[corner] = 1;
  say_point(in, i, w, truth);
  truth.weight_condition[i] = 1;
  accept(truth, i, static_cast<TriangleFeature>(corner));
  round_answer(truth, i);
}

/// Makes a form that replaces the truth by `choose(authority, in, i, truth)` if the triangle has an area and its
/// closest point is not in the interior.
template <class Choose>
WrongForm chosen_outside(std::string name, std::string meaning, Choose choose) {
  return form_of(std::move(name), std::move(meaning), [choose](const Authority& authority) {
    Authority wrong = authority;
    wrong.closest_face = [authority, choose](const ClosestFaceIn& in) {
      ClosestFaceTruth truth = authority.closest_face(in);
      for (std::size_t i = 0; i < in.point.size(); ++i)
        if (truth.exact.feature[i] != TriangleFeature::interior && Seen(in, i).area() > 0)
          choose(authority, in, i, truth);
      return truth;
    };
    return wrong;
  });
}

/// Makes the form that takes the closest point of one edge. This edge is the first one, in the given order, that
/// separates the foot from the triangle.
WrongForm first_edge_of(const std::array<std::size_t, 3>& order) {
  constexpr std::array<const char*, 3> edges{"01", "12", "20"};
  const std::string which = std::string(edges[order[0]]) + "_" + edges[order[1]] + "_" + edges[order[2]];
  return chosen_outside(
      "first_edge_of_" + which + "_for_the_nearest",
      "the first edge that the foot lies beyond, in this order, where another one is nearer",
      [order](const Authority& authority, const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
        const Weights w = Seen(in, i).foot();
        for (const std::size_t edge : order)
          if (w[(edge + 2) % 3] <= 0) return take_edge(authority, in, i, edge, truth);
      });
}

/// Chooses corner or edge by the number of positive weights. This is wrong near an obtuse corner: an edge may be
/// nearer.
void by_signs(const Authority& authority, const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
  const Weights w = Seen(in, i).foot();
  const auto positive = std::count_if(w.begin(), w.end(), [](double x) { return x > 0; });
  for (std::size_t k = 0; k < 3; ++k) {
    if (positive == 1 && w[k] > 0) return take_corner(in, i, k, truth);
    if (positive == 2 && !(w[k] > 0)) return take_edge(authority, in, i, (k + 1) % 3, truth);
  }
}

/// Sets negative weights to 0 and divides the others by their sum.
void by_clamping(const Authority&, const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
  Weights w = Seen(in, i).foot();
  for (double& x : w) x = std::max(x, 0.0);
  w = over_their_sum(w);
  const auto positive = std::count_if(w.begin(), w.end(), [](double x) { return x > 0; });
  say_point(in, i, w, truth);
  for (std::size_t k = 0; k < 3; ++k) {
    if (positive == 1 && w[k] > 0) accept(truth, i, static_cast<TriangleFeature>(k));
    if (positive == 2 && !(w[k] > 0)) accept(truth, i, opposite_edge[k]);
  }
  round_answer(truth, i);
}

/// Makes the nearest corner the answer.
void nearest_corner(const Authority&, const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
  const Seen seen(in, i);
  const auto squared = [](const Vec3& v) { return dot(v, v); };
  take_corner(in, i, static_cast<std::size_t>(std::ranges::min_element(seen.corner, {}, squared) - seen.corner.begin()),
              truth);
}
void nearest_line(const Authority& authority, const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
  const Seen seen(in, i);
  Weights squared;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 e = difference(in.triangle[i][(k + 1) % 3], in.triangle[i][k]), n = cross(e, seen.corner[k]);
    squared[k] = dot(n, n) / dot(e, e);
  }
  take_edge(authority, in, i, static_cast<std::size_t>(std::ranges::min_element(squared) - squared.begin()), truth);
}

void add_choices(std::vector<WrongForm>& forms) {
  for (const std::array<std::size_t, 3>& order :
       {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}})
    forms.push_back(first_edge_of(order));
  for (std::size_t edge = 0; edge < 3; ++edge)
    forms.push_back(chosen_outside("edge_" + std::to_string(edge) + std::to_string((edge + 1) % 3) + "_for_the_nearest",
                                   "always this edge, whichever is nearest",
                                   [edge](const Authority& authority, const ClosestFaceIn& in, std::size_t i,
                                          ClosestFaceTruth& truth) { take_edge(authority, in, i, edge, truth); }));
  forms.push_back(
      chosen_outside("corner_for_the_nearest", "the nearest corner, where an edge is nearer", nearest_corner));
  forms.push_back(chosen_outside("edge_of_the_nearest_line",
                                 "the edge whose line is nearest, where the segment of another one is", nearest_line));
  forms.push_back(chosen_outside("signs_choose_the_feature",
                                 "the signs of the weights choose corner or edge; beside an obtuse corner the nearest "
                                 "is another",
                                 by_signs));
  forms.push_back(chosen_outside("weights_clamped",
                                 "negative weights set to 0 and the rest divided by their sum, in place of the closest "
                                 "point",
                                 by_clamping));
}

// Forms that add areas.

constexpr unsigned inside_bit = 1u << static_cast<unsigned>(TriangleFeature::interior);
/// Limit of the rounding error of a sum of three weights; each weight has ten roundings in double.
constexpr double sum_rounding = 30 * 0x1p-53;

/// Makes the form that adds areas without sign. It counts the foot as inside if the areas of the three triangles
/// between foot and edges sum to at most the triangle's area plus `slack(area)`. All areas are doubled [m²].
template <class Slack>
WrongForm areas_add_up(std::string name, const std::string& slack_text, Slack slack) {
  return face_told(std::move(name),
                   "inside where three areas without signs add up to the triangle's within " + slack_text,
                   [slack](const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
                     const Seen seen(in, i);
                     const Weights w = moduli(seen.foot());
                     if (truth.exact.feature[i] == TriangleFeature::interior ||
                         !((sum_of(w) - 1) * seen.area() <= slack(seen.area())))
                       return;
                     // The foot is on the triangle's boundary. There the areas add up to the triangle's area, so the
                     // form accepts the right feature and the interior.
                     if (sum_of(w) - 1 <= sum_rounding) {
                       truth.accepted[i] = static_cast<std::uint8_t>(truth.accepted[i] | inside_bit);
                       return;
                     }
                     say_point(in, i, over_their_sum(w), truth);
                     accept(truth, i, TriangleFeature::interior);
                   });
}

void add_areas(std::vector<WrongForm>& forms) {
  forms.push_back(areas_add_up("areas_without_signs", "anything: every foot counts as inside",
                               [](double) { return std::numeric_limits<double>::infinity(); }));
  for (const auto& [text, epsilon] : std::span(thresholds).first(length_thresholds)) {
    forms.push_back(areas_add_up("areas_add_up_to_a_share_of_" + std::string(text), std::string(text) + " of it",
                                 [e = epsilon](double area) { return e * area; }));
    forms.push_back(areas_add_up("areas_add_up_to_" + std::string(text), std::string(text) + " m²",
                                 [e = epsilon](double) { return 2 * e; }));
  }
  const auto weights_of_point = [](const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
    if (truth.exact.feature[i] == TriangleFeature::interior) truth.weights[i] = over_their_sum(Seen(in, i).areas());
  };
  forms.push_back(face_told("areas_of_the_point_for_weights",
                            "weights from areas of the point itself, not of its foot: `distance` right",
                            weights_of_point));
  forms.push_back(face_told("areas_of_the_point_for_the_foot",
                            "weights from areas of the point itself, not of its foot, and the distance of that point",
                            [weights_of_point](const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
                              weights_of_point(in, i, truth);
                              if (truth.exact.feature[i] != TriangleFeature::interior) return;
                              truth.distance[i] = Seen(in, i).distance(truth.weights[i]);
                              truth.exact.distance_below[i] = surely_above(truth.distance[i], size_of(in, i));
                            }));
}

// Forms with thresholds.

/// Counts an interior point with a weight below epsilon as a point of the opposite edge.
void without_small_weights(ClosestFaceTruth& truth, std::size_t i, double epsilon) {
  if (truth.exact.feature[i] != TriangleFeature::interior) return;
  const auto least = std::min_element(truth.weights[i].begin(), truth.weights[i].end());
  if (*least >= epsilon) return;
  accept(truth, i, opposite_edge[static_cast<std::size_t>(least - truth.weights[i].begin())]);
}

void add_thresholds(std::vector<WrongForm>& forms) {
  for (const auto& [text, epsilon] : std::span(thresholds).first(length_thresholds)) {
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
}

// Forms that depend on the answer.

ClosestFaceIn question_of(const Evidence& evidence) {
  const auto& c = case_of<ClosestFaceCase>(evidence.test.data);
  return {{c.point}, {c.triangle}};
}

/// Checks whether the triangle's height is below 2⁻⁹ of its longest side, as in compare/stages/contact_force.hpp.
bool is_needle(const ClosestFaceIn& in) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = difference(in.triangle[0][k], in.triangle[0][(k + 1) % 3]);
    longest = std::max(longest, dot(side, side));
  }
  return Seen(in, 0).area() <= 0x1p-9 * longest;
}

/// Checks whether the answer is NaN for a needle, and right for other triangles.
bool is_nan_of_needle(const Evidence& evidence, const Authority& authority) {
  const ClosestFaceIn in = question_of(evidence);
  const ClosestFaceOut out = evidence.answered.closest_face(in);
  const bool is_nan = std::isnan(out.distance.at(0)) || std::isnan(out.weights.at(0)[0]) ||
                      std::isnan(out.weights[0][1]) || std::isnan(out.weights[0][2]);
  return is_nan ? is_needle(in) : agrees(evidence, authority);
}

/// Checks whether the answer is right. If the closest point is not in the interior, the distance to the triangle's
/// plane also counts as right.
bool is_distance_of_plane(const Evidence& evidence, const Authority& authority) {
  const ClosestFaceIn in = question_of(evidence);
  const ClosestFaceTruth truth = authority.closest_face(in);
  const Seen seen(in, 0);
  if (truth.exact.feature[0] == TriangleFeature::interior || !(seen.area() > 0)) return agrees(evidence, authority);
  const double plane = std::abs(dot(seen.corner[0], seen.normal)) / seen.area(), size = size_of(in, 0);
  const double off = std::abs(evidence.answered.closest_face(in).distance.at(0) - plane);
  return off <= closest_face_distance_tolerance * unit_roundoff * std::max(plane, size) || agrees(evidence, authority);
}

/// Checks whether the answer is right, or wrong only in its feature and weights. A rounded comparison may choose a
/// wrong feature whose distance equals that of a right feature in single precision.
bool is_rounded_choice(const Evidence& evidence, const Authority& authority) {
  const ClosestFaceIn in = question_of(evidence);
  const ClosestFaceOut out = evidence.answered.closest_face(in);
  Authority wrong = authority;
  wrong.closest_face = [&](const ClosestFaceIn& asked) {
    ClosestFaceTruth truth = authority.closest_face(asked);
    const auto feature = static_cast<unsigned>(out.feature.at(0));
    if ((truth.accepted[0] >> std::min(feature, 7u) & 1) != 0 || feature > 6) return truth;
    truth.accepted[0] = static_cast<std::uint8_t>(truth.accepted[0] | 1u << feature);
    truth.weight_condition[0] = std::numeric_limits<double>::infinity();
    return truth;
  };
  return agrees(evidence, wrong);
}

}  // namespace

std::vector<WrongForm> closest_face_forms() {
  std::vector<WrongForm> forms;
  add_permutations(forms);
  add_choices(forms);
  add_areas(forms);
  forms.push_back(
      face_told("squared_distance", "d² for d", [](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) {
        truth.distance[i] *= truth.distance[i];
        truth.exact.distance_below[i] = surely_above(truth.distance[i], 0);
      }));
  forms.push_back(face_told("not_rounded_down",
                            "`distance_below` as exact as `distance`, but rounded to nearest: it may lie above the "
                            "exact distance",
                            [](const ClosestFaceIn& in, std::size_t i, ClosestFaceTruth& truth) {
                              truth.exact.distance_below[i] = surely_above(truth.distance[i], size_of(in, i));
                            }));
  forms.push_back(face_told(
      "distance_below_is_zero", "`distance_below` is 0 everywhere: a bound, and no use",
      [](const ClosestFaceIn&, std::size_t i, ClosestFaceTruth& truth) { truth.exact.distance_below[i] = 0; }));
  add_thresholds(forms);
  forms.push_back({.name = "nan_for_needles",
                   .meaning = "no number where the triangle's height is below 2⁻⁹ of its longest side, all else right",
                   .fits = is_nan_of_needle});
  forms.push_back({.name = "rounded_choice",
                   .meaning = "a feature next to the right one, chosen by rounded numbers, at the right distance",
                   .fits = is_rounded_choice,
                   .is_vague = true});
  forms.push_back({.name = "plane_for_the_triangle",
                   .meaning = "the distance of the triangle's plane: weights are not clamped",
                   .fits = is_distance_of_plane,
                   .is_vague = true});
  return forms;
}

}  // namespace ogc::compare
