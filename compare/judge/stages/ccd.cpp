// Makes the traits of stage ccd. Generators start at the moment at which the faces are nearest, and extend the motion
// backwards and forwards. Ladders approach
// - borders of faces that are barely hit or missed, parallel edges, motions in one plane,
// - long slides at a small gap, gaps of 0, faces that touch at the start,
// - edges that rotate through each other.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/pairs.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

using Four = std::array<Vec3, 4>;

/// Positions and velocities at the time `at`.
struct Draft {
  CcdKind kind = CcdKind::vertex_triangle;
  Four x{}, v{};
  double at = 0;
};

CcdKind some_kind(Random& random) { return random.one_in(2) ? CcdKind::vertex_triangle : CcdKind::edge_edge; }

bool is_first(CcdKind kind, std::size_t k) { return k < (kind == CcdKind::edge_edge ? 2u : 1u); }

/// Exchanges vertices within each face, and the two edges.
void shuffle(Random& random, CcdCase& c) {
  const auto swap = [&](std::size_t i, std::size_t j) {
    std::swap(c.from[i], c.from[j]);
    std::swap(c.to[i], c.to[j]);
  };
  if (c.kind == CcdKind::edge_edge) {
    if (random.one_in(2)) swap(0, 1);
    if (random.one_in(2)) swap(2, 3);
    if (random.one_in(2)) swap(0, 2), swap(1, 3);
  } else {
    if (random.one_in(2)) swap(1, 2);
    if (random.one_in(2)) swap(2, 3);
  }
}

/// Returns the case from time 0 to time 1, after one random symmetry and rotation of all positions.
CcdCase placed(Random& random, const Draft& draft) {
  std::array<Vec3, 8> points;
  for (std::size_t k = 0; k < 4; ++k) {
    points[k] = sum(draft.x[k], scaled(draft.v[k], -draft.at));
    points[k + 4] = sum(draft.x[k], scaled(draft.v[k], 1 - draft.at));
  }
  place(random, points);
  CcdCase c{.kind = draft.kind};
  for (std::size_t k = 0; k < 4; ++k) c.from[k] = single(points[k]), c.to[k] = single(points[k + 4]);
  shuffle(random, c);
  return c;
}

/// Returns faces in the plane z = 0: a vertex at weights (a, b) of a triangle, or edges that cross at parameters a and
/// b, at an angle of this sine.
Four touching_faces(Random& random, CcdKind kind, double a, double b, double sine) {
  if (kind == CcdKind::edge_edge) {
    const double cosine = std::sqrt(1 - sine * sine), length = random.magnitude(-1, 1);
    return {Vec3{-a, 0, 0}, Vec3{1 - a, 0, 0}, Vec3{-b * length * cosine, -b * length * sine, 0},
            Vec3{(1 - b) * length * cosine, (1 - b) * length * sine, 0}};
  }
  const Vec3 corner{random.between(0.3, 1), 0, 0}, other{random.between(-0.5, 1), sine, 0};
  return {sum(scaled(corner, a), scaled(other, b)), Vec3{}, corner, other};
}

double inside(Random& random) { return random.between(0.05, 0.45); }

void lift(Draft& draft, double height) {
  for (std::size_t k = 0; k < 4; ++k)
    if (is_first(draft.kind, k)) draft.x[k].z += height;
}

/// Moves the first face along −z at `speed`. Each vertex also gets a random velocity of up to `own` · `speed`.
void approach(Random& random, Draft& draft, double speed, double own) {
  for (std::size_t k = 0; k < 4; ++k) {
    draft.v[k] = scaled(in_box(random, -1, 1), own * speed);
    if (is_first(draft.kind, k)) draft.v[k].z -= speed;
  }
}

void add_common(Random& random, Draft& draft, const Vec3& v) {
  if (random.one_in(2)) return;
  for (Vec3& own : draft.v) own = sum(own, v);
}

CaseData uniform(Random& random) {
  Draft draft{.kind = some_kind(random)};
  const double reach = random.magnitude(-3, 0.5);
  const Four points = points_in_box(random);
  draft.x = points;
  for (Vec3& v : draft.v) v = scaled(in_box(random, -1, 1), reach);
  add_common(random, draft, in_box(random, -1, 1));
  return placed(random, draft);
}

