// Makes the traits of stage plane. An answer may choose the pairs for which it stores planes, so the truth is about one
// answer. The truth lists pairs that the answer's planes and balls do not separate, and vertices that they restrict
// more than necessary.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/mesh_case.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

std::string vertex(std::size_t v) { return "vertex " + std::to_string(v); }

bool has(std::span<const Index> vertices, Index v) { return std::ranges::find(vertices, v) != vertices.end(); }

/// Checks whether v is a vertex of exactly one side of the pair. Returns false for a pair that cannot exist.
bool is_part(const Topology& topology, const PrimitivePair& pair, Index v) {
  const auto is_one_of = [](Index i, auto count) { return i >= 0 && i < static_cast<Index>(count); };
  if (pair.kind == PrimitivePair::Kind::edge_edge) {
    if (!is_one_of(pair.first, topology.edges.size()) || !is_one_of(pair.second, topology.edges.size())) return false;
    const Edge &e = topology.edges[static_cast<std::size_t>(pair.first)],
               &f = topology.edges[static_cast<std::size_t>(pair.second)];
    return pair.first < pair.second && has(e, v) != has(f, v);
  }
  if (!is_one_of(pair.first, topology.vertex_count) || !is_one_of(pair.second, topology.triangles.size())) return false;
  const Triangle& t = topology.triangles[static_cast<std::size_t>(pair.second)];
  return pair.kind == PrimitivePair::Kind::vertex_triangle && !has(t, pair.first) && (pair.first == v || has(t, v));
}

/// Checks whether the rows are consecutive, one for each vertex.
bool are_rows(const VertexPlanes& planes, std::size_t count) {
  const std::vector<Index>& offsets = planes.offsets;
  if (offsets.empty()) return planes.items.empty();
  return offsets.size() == count + 1 && offsets.front() == 0 && std::ranges::is_sorted(offsets) &&
         offsets.back() == static_cast<Index>(planes.items.size());
}

/// Returns what is wrong with a row of vertex v; empty if it is valid.
std::string problem_of_row(const PlaneIn& in, std::span<const VertexPlane> row, Index v) {
  const auto order = [](const VertexPlane& p) { return std::tuple(p.pair.kind, p.pair.first, p.pair.second); };
  if (!row.empty() && in.is_fixed[static_cast<std::size_t>(v)] != 0) return "is fixed, and bears a plane";
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!is_part(*in.topology, row[i].pair, v)) return "bears a plane of a pair that it is no part of";
    if (i > 0 && !(order(row[i - 1]) < order(row[i]))) return "bears planes that do not ascend by pair";
    if (!is_finite(row[i].normal) || !std::isfinite(row[i].offset)) return "bears a plane that is not finite";
  }
  return "";
}

}  // namespace

bool can_judge_plane(const TestCase& test, const PlaneIn& in, const PlaneOut& out, Tally& tally) {
  tally.begin(test.name);
  const std::size_t count = in.positions.size();
  if (!right_length(out.bound.size(), count, "bound", tally)) return false;
  if (!are_rows(out.planes, count)) {
    tally.mismatch("planes: the rows are not one for each vertex, one after another");
    return false;
  }
  for (std::size_t v = 0; v < count; ++v) {
    const auto i = static_cast<Index>(v);
    const std::string problem = problem_of_row(in, out.planes.of(i), i);
    if (problem.empty()) continue;
    tally.mismatch("planes: " + vertex(v) + " " + problem);
    return false;
  }
  return true;
}

