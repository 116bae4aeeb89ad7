// Makes the traits of stage closest_points. In the canonical frame of the ladders the first edge is on the x axis, and
// the second edge is above it. So the planes through the ends of the first edge are coordinate planes.
#include <array>
#include <limits>
#include <span>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/pairs.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData finish(const std::array<Vec3, 4>& points) {
  return ClosestPointsCase{{single(points[0]), single(points[1])}, {single(points[2]), single(points[3])}};
}

/// Swaps ends and edges at random and places the case.
CaseData placed(Random& random, std::array<Vec3, 4> points) {
  if (random.one_in(2)) std::swap(points[0], points[1]);
  if (random.one_in(2)) std::swap(points[2], points[3]);
  if (random.one_in(2)) {
    std::swap(points[0], points[2]);
    std::swap(points[1], points[3]);
  }
  place(random, points);
  return finish(points);
}

double height(Random& random) { return random.one_in(3) ? random.rung() : random.sign() * random.magnitude(-3, 0); }

CaseData uniform(Random& random) { return finish(points_in_box(random)); }
CaseData bits(Random& random) { return finish(points_of_bits(random)); }
CaseData lattice(Random& random) { return finish(points_on_lattice(random, 2)); }

/// Returns two edges that cross in both interiors, seen from above, at an angle of this sine.
std::array<Vec3, 4> crossing(Random& random, double sine, double z) {
  const double length = random.magnitude(-1, 1), s = random.between(0.05, 0.95), t = random.between(0.05, 0.95);
  const double cosine = std::sqrt(1 - sine * sine);
  return {Vec3{-s, 0, 0}, Vec3{1 - s, 0, 0}, Vec3{-t * length * cosine, -t * length * sine, z},
          Vec3{(1 - t) * length * cosine, (1 - t) * length * sine, z}};
}

/// Approaches an angle of 0 between edges that cross in their interiors.
CaseData parallel(Random& random) { return placed(random, crossing(random, std::abs(random.rung()), height(random))); }

/// Approaches the limit of nearly parallel edges, sine² = 10⁻⁶, from both sides.
CaseData threshold(Random& random) {
  return placed(random, crossing(random, 1e-3 * (1 + random.rung()), height(random)));
}

/// Makes edges that are parallel or tilted by a rung. Measured along the first edge, they overlap by a rung or have a
/// gap of a rung.
CaseData overlap(Random& random) {
  const double length = random.magnitude(-1, 1), shift = random.one_in(2) ? 1 : -length,
               tilt = random.one_in(2) ? 0 : random.rung();
  const double x = shift + random.rung(), y = random.one_in(2) ? 0 : random.between(-1, 1), z = height(random);
  return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{x, y, z}, Vec3{x + length, y, z + tilt * length}});
}

/// Makes parallel edges in general position.
CaseData exact_parallel(Random& random) {
  const double x = random.between(-2, 2), length = random.magnitude(-1, 1),
               y = random.one_in(2) ? 0 : random.between(-1, 1), z = height(random);
  return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{x, y, z}, Vec3{x + length, y, z}});
}

/// Makes the closest point of the first edge approach an end of this edge. The closest point of the second edge is
/// anywhere.
CaseData end(Random& random) {
  const double x = random.rung(), slope = random.one_in(2) ? 0 : random.between(-2, 2), z = height(random);
  const double low = random.one_in(3) ? random.rung() : -random.between(0.1, 1), high = random.between(0.1, 1);
  return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{x + slope * low, low, z}, Vec3{x + slope * high, high, z}});
}

/// Approaches a length of 0 for one or both edges.
CaseData zero_length(Random& random) {
  const Vec3 a = on_lattice(random, 2);
  const Vec3 short_side{random.rung(), random.one_in(2) ? 0 : random.rung(), 0};
  const Vec3 p = random.one_in(3) ? Vec3{} : in_box(random, -1, 1),
             q = random.one_in(4) ? sum(p, {0, random.rung(), 0}) : in_box(random, -1, 1);
  std::array<Vec3, 4> points{Vec3{}, short_side, p, q};
  if (random.one_in(2))
    for (Vec3& x : points) x = sum(x, a);
  return placed(random, points);
}