/// Makes faces that meet during the motion.
CaseData aimed(Random& random) {
  Draft draft{.kind = some_kind(random), .at = random.unit()};
  draft.x = touching_faces(random, draft.kind, inside(random), inside(random), random.between(0.2, 1));
  approach(random, draft, random.magnitude(-3, 0.5), random.between(0, 1));
  add_common(random, draft, in_box(random, -1, 1));
  return placed(random, draft);
}

CaseData bits(Random& random) {
  CcdCase c{.kind = some_kind(random)};
  const Four from = points_of_bits(random), to = points_of_bits(random);
  for (std::size_t k = 0; k < 4; ++k) c.from[k] = single(from[k]), c.to[k] = single(to[k]);
  if (random.one_in(2))  // a motion of a few ulp
    for (std::size_t k = 0; k < 4; ++k) c.to[k] = {up(c.from[k].x), c.from[k].y, up(up(c.from[k].z))};
  return c;
}

/// Makes faces whose coordinates are small integers: collapsed faces, faces on one plane or line, contacts at the start
/// and at the end of the motion.
CaseData lattice(Random& random) {
  CcdCase c{.kind = some_kind(random)};
  const double size = std::ldexp(1.0, random.below(9) - 4);
  for (std::size_t k = 0; k < 4; ++k) {
    c.from[k] = single(scaled(on_lattice(random, 2), size));
    c.to[k] = random.one_in(3) ? c.from[k] : single(scaled(on_lattice(random, 2), size));
  }
  return c;
}

/// Makes motions that hit or miss the border of a triangle or the end of an edge by a rung.
CaseData grazing(Random& random) {
  Draft draft{.kind = some_kind(random), .at = random.unit()};
  const double a = random.rung(), b = random.one_in(2) ? random.rung() : inside(random);
  draft.x = touching_faces(random, draft.kind, a, b, random.between(0.2, 1));
  approach(random, draft, random.magnitude(-2, 0), random.one_in(2) ? 0 : random.between(0, 1));
  return placed(random, draft);
}

/// Approaches an angle of 0 between the edges.
CaseData parallel(Random& random) {
  Draft draft{.kind = CcdKind::edge_edge, .at = random.between(0, 1.2)};
  draft.x = touching_faces(random, draft.kind, inside(random), inside(random), std::abs(random.rung()));
  if (random.one_in(3)) lift(draft, random.rung());
  approach(random, draft, random.magnitude(-2, 0), random.one_in(2) ? 0 : std::abs(random.rung()));
  return placed(random, draft);
}

/// Slides the faces along each other at a small gap, which closes slowly or not at all.
CaseData slide(Random& random) {
  Draft draft{.kind = some_kind(random)};
  draft.x = touching_faces(random, draft.kind, inside(random), inside(random), random.between(0.2, 1));
  const double gap = std::abs(random.rung()), speed = random.magnitude(-1, 1);
  lift(draft, gap);
  approach(random, draft, gap * random.between(0, 3), 0);
  const double angle = random.between(0, 6.3);
  for (std::size_t k = 0; k < 4; ++k)
    if (is_first(draft.kind, k)) draft.v[k] = sum(draft.v[k], {speed * std::cos(angle), speed * std::sin(angle), 0});
  add_common(random, draft, in_box(random, -1, 1));
  return placed(random, draft);
}

/// Makes faces whose gap at the start is 0 or a rung. The distance moved is similar to the gap, shorter or longer.
CaseData gap(Random& random) {
  Draft draft{.kind = some_kind(random)};
  const double height = random.rung();
  draft.x = touching_faces(random, draft.kind, inside(random), inside(random), random.between(0.2, 1));
  lift(draft, height);
  approach(random, draft, random.sign() * height * random.magnitude(-1, 2), random.between(0, 1));
  return placed(random, draft);
}