void judge_plane(const TestCase& test, const PlaneIn& in, const PlaneTruth& truth, const PlaneOut& out, Tally& tally) {
  tally.begin(test.name);
  const PlaneGuarantee& held = truth.guarantee;
  const PlaneFreedom& free = truth.freedom;
  tally.count(in.positions.size(), free.pairs, 0);
  const auto name = [&](const PrimitivePair& pair) { return pair_name(pair, *in.topology); };
  if (held.broken > 0)
    tally.mismatch("planes: " + std::to_string(held.broken) +
                   " half-spaces that their vertex does not keep where it is");
  if (held.uncovered > 0)
    tally.mismatch("planes: " + std::to_string(held.uncovered) +
                   " pairs that neither a plane nor balls hold apart; the first: " + name(held.worst));
  if (held.too_large > 0) tally.mismatch("bound: " + std::to_string(held.too_large) + " balls are larger than γ_p r_q");
  if (free.missing > 0)
    tally.mismatch("planes: " + std::to_string(free.missing) + " of " + std::to_string(free.due) +
                   " pairs that must have a plane have none; the first: " + name(free.first_missing));
  if (free.needless > 0)
    tally.mismatch("planes: " + std::to_string(free.needless) + " half-spaces of pairs that are none within r_q");
  if (free.bounded_inside > 0)
    tally.mismatch("bound: " + std::to_string(free.bounded_inside) + " vertices inside a solid have a bound");
  tally.error(0, free.narrowing, [&] { return name(free.narrowest) + " may not come as close as with balls"; });
  if (!in.displacement.empty())
    tally.error(2, free.division, [&] { return name(free.worst_divided) + " is not divided by approach"; });
  for (std::size_t v = 0; v < free.ball_shortfall.size(); ++v)
    tally.error(1, free.ball_shortfall[v], [&] {
      return vertex(v) + ": " +
             text("the ball of %.9g is smaller than need be, γ_p %.9g", out.bound[v], in.bounds_relaxation);
    });
}

namespace {

/// Makes a form that changes the question by `change(in)`.
template <class Change>
WrongForm plane_asked(std::string name, std::string meaning, Change change) {
  return form_of(std::move(name), std::move(meaning), [change](const Authority& authority) {
    Authority wrong = authority;
    wrong.plane = [right = authority.plane, change](PlaneIn in, const PlaneOut& out) {
      change(in);
      return right(in, out);
    };
    return wrong;
  });
}

/// Makes a form that accepts certain deviations of planes. `accept(out, freedom)` sets the counts or sizes of these
/// deviations in `freedom` to 0.
WrongForm plane_accepted(std::string name, std::string meaning, void (*accept)(const PlaneOut&, PlaneFreedom&)) {
  return {std::move(name), std::move(meaning), [accept](const Evidence& evidence, const Authority& authority) {
            Authority wrong = authority;
            wrong.plane = [right = authority.plane, accept](const PlaneIn& in, const PlaneOut& out) {
              PlaneTruth truth = right(in, out);
              accept(out, truth.freedom);
              return truth;
            };
            return agrees(evidence, wrong);
          }};
}

std::vector<WrongForm> plane_forms() {
  return {
      plane_asked("groups_ignored", "pairs inside one rigid group are kept",
                  [](PlaneIn& in) { in.exclusions.groups = {}; }),
      plane_asked("excluded_pairs_ignored", "pairs beside a stitch are kept",
                  [](PlaneIn& in) { in.exclusions.partners = nullptr; }),
      plane_asked("relaxation_missing", "γ_p left out: a half of the gap, all but 2⁻¹⁰",
                  [](PlaneIn& in) { in.bounds_relaxation = 0.5f - 0x1p-10f; }),
      plane_asked("half_the_query_radius", "pairs up to r_q/2, not up to r_q",
                  [](PlaneIn& in) { in.query_radius /= 2; }),
      plane_asked("halved", "the gap is halved where displacements divide it",
                  [](PlaneIn& in) { in.displacement = {}; }),
      form_of("leaving_for_approaching", "sides that leave each other get the room of those that approach",
              [](const Authority& authority) {
                Authority wrong = authority;
                wrong.plane = [right = authority.plane](PlaneIn in, const PlaneOut& out) {
                  std::vector<Vec3f> turned(in.displacement.begin(), in.displacement.end());
                  for (Vec3f& w : turned) w = {-w.x, -w.y, -w.z};
                  in.displacement = turned;
                  return right(in, out);
                };
                return wrong;
              }),
      plane_accepted("balls_alone", "no planes: each vertex has the ball of its nearest pair",
                     [](const PlaneOut& out, PlaneFreedom& freedom) {
                       if (out.planes.items.empty()) freedom.missing = 0;
                     }),
      plane_accepted("ball_of_all_pairs", "the ball is that of the nearest pair, whether it has a plane or not",
                     [](const PlaneOut&, PlaneFreedom& freedom) { std::ranges::fill(freedom.ball_shortfall, 0.0); }),
      plane_accepted("inside_bounded", "vertices inside solids are bounded like those of the surface",
                     [](const PlaneOut&, PlaneFreedom& freedom) { freedom.bounded_inside = 0; })};
}

struct Plane : Numbered, InEveryRun {
  using Case = PlaneCase;
  using In = PlaneIn;
  static constexpr StageInfo info{.name = "plane",
                                  .question = "half-spaces of near pairs, a ball for the others",
                                  .unit = "vertex",
                                  .reference = "reference/geometry/plane.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{
      MetricInfo{"narrowing", "u max(d, Σ|δ|)", plane_narrowing_tolerance},
      MetricInfo{"ball", "u γ_p max(d, Σ|δ|)", plane_ball_tolerance},
      MetricInfo{"division", "u (max(d, Σ|δ|) + d W/(a + b))", plane_division_tolerance}};
  static constexpr std::array parameters{ranges::query_radius, ranges::bounds_relaxation};
  static std::string set(Case& c, std::span<const Override> values) {
    for (const Override& value : values)
      (value.name == ranges::query_radius.name ? c.query_radius : c.bounds_relaxation) = value.value;
    return "";
  }

