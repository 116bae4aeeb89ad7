// Makes the traits of stage closest_face. In the canonical frame of the ladders, corner a is the origin, corner b is on
// the x axis, and corner c is in the xy plane. So the planes between the blocks of a and ab are coordinate planes, and
// the point's distance from them can be any power of ten.
#include <array>
#include <span>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/stages/closest_face_forms.hpp"
#include "compare/judge/stages/pairs.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData finish(const std::array<Vec3, 4>& points) {
  return ClosestFaceCase{single(points[0]), {single(points[1]), single(points[2]), single(points[3])}};
}

/// Changes the order of the corners and places the case.
CaseData placed(Random& random, const Vec3& p, std::array<Vec3, 3> corners) {
  const int first = random.below(3);
  const bool turned = random.one_in(2);
  std::array<Vec3, 4> points{p, corners[first], corners[(first + (turned ? 2 : 1)) % 3],
                             corners[(first + (turned ? 1 : 2)) % 3]};
  place(random, points);
  return finish(points);
}

std::array<Vec3, 3> canonical(Random& random) {
  const double length = random.between(0.2, 1.5);
  return {Vec3{}, Vec3{length, 0, 0}, Vec3{random.between(-0.7, 1.7) * length, random.between(0.1, 1.5), 0}};
}

CaseData uniform(Random& random) { return finish(points_in_box(random)); }
CaseData bits(Random& random) { return finish(points_of_bits(random)); }
CaseData lattice(Random& random) { return finish(points_on_lattice(random, 3)); }

/// Approaches the plane between the blocks of corner a and edge ab.
CaseData corner_plane(Random& random) {
  return placed(random, {random.rung(), -random.magnitude(-3, 0), random.sign() * random.magnitude(-3, 0)},
                canonical(random));
}

/// Approaches the plane between the blocks of edge ab and the interior.
CaseData edge_plane(Random& random) {
  const auto corners = canonical(random);
  return placed(random, {random.between(0, 1) * corners[1].x, random.rung(), random.sign() * random.magnitude(-4, 0)},
                corners);
}

/// Approaches the planes of `corner_plane` and `edge_plane` at once, near corner a.
CaseData corner_edge(Random& random) {
  return placed(random, {random.rung(), random.rung(), random.one_in(2) ? random.rung() : random.between(-1, 1)},
                canonical(random));
}

/// Approaches d = 0 above the interior, an edge and a corner.
CaseData near(Random& random) {
  const auto corners = canonical(random);
  const double s = random.one_in(3) ? 0 : random.unit(), t = random.one_in(3) ? 0 : random.unit() * (1 - s);
  return placed(random, {s * corners[1].x + t * corners[2].x, t * corners[2].y, random.rung()}, corners);
}

/// Approaches a height of 0: corner c nears the line ab, within edge ab or beyond its ends.
CaseData needle(Random& random) {
  auto corners = canonical(random);
  corners[2].y = random.rung();
  const double y = random.one_in(2) ? random.rung() : random.between(-1, 1),
               z = random.one_in(2) ? random.rung() : random.between(-1, 1);
  return placed(random, {random.between(-0.3, 1.3) * corners[1].x, y, z}, corners);
}

/// Approaches an edge of length 0.
CaseData sliver(Random& random) {
  auto corners = canonical(random);
  corners[2] = sum(corners[random.below(2)], {random.rung(), random.rung(), 0});
  return placed(random,
                {random.between(-0.3, 1.3) * corners[1].x, random.one_in(2) ? random.rung() : random.between(-1, 1),
                 random.between(-1, 1)},
                corners);
}

/// Puts the point near the shortest edge of a triangle whose height is 10⁰ … 10⁶ times this edge. There the weight of
/// the far corner is least certain.
CaseData base(Random& random) {
  const double side = random.magnitude(-3, 0), height = side * random.magnitude(0, 6);
  const Vec3 p{side * random.rung(), random.between(-0.2, 1.2) * side, side * random.rung()};
  return placed(random, p, {Vec3{}, Vec3{0, side, 0}, Vec3{height, random.between(-1, 1) * height, 0}});
}

/// Makes triangles with an area of exactly 0: corners on a line of lattice points, two equal, or all equal.
CaseData zero_area(Random& random) {
  const Vec3 a = on_lattice(random, 2), direction = on_lattice(random, 1);
  const int kind = random.below(4);
  const double s = kind == 3 ? 0 : random.below(5), t = kind == 2 || kind == 3 ? s : random.below(5) - 2;
  const Vec3 p = random.one_in(2) ? on_lattice(random, 3) : in_box(random, -3, 3);
  std::array<Vec3, 4> points{p, a, sum(a, scaled(direction, s)), sum(a, scaled(direction, t))};
  permute(random, points);
  return finish(points);
}