/// Makes motions in one plane. There faces can touch only at their edges and vertices.
CaseData planar(Random& random) {
  Draft draft{.kind = some_kind(random)};
  draft.x = points_in_box(random);
  for (std::size_t k = 0; k < 4; ++k) {
    draft.x[k].z = random.one_in(8) ? random.rung() : 0;
    draft.v[k] = scaled(in_box(random, -2, 2), random.one_in(3) ? 0 : 1);
    draft.v[k].z = 0;
  }
  return placed(random, draft);
}

/// Moves each vertex of the second face up or down, so that the face rotates about a point near the first face. The
/// second face passes through the first face, perhaps twice, or beside it.
CaseData turning(Random& random) {
  Draft draft{.kind = some_kind(random), .at = 0.5};
  draft.x = touching_faces(random, draft.kind, inside(random), inside(random), random.between(0.2, 1));
  lift(draft, random.rung());
  for (std::size_t k = 0; k < 4; ++k)
    if (!is_first(draft.kind, k)) draft.v[k].z = random.sign() * random.between(0, 2);
  return placed(random, draft);
}

/// Moves a case far from the origin, where differences of coordinates have few bits.
CaseData offset(Random& random) {
  const Vec3 far = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  CcdCase c = case_of<CcdCase>(aimed(random));
  for (auto* state : {&c.from, &c.to})
    for (Vec3f& x : *state) x = single(sum(far, {x.x, x.y, x.z}));
  return c;
}

/// Makes faces with nearly no area or no length.
CaseData needle(Random& random) {
  Draft draft{.kind = some_kind(random), .at = random.between(0, 1.2)};
  draft.x = touching_faces(random, draft.kind, inside(random), inside(random), std::abs(random.rung()));
  if (random.one_in(3)) draft.x[3] = sum(draft.x[2], scaled(in_box(random, -1, 1), std::abs(random.rung())));
  approach(random, draft, random.magnitude(-2, 0), std::abs(random.rung()));
  return placed(random, draft);
}

constexpr std::array<Generator, 13> ccd_table{{{"uniform", 12, true, uniform},
                                               {"aimed", 12, true, aimed},
                                               {"bits", 8, false, bits},
                                               {"dust", 5, false, aimed},
                                               {"lattice", 20, false, lattice},
                                               {"ladder.grazing", 10, false, grazing},
                                               {"ladder.parallel", 12, false, parallel},
                                               {"ladder.slide", 10, false, slide},
                                               {"ladder.gap", 10, false, gap},
                                               {"ladder.planar", 8, false, planar},
                                               {"ladder.turning", 8, false, turning},
                                               {"ladder.needle", 8, false, needle},
                                               {"ladder.offset", 6, false, offset}}};