  static std::span<const Generator> generators() { return plane_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    const auto n = static_cast<std::size_t>(c.topology->vertex_count);
    problem.require(c.positions.size() == n && c.rigid_groups.size() == n,
                    "an array does not have one entry for each vertex");
    problem.require(c.is_fixed == fixed_flags(c.rigid_groups), "fixed vertices are not those of group 0");
    problem.require(c.displacement.empty() || c.displacement.size() == n,
                    "displacements are neither none nor one for each vertex");
    for (std::size_t v = 0; v < std::min(c.displacement.size(), c.is_fixed.size()); ++v)
      problem.require(c.is_fixed[v] == 0 || c.displacement[v] == Vec3f{}, "a fixed vertex has a displacement");
    problem.vectors("a displacement", c.displacement);
    problem.vectors("a coordinate", c.positions);
    problem.number("a query radius", c.query_radius, 0x1p-60f, vast);
    problem.number("a bound relaxation", c.bounds_relaxation, 0x1p-10f, 0.5f - 0x1p-10f);
  }
  static void mutate(Random& random, Case& c) { mutate_points(random, c.positions); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.positions}); }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.plane(states.frame(index), random);
  }
  static Case of_scene(const Scene& scene, const Contestant&) {
    MeshCase c = case_at_start(scene);
    std::vector<std::uint8_t> is_fixed = fixed_flags(c.rigid_groups);
    return {std::move(c.topology),
            std::move(c.rigid_groups),
            std::move(c.positions),
            c.query_radius,
            static_cast<float>(scene.settings.bounds_relaxation),
            std::move(c.partners),
            std::move(is_fixed)};
  }

  /// Returns the case as a state with r = r_q.
  static MeshCase as_state(const Case& c) {
    return {c.topology, c.rigid_groups, c.positions, c.query_radius, c.query_radius, c.partners};
  }
  static Json write(const Case& c) {
    Json json = mesh_case_to_json(as_state(c));
    json["bounds_relaxation"] = hexadecimal(c.bounds_relaxation);
    if (c.displacement.empty()) return json;
    json["displacement"] = Json::array();
    for (const Vec3f& w : c.displacement) json["displacement"].push_back(to_json(w));
    return json;
  }
  static Case read(const Json& data) {
    MeshCase state = to_mesh_case(data);
    std::vector<std::uint8_t> is_fixed = fixed_flags(state.rigid_groups);
    Case c{std::move(state.topology), std::move(state.rigid_groups),        std::move(state.positions),
           state.query_radius,        number(data.at("bounds_relaxation")), std::move(state.partners),
           std::move(is_fixed)};
    if (data.contains("displacement"))
      for (const Json& w : data.at("displacement")) c.displacement.push_back(to_point(w));
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(*c.topology, c.positions);
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    std::vector<Quantity> all = joined(
        {scalar("query_radius", "m", c.query_radius), scalar("bounds_relaxation", "1", c.bounds_relaxation)},
        state_quantities(*c.topology, c.positions, c.rigid_groups, c.partners));
    if (!c.displacement.empty()) all.push_back(points("displacement", "m", c.displacement));
    return all;
  }

  static const Topology* mesh(const Case& c) { return c.topology.get(); }
  static Case part(const Case& c, const MeshPart& part) {
    return {part.topology,
            MeshPart::picked(c.rigid_groups, part.vertices),
            MeshPart::picked(c.positions, part.vertices),
            c.query_radius,
            c.bounds_relaxation,
            part.partners(c.partners),
            MeshPart::picked(c.is_fixed, part.vertices),
            c.displacement.empty() ? std::vector<Vec3f>{} : MeshPart::picked(c.displacement, part.vertices)};
  }
  static ShortenedNumbers numbers(Case& c) { return {coordinates(c), {&c.query_radius}}; }

  static In question(const Case& c) {
    return {c.topology.get(), {c.rigid_groups, c.partners.rows() > 0 ? &c.partners : nullptr},
            c.positions,      c.is_fixed,
            c.query_radius,   c.bounds_relaxation,
            c.displacement};
  }
  static In question_of(const TestCase& test) { return question(case_of<Case>(test.data)); }
  static bool can_judge(const Contestant& c, const Authority& a) { return c.plane && a.plane; }
  /// Calls the contestant first, because the truth is about the contestant's answer.
  static void ask(Cases cases, const Contestant& c, const Authority& a, Asker& asker, Tally& tally) {
    for (const TestCase& test : cases) {
      const In in = question_of(test);
      const PlaneOut out = asker.answer(in, c.plane);
      if (!can_judge_plane(test, in, out, tally)) continue;
      const std::function<PlaneTruth(const In&)> about_answer = [&](const In& asked) { return a.plane(asked, out); };
      judge_plane(test, in, asker.truth(in, about_answer), out, tally);
    }
  }
  static std::vector<std::string> bits(Cases cases, const Contestant& c, const Authority&) {
    std::vector<std::string> all;
    for (const TestCase& test : cases) {
      Bits bits;
      bits.add(c.plane(question_of(test)));
      all.push_back(bits.take());
    }
    return all;
  }
  static BenchmarkCall benchmark(Cases cases, const Contestant& c, const Authority&) {
    const auto test = std::make_shared<const TestCase>(cases.front());
    return {[test, in = question_of(*test), stage = c.plane] { stage(in); }, in_vertices(*test)};
  }
  static std::int64_t in_vertices(const TestCase& test) { return case_of<Case>(test.data).topology->vertex_count; }

  /// Lists the contestant's bounds and planes as the contestant's answer and as the exact one, because the truth has
  /// none. Only counts of mistakes differ: they are 0 in the contestant's answer; the exact answer has the contestant's
  /// mistakes.
  static Answers answers(const TestCase& test, const Contestant& c, const Authority& a) {
    const In in = question_of(test);
    std::string note;
    const auto out = answer_or_note(c.plane, in, note);
    Tally tally(Stage::plane);
    if (!out || !can_judge_plane(test, in, *out, tally)) return {{}, out ? tally.mismatches[0].message : note};
    const PlaneTruth truth = a.plane(in, *out);
    return paired(
        {compare::numbers("bound", "m", out->bound), count("pairs without a separator", 0),
         count("due pairs without a plane", 0), count("planes", out->planes.items.size())},
        {compare::numbers("bound", "m", out->bound), count("pairs without a separator", truth.guarantee.uncovered),
         count("due pairs without a plane", truth.freedom.missing), count("planes", out->planes.items.size())},
        note);
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return plane_forms(); }
};

}  // namespace

constinit const StageTraits stages::plane = make_traits<Plane>();

}  // namespace ogc::compare