/// Approaches a distance of 0: crossing edges, an end on an interior, a common end, equal edges, edges on one line.
CaseData near(Random& random) {
  const double z = random.rung();
  switch (random.below(5)) {
    case 0: return placed(random, crossing(random, random.between(0.1, 1), z));
    case 1:
      return placed(random,
                    {Vec3{}, Vec3{1, 0, 0}, Vec3{random.unit(), 0, z}, Vec3{random.unit(), random.between(-1, 1), 1}});
    case 2: return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 0, z}, in_box(random, -1, 1)});
    case 3: return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 0, z}, Vec3{1, 0, z}});
    default: return placed(random, {Vec3{}, Vec3{1, 0, 0}, Vec3{1 + z, 0, 0}, Vec3{2 + z, 0, 0}});
  }
}

/// Puts short edges far from the origin, where differences of coordinates have few bits.
CaseData offset(Random& random) {
  const Vec3 far = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  std::array<Vec3, 4> points;
  for (Vec3& p : points) p = sum(far, in_box(random, 0, 1));
  return finish(points);
}

/// Makes cases of `threshold`, `overlap` and `end` with rungs of at most 10⁻⁵.
CaseData boundary(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 3> ladders{threshold, overlap, end};
  random.be_fine();
  return random.pick(std::span<CaseData (*const)(Random&)>(ladders))(random);
}

constexpr std::array<Generator, 13> table{{{"uniform", 12, true, uniform},
                                           {"bits", 12, false, bits},
                                           {"dust", 6, false, uniform},
                                           {"lattice", 20, false, lattice},
                                           {"ladder.parallel", 10, false, parallel},
                                           {"ladder.threshold", 8, false, threshold},
                                           {"ladder.overlap", 8, false, overlap},
                                           {"ladder.exact_parallel", 6, false, exact_parallel},
                                           {"ladder.end", 8, false, end},
                                           {"ladder.zero_length", 5, false, zero_length},
                                           {"ladder.near", 6, false, near},
                                           {"ladder.offset", 5, false, offset},
                                           {"ladder.boundary", 120, false, boundary}}};

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

/// Returns Σ|δ| of the case.
double size_of(const ClosestPointsIn& in, std::size_t i) {
  const Vec3f& from = in.first[i][0];
  return modulus(in.first[i][1], from) + modulus(in.second[i][0], from) + modulus(in.second[i][1], from);
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
  // If the flags differ, so do the contact points. Then contact_distance is only compared with distance_below (judged
  // above).
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

}  // namespace

void judge_closest_points(Cases cases, const ClosestPointsIn& in, const ClosestPointsTruth& truth,
                          const ClosestPointsOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  if (!right_lengths(cases.size(),
                     {out.first_feature.size(), out.second_feature.size(), out.nearly_parallel.size(),
                      out.parameters.size(), out.contact_distance.size(), out.distance_below.size()},
                     tally))
    return;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, is_grey(truth.accepted[i]), truth.near[i]);
    judge_points(i, truth, out, size_of(in, i), tally);
  }
}

namespace {

double squared(const Vec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }
double squared_length(const std::array<Vec3f, 2>& edge) { return squared(difference(edge[1], edge[0])); }

/// Rounds distance and parameters into the answer.
void round_answer(ClosestPointsTruth& truth, std::size_t i) {
  truth.exact.contact_distance[i] = static_cast<float>(truth.contact_distance[i]);
  for (std::size_t k = 0; k < 2; ++k) truth.exact.parameters[i][k] = static_cast<float>(truth.parameters[i][k]);
}

template <class Change>
WrongForm points_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::closest_points,
              [change](const ClosestPointsIn&, ClosestPointsTruth& truth) {
                for (std::size_t i = 0; i < truth.accepted.size(); ++i) {
                  change(truth, i);
                  round_answer(truth, i);
                }
              });
}

/// Accepts only the combination of features and flag in truth.exact.
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
      std::numeric_limits<double>::infinity();  // only the rule chooses one of many pairs of closest points
}