/// Returns ‖e × e'‖² and ‖e‖² ‖e'‖² of the two edges at the start [m⁴].
std::pair<double, double> parallelism(const CcdCase& c) {
  const auto side = [&](std::size_t i, std::size_t j) {
    return Vec3{double{c.from[j].x} - c.from[i].x, double{c.from[j].y} - c.from[i].y,
                double{c.from[j].z} - c.from[i].z};
  };
  const Vec3 e = side(0, 1), f = side(2, 3);
  const Vec3 n{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
  const auto square = [](const Vec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
  return {square(n), square(e) * square(f)};
}

bool starts_parallel(const CcdCase& c) {
  const auto [cross, product] = parallelism(c);
  return cross <= 1e-6 * product;
}

using Wide = std::array<double, 3>;
using FourWide = std::array<Wide, 4>;

Wide along(const Wide& a, double s, const Wide& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
Wide less(const Wide& a, const Wide& b) { return along(a, -1, b); }
double product(const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Wide across(const Wide& a, const Wide& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the squared distance of a point and a segment.
double from_segment(const Wide& p, const Wide& a, const Wide& b) {
  const Wide e = less(b, a);
  const double square = product(e, e);
  const double s = square > 0 ? std::clamp(product(less(p, a), e) / square, 0.0, 1.0) : 0;
  const Wide gap = less(less(p, a), along({}, s, e));
  return product(gap, gap);
}

/// Returns the distance of the faces at the start [m], in double. Forms alone use it, so its rounding may at most cost
/// a name.
double start_gap(const CcdCase& c) {
  FourWide x;
  for (std::size_t k = 0; k < 4; ++k)
    x[k] = {double{c.from[k].x} - c.from[0].x, double{c.from[k].y} - c.from[0].y, double{c.from[k].z} - c.from[0].z};
  const bool edges = c.kind == CcdKind::edge_edge;
  double least = std::min(from_segment(x[0], x[2], x[3]), from_segment(x[edges ? 1 : 0], x[edges ? 2 : 1], x[3]));
  least = std::min(least, edges ? from_segment(x[2], x[0], x[1]) : from_segment(x[0], x[1], x[2]));
  if (edges) least = std::min(least, from_segment(x[3], x[0], x[1]));
  // The foot of the perpendicular: w = s p + t q + h n, within the triangle, or within both edges
  const Wide p = edges ? less(x[1], x[0]) : less(x[2], x[1]), q = less(x[3], x[edges ? 2 : 1]),
             w = less(x[edges ? 2 : 0], x[edges ? 0 : 1]), n = across(p, q);
  const double square = product(n, n), s = product(across(w, q), n), t = (edges ? 1 : -1) * product(across(w, p), n);
  if (square > 0 && s >= 0 && t >= 0 && (edges ? s <= square && t <= square : s + t <= square))
    least = std::min(least, product(w, n) * product(w, n) / square);
  return std::sqrt(least);
}

/// Returns the displacements relative to their mean [m].
FourWide own_ways(const CcdCase& c) {
  FourWide way;
  Wide mean{};
  for (std::size_t k = 0; k < 4; ++k) {
    way[k] = {double{c.to[k].x} - c.from[k].x, double{c.to[k].y} - c.from[k].y, double{c.to[k].z} - c.from[k].z};
    mean = along(mean, 0.25, way[k]);
  }
  for (Wide& w : way) w = less(w, mean);
  return way;
}

/// Returns S of the case (ccd_resolution) [m].
double size_of(const CcdCase& c) {
  double coordinate = 0, displacement = 0;
  for (const Vec3f& x : c.from)
    for (const double d : {double{x.x} - c.from[0].x, double{x.y} - c.from[0].y, double{x.z} - c.from[0].z})
      coordinate = std::max(coordinate, std::abs(d));
  for (const Wide& w : own_ways(c))
    for (const double d : w) displacement = std::max(displacement, std::abs(d));
  return coordinate + displacement;
}

/// Returns a time until which a kernel in double can tell the faces apart: their gap, less 2⁻³⁸ S for rounding, over
/// the largest speeds of both.
double surely_apart(const CcdCase& c) {
  std::array<double, 2> speed{};
  const FourWide way = own_ways(c);
  for (std::size_t k = 0; k < 4; ++k) {
    double& own = speed[is_first(c.kind, k) ? 0 : 1];
    own = std::max(own, std::sqrt(product(way[k], way[k])));
  }
  return (start_gap(c) - 0x1p-38 * size_of(c)) / (speed[0] + speed[1]);
}

/// Makes the form that finds no impact in cases for which `skips` returns true.
template <class Skips>
WrongForm skipping(std::string name, std::string meaning, Skips skips) {
  return told(std::move(name), std::move(meaning), &Authority::ccd, [skips](const CcdIn& in, CcdTruth& truth) {
    for (std::size_t i = 0; i < in.cases.size(); ++i)
      if (skips(in.cases[i])) truth.impact[i] = std::numeric_limits<double>::infinity(), truth.early[i] = 1;
  });
}

template <class Change>
WrongForm asked_case(std::string name, std::string meaning, Change change) {
  return asked(std::move(name), std::move(meaning), &Authority::ccd, [change](CcdIn& in) {
    for (CcdCase& c : in.cases) change(c);
  });
}

std::vector<WrongForm> ccd_forms() {
  std::vector<WrongForm> forms{
      skipping("never", "nothing ever meets", [](const CcdCase&) { return true; }),
      skipping("edges_skipped", "edges never meet", [](const CcdCase& c) { return c.kind == CcdKind::edge_edge; }),
      skipping("vertices_skipped", "a vertex never meets a triangle",
               [](const CcdCase& c) { return c.kind == CcdKind::vertex_triangle; }),
      skipping("parallel_edges_skipped", "edges that start nearly parallel never meet",
               [](const CcdCase& c) { return c.kind == CcdKind::edge_edge && starts_parallel(c); }),
      asked_case("second_face_at_rest", "the second face is taken to stay where it is",
                 [](CcdCase& c) {
                   for (std::size_t k = 0; k < 4; ++k)
                     if (!is_first(c.kind, k)) c.to[k] = c.from[k];
                 }),
      skipping("planar_skipped", "motions in a plane z = const never meet",
               [](const CcdCase& c) {
                 const auto is_at = [&](const Vec3f& x) { return x.z == c.from[0].z; };
                 return std::ranges::all_of(c.from, is_at) && std::ranges::all_of(c.to, is_at);
               }),
      asked_case("last_corner_twice", "the triangle's last corner in place of the one before, too",
                 [](CcdCase& c) {
                   if (c.kind == CcdKind::vertex_triangle) c.from[2] = c.from[3], c.to[2] = c.to[3];
                 }),
      asked_case("backwards", "the motion from its end to its start", [](CcdCase& c) { std::swap(c.from, c.to); })};
  for (const auto& [text, epsilon] : thresholds)
    forms.push_back(
        skipping("edges_skipped_where_cross_product_below_" + std::string(text),
                 "edges never meet where ‖e × e'‖² is below an absolute " + std::string(text) + " m⁴",
                 [e = epsilon](const CcdCase& c) { return c.kind == CcdKind::edge_edge && parallelism(c).first < e; }));
  forms.push_back(skipping("starts_nearer_than_1e-10_skipped", "faces that start nearer than 1e-10 m never meet",
                           [](const CcdCase& c) { return start_gap(c) < 1e-10; }));
  forms.push_back(skipping(
      "starts_not_told_apart_skipped", "faces that rounding does not tell apart at the start never meet: fail open",
      [](const CcdCase& c) { return start_gap(c) <= ccd_resolution * unit_roundoff * size_of(c); }));
  forms.push_back(told("impacts_before_1e-10_skipped", "what meets before 1e-10 of the motion never meets",
                       &Authority::ccd, [](const CcdIn& in, CcdTruth& truth) {
                         for (std::size_t i = 0; i < truth.impact.size(); ++i) {
                           // elsewhere a right time may be that early or not: the judge accepts both
                           if (truth.early[i] >= 1e-10 || surely_apart(in.cases[i]) > 2e-10) continue;
                           truth.early[i] = truth.impact[i] < 1e-10 ? 1 : 0;
                           truth.impact[i] = std::numeric_limits<double>::infinity();
                         }
                       }));
  return forms;
}

struct Ccd : BatchStage<Ccd, &Contestant::ccd, &Authority::ccd>, NoParameters, InEveryRun {
  using Case = CcdCase;
  static constexpr StageInfo info{.name = "ccd",
                                  .question = "when a vertex and a triangle, or two edges, first meet",
                                  .unit = "motion",
                                  .reference = "reference/ipc/ccd.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"early", "of the time", ccd_early_share,
                                                 "the published algorithm may end that early; ours goes on from where "
                                                 "it has nothing left but a tenth of the gap"}};

  static std::span<const Generator> generators() { return ccd_table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.from);
    problem.vectors("a coordinate", c.to);
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.from, c.to); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.from, c.to}); }
  static ShortenedNumbers numbers(Case& c) { return {coordinates(c), {}}; }
  static const Topology* mesh(const Case&) { return nullptr; }
  static Case part(const Case& c, const MeshPart&) { return c; }

  /// Takes two near faces of a frame, which move by up to their size.
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    Case c{.kind = some_kind(random)};
    const std::size_t frame = states.frame(index);
    if (states.topology().triangles.empty()) c.kind = CcdKind::edge_edge;
    if (c.kind == CcdKind::edge_edge) {
      const ClosestPointsCase pair = states.edge_edge(frame, random);
      c.from = {pair.first[0], pair.first[1], pair.second[0], pair.second[1]};
    } else {
      const ClosestFaceCase pair = states.vertex_triangle(frame, random);
      c.from = {pair.point, pair.triangle[0], pair.triangle[1], pair.triangle[2]};
    }
    const auto wide = [&](std::size_t k) {
      const Vec3f &a = c.from[k], &b = c.from[3];
      return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
    };
    const double reach = std::max({wide(0), wide(1), wide(2)}) * random.magnitude(-3, 0);
    for (std::size_t k = 0; k < 4; ++k)
      c.to[k] = single(sum({c.from[k].x, c.from[k].y, c.from[k].z}, scaled(in_box(random, -1, 1), reach)));
    return c;
  }

  static Json write(const Case& c) {
    return {{"kind", c.kind == CcdKind::edge_edge ? "edge_edge" : "vertex_triangle"},
            {"from", points_to_json(c.from)},
            {"to", points_to_json(c.to)}};
  }
  static Case read(const Json& data) {
    const auto kind = data.at("kind").get<std::string>();
    if (kind != "edge_edge" && kind != "vertex_triangle")
      throw InputError("kind: '" + kind + "' is neither vertex_triangle nor edge_edge");
    return {kind == "edge_edge" ? CcdKind::edge_edge : CcdKind::vertex_triangle, to_points<4>(data.at("from")),
            to_points<4>(data.at("to"))};
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.from);
    shape.add_all(c.to);
    for (const Index first : {0, 4}) {
      if (c.kind == CcdKind::edge_edge) {
        shape.lines.push_back({first, first + 1});
        shape.lines.push_back({first + 2, first + 3});
      } else {
        shape.triangles.push_back({first + 1, first + 2, first + 3});
        shape.dots.push_back(first);
      }
    }
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    const std::vector<std::string> names = c.kind == CcdKind::edge_edge
                                               ? std::vector<std::string>{"first edge, end 0", "first edge, end 1",
                                                                          "second edge, end 0", "second edge, end 1"}
                                               : std::vector<std::string>{"vertex", "corner 0", "corner 1", "corner 2"};
    return {word("kind", c.kind == CcdKind::edge_edge ? "two edges" : "vertex and triangle"),
            labelled(points("from", "m", c.from), names), labelled(points("to", "m", c.to), names)};
  }

  static In question(Cases cases) { return case_question(cases, &In::cases); }
  static void judge(Cases cases, const In&, const Truth& truth, const Out& out, Tally& tally) {
    tally.begin(cases[0].name);
    if (out.time.size() != cases.size()) {
      tally.mismatch("the answer does not have one time for each case");
      return;
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
      tally.begin(cases[i].name);
      tally.count(1, 1, 0);
      judge_time(out.time[i], truth.impact[i], truth.early[i], tally);
    }
  }
  static void judge_time(float time, double impact, double early, Tally& tally) {
    if (!(time >= 0 && time <= 1)) {
      tally.mismatch("time: " + std::to_string(time) + " is not within [0, 1]");
    } else if (time > impact) {
      tally.mismatch(text("time: %.9g is after the impact at %.17g", time, impact));
    } else {
      tally.error(0, early > time ? (early - time) / early : 0,
                  [&] { return text("time: %.9g, apart until %.17g", time, early); });
    }
  }
  static auto arrays(const Out& out) { return std::tie(out.time); }
  static std::string note(const Truth& truth) {
    return std::isinf(truth.impact[0]) ? "they never meet"
                                       : text("apart until %.17g, impact %.17g", truth.early[0], truth.impact[0]);
  }
  static std::vector<Quantity> outputs(const In&, const Out& out) { return {scalar("time", "1", out.time.at(0))}; }
  static std::vector<Quantity> outputs(const In&, const Truth& truth) {
    return {scalar("time", "1", std::min(truth.impact[0], 1.0))};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return ccd_forms(); }
};

}  // namespace

constinit const StageTraits stages::ccd = make_traits<Ccd>();

}  // namespace ogc::compare