/// Puts a small triangle far from the origin, where differences of coordinates have few bits.
CaseData offset(Random& random) {
  const Vec3 far = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  std::array<Vec3, 4> points;
  for (Vec3& p : points) p = sum(far, in_box(random, 0, 1));
  return finish(points);
}

/// Makes cases of `corner_plane`, `edge_plane` and `corner_edge` with rungs of at most 10⁻⁵.
CaseData boundary(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 3> ladders{corner_plane, edge_plane, corner_edge};
  random.be_fine();
  return random.pick(std::span<CaseData (*const)(Random&)>(ladders))(random);
}

constexpr std::array<Generator, 14> table{{{"uniform", 12, true, uniform},
                                           {"bits", 12, false, bits},
                                           {"dust", 6, false, uniform},
                                           {"lattice", 20, false, lattice},
                                           {"ladder.corner_plane", 8, false, corner_plane},
                                           {"ladder.edge_plane", 8, false, edge_plane},
                                           {"ladder.corner_edge", 8, false, corner_edge},
                                           {"ladder.near", 8, false, near},
                                           {"ladder.needle", 8, false, needle},
                                           {"ladder.sliver", 6, false, sliver},
                                           {"ladder.base", 6, false, base},
                                           {"ladder.zero_area", 5, false, zero_area},
                                           {"ladder.offset", 5, false, offset},
                                           {"ladder.boundary", 90, false, boundary}}};

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

}  // namespace

void judge_closest_face(Cases cases, const ClosestFaceIn& in, const ClosestFaceTruth& truth, const ClosestFaceOut& out,
                        Tally& tally) {
  tally.begin(cases[0].name);
  if (!right_lengths(cases.size(),
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

namespace {

struct ClosestFace : BatchStage<ClosestFace, &Contestant::closest_face, &Authority::closest_face>, NoParameters {
  using Case = ClosestFaceCase;
  static constexpr StageInfo info{.name = "closest_face",
                                  .question = "the face of a triangle closest to a point, weights, distance",
                                  .unit = "pair",
                                  .reference = "reference/geometry/closest_face.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"distance", "u max(d, Σ|δ|)", closest_face_distance_tolerance},
                                      MetricInfo{"weights", "u cond", closest_face_weight_tolerance},
                                      MetricInfo{"distance_below", "u max(d, Σ|δ|)", closest_face_below_tolerance}};

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vector("a coordinate", c.point);
    problem.vectors("a coordinate", c.triangle);
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, std::span(&c.point, 1), c.triangle); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({{&c.point, 1}, c.triangle}); }
  static ShortenedNumbers numbers(Case& c) { return {coordinates(c), {}}; }
  static const Topology* mesh(const Case&) { return nullptr; }
  static Case part(const Case& c, const MeshPart&) { return c; }

  static std::string missing_in(const States& states) {
    return states.topology().triangles.empty() ? "its mesh has no triangle" : "";
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.vertex_triangle(states.frame(index), random);
  }

  static Json write(const Case& c) { return {{"point", to_json(c.point)}, {"triangle", points_to_json(c.triangle)}}; }
  static Case read(const Json& data) { return {to_point(data.at("point")), to_points<3>(data.at("triangle"))}; }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.triangle);
    shape.dots.push_back(shape.add(c.point));
    shape.triangles.push_back({0, 1, 2});
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    return {points("point", "m", std::array{c.point}),
            labelled(points("triangle", "m", c.triangle), {"vertex 0", "vertex 1", "vertex 2"})};
  }

  static In question(Cases cases) {
    In in;
    for (const TestCase& test : cases) {
      const auto& c = case_of<Case>(test.data);
      in.point.push_back(c.point);
      in.triangle.push_back(c.triangle);
    }
    return in;
  }
  static constexpr auto judge = judge_closest_face;
  static auto arrays(const Out& out) { return std::tie(out.feature, out.weights, out.distance, out.distance_below); }

  static std::vector<Quantity> outputs(const In&, const Out& out) {
    return {word("feature", feature_name(out.feature.at(0))), compare::numbers("weights", "1", out.weights.at(0)),
            scalar("distance", "m", out.distance.at(0)), scalar("distance_below", "m", out.distance_below.at(0))};
  }
  static std::vector<Quantity> outputs(const In&, const Truth& truth) {
    return {word("feature", feature_name(truth.exact.feature[0])), compare::numbers("weights", "1", truth.weights[0]),
            scalar("distance", "m", truth.distance[0]), scalar("distance_below", "m", truth.exact.distance_below[0])};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return closest_face_forms(); }
};

}  // namespace

constinit const StageTraits stages::closest_face = make_traits<ClosestFace>();

}  // namespace ogc::compare