/// Returns ‖e × e'‖² [m⁴].
double parallelism(const std::array<Vec3f, 2>& first, const std::array<Vec3f, 2>& second) {
  const Vec3 a = difference(first[1], first[0]), b = difference(second[1], second[0]);
  return squared({a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x});
}

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Answers by the rule for nearly parallel edges at any angle: the first contact point is the middle of the overlap, if
/// there is one.
void with_parallel_rule(const ClosestPointsIn& in, ClosestPointsTruth& truth, std::size_t i) {
  const auto& [a, a_end] = in.first[i];
  const auto& [b, b_end] = in.second[i];
  const Vec3 e = difference(a_end, a), f = difference(b_end, b), to_b = difference(b, a);
  const double ee = dot(e, e), ff = dot(f, f), from = dot(to_b, e) / ee, to = dot(difference(b_end, a), e) / ee;
  const double low = std::max(0.0, std::min(from, to)), high = std::min(1.0, std::max(from, to));
  if (!(low < high) || !(ff > 0)) return;
  const double s = (low + high) / 2;
  const Vec3 seen{s * e.x - to_b.x, s * e.y - to_b.y, s * e.z - to_b.z};
  const double t = std::clamp(dot(seen, f) / ff, 0.0, 1.0);
  truth.parameters[i] = {s, t};
  // Parameters are dot products divided by the edges' squared lengths.
  const double size = modulus(a_end, a) + modulus(b, a) + modulus(b_end, a);
  truth.parameter_condition[i] = 1 + size * (1 / std::sqrt(ee) + 1 / std::sqrt(ff)) * (1 + std::sqrt(ee / ff));
  truth.contact_distance[i] = std::sqrt(squared({seen.x - t * f.x, seen.y - t * f.y, seen.z - t * f.z}));
  truth.exact.first_feature[i] = truth.exact.second_feature[i] = EdgeFeature::interior;
  truth.exact.nearly_parallel[i] = 1;
  accept(truth, i);
}

/// Makes the form that has an absolute threshold on ‖e × e'‖² instead of one on the sine.
WrongForm parallel_by_threshold(const char* text, double epsilon) {
  return told("nearly_parallel_where_cross_product_below_" + std::string(text),
              "edges count as nearly parallel by an absolute threshold: ‖e × e'‖² below " + std::string(text) + " m⁴",
              &Authority::closest_points, [epsilon](const ClosestPointsIn& in, ClosestPointsTruth& truth) {
                for (std::size_t i = 0; i < truth.accepted.size(); ++i) {
                  if (!(parallelism(in.first[i], in.second[i]) < epsilon))
                    without_parallel_rule(truth, i);
                  else if (!truth.exact.nearly_parallel[i])
                    with_parallel_rule(in, truth, i);
                  round_answer(truth, i);
                }
              });
}

EdgeFeature feature_at(double t) {
  return t <= 0 ? EdgeFeature::end_0 : t >= 1 ? EdgeFeature::end_1 : EdgeFeature::interior;
}

/// Replaces the closest points by the start a of the first edge and the point b of the second edge that is nearest to
/// a. If b is an end, a is replaced by the point of the first edge that is nearest to b. The result is right for
/// parallel edges.
void from_start(const ClosestPointsIn& in, ClosestPointsTruth& truth, std::size_t i) {
  const Vec3 e = difference(in.first[i][1], in.first[i][0]), f = difference(in.second[i][1], in.second[i][0]),
             r = difference(in.first[i][0], in.second[i][0]);
  const double ee = dot(e, e), ff = dot(f, f);
  if (!(ee > 0) || !(ff > 0)) return;
  const double free = dot(r, f) / ff, t = std::clamp(free, 0.0, 1.0),
               s = free == t ? 0 : std::clamp((t * dot(e, f) - dot(e, r)) / ee, 0.0, 1.0);
  const double distance = std::sqrt(
      squared({r.x + s * e.x - t * f.x, r.y + s * e.y - t * f.y, r.z + s * e.z - t * f.z}));
  truth.exact.distance_below[i] = surely_above(distance, size_of(in, i));
  truth.distance[i] = distance;
  if (truth.exact.nearly_parallel[i]) return;  // The rule for nearly parallel edges defines other points.
  truth.parameters[i] = {s, t};
  truth.parameter_condition[i] = std::numeric_limits<double>::infinity();
  truth.contact_distance[i] = distance;
  truth.exact.first_feature[i] = feature_at(s);
  truth.exact.second_feature[i] = feature_at(t);
  accept(truth, i);
}

WrongForm start_by_threshold(const char* text, double epsilon) {
  return told("start_where_cross_product_below_" + std::string(text),
              "an absolute threshold on ‖e × e'‖²: below " + std::string(text) +
                  " m⁴ edges count as parallel, and the first one's start is taken",
              &Authority::closest_points, [epsilon](const ClosestPointsIn& in, ClosestPointsTruth& truth) {
                for (std::size_t i = 0; i < truth.accepted.size(); ++i) {
                  if (!(parallelism(in.first[i], in.second[i]) < epsilon)) continue;
                  from_start(in, truth, i);
                  round_answer(truth, i);
                }
              });
}

std::vector<WrongForm> closest_points_forms() {
  std::vector<WrongForm> forms{
      points_told("parallel_rule_missing", "nearly parallel edges are treated as all others", without_parallel_rule),
      points_told("second_ends_swapped", "the second edge read from its other end",
                  [](ClosestPointsTruth& truth, std::size_t i) {
                    truth.exact.second_feature[i] = other_end(truth.exact.second_feature[i]);
                    truth.parameters[i][1] = 1 - truth.parameters[i][1];
                    accept(truth, i);
                  }),
      points_told("first_ends_swapped", "the first edge read from its other end",
                  [](ClosestPointsTruth& truth, std::size_t i) {
                    truth.exact.first_feature[i] = other_end(truth.exact.first_feature[i]);
                    truth.parameters[i][0] = 1 - truth.parameters[i][0];
                    accept(truth, i);
                  }),
      points_told("both_ends_swapped", "both edges read from their other ends",
                  [](ClosestPointsTruth& truth, std::size_t i) {
                    truth.exact.first_feature[i] = other_end(truth.exact.first_feature[i]);
                    truth.exact.second_feature[i] = other_end(truth.exact.second_feature[i]);
                    for (double& t : truth.parameters[i]) t = 1 - t;
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
    forms.push_back(parallel_by_threshold(text, epsilon));
    forms.push_back(start_by_threshold(text, epsilon));
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

struct ClosestPoints : BatchStage<ClosestPoints, &Contestant::closest_points, &Authority::closest_points>,
                       NoParameters,
                       InEveryRun {
  using Case = ClosestPointsCase;
  static constexpr StageInfo info{.name = "closest_points",
                                  .question = "the closest points of two edges, their faces, distance",
                                  .unit = "pair",
                                  .reference = "reference/geometry/closest_points.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{
      MetricInfo{"contact_distance", "u max(d, Σ|δ|)", closest_points_distance_tolerance},
      MetricInfo{"parameters", "u cond", closest_points_parameter_tolerance},
      MetricInfo{"distance_below", "u max(d, Σ|δ|)", closest_points_below_tolerance}};

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.first);
    problem.vectors("a coordinate", c.second);
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.first, c.second); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.first, c.second}); }
  static ShortenedNumbers numbers(Case& c) { return {coordinates(c), {}}; }
  static const Topology* mesh(const Case&) { return nullptr; }
  static Case part(const Case& c, const MeshPart&) { return c; }

  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.edge_edge(states.frame(index), random);
  }

  static Json write(const Case& c) {
    return {{"first", points_to_json(c.first)}, {"second", points_to_json(c.second)}};
  }
  static Case read(const Json& data) { return {to_points<2>(data.at("first")), to_points<2>(data.at("second"))}; }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.first);
    shape.add_all(c.second);
    shape.lines = {{0, 1}, {2, 3}};
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    const std::vector<std::string> ends{"end 0", "end 1"};
    return {labelled(points("first", "m", c.first), ends), labelled(points("second", "m", c.second), ends)};
  }

  static In question(Cases cases) {
    In in;
    for (const TestCase& test : cases) {
      const auto& c = case_of<Case>(test.data);
      in.first.push_back(c.first);
      in.second.push_back(c.second);
    }
    return in;
  }
  static constexpr auto judge = judge_closest_points;
  static auto arrays(const Out& out) {
    return std::tie(out.first_feature, out.second_feature, out.nearly_parallel, out.parameters, out.contact_distance,
                    out.distance_below);
  }

  /// Lists an answer. Parameters and contact distance are given separately, because a truth has them in double.
  static std::vector<Quantity> outputs(const Out& out, const Quantity& parameters, double contact_distance) {
    return {word("first_feature", feature_name(out.first_feature.at(0), "first")),
            word("second_feature", feature_name(out.second_feature.at(0), "second")),
            flag("nearly_parallel", out.nearly_parallel.at(0)),
            parameters,
            scalar("contact_distance", "m", contact_distance),
            scalar("distance_below", "m", out.distance_below.at(0))};
  }
  static std::vector<Quantity> outputs(const In&, const Out& out) {
    return outputs(out, compare::numbers("parameters", "1", out.parameters.at(0)), out.contact_distance.at(0));
  }
  static std::vector<Quantity> outputs(const In&, const Truth& truth) {
    return outputs(truth.exact, compare::numbers("parameters", "1", truth.parameters[0]), truth.contact_distance[0]);
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return closest_points_forms(); }
};

}  // namespace

constinit const StageTraits stages::closest_points = make_traits<ClosestPoints>();

}  // namespace ogc::compare
