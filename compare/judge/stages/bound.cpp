// Makes the traits of stage bound.
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/renumbering.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/mesh_case.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

void judge_bound(const TestCase& test, const BoundTruth& truth, const BoundOut& out, Tally& tally) {
  tally.begin(test.name);
  tally.count(truth.exact.bound.size(), truth.exact.bound.size(), 0);
  if (!right_length(out.bound.size(), truth.exact.bound.size(), "bound", tally)) return;
  for (std::size_t v = 0; v < out.bound.size(); ++v)
    judge_smallest("vertex", v, out.bound[v], truth.exact.bound[v], truth.exact.bound[v], 0, tally);
}

namespace {

/// Makes the form that ignores `minima`, the smallest distances of vertices, edges or triangles.
WrongForm unread(std::string name, std::string meaning, std::span<const float> BoundIn::*minima) {
  return form(std::move(name), std::move(meaning), &Authority::bound,
              [minima](const std::function<BoundTruth(const BoundIn&)>& right, const BoundIn& in) {
                const std::vector<float> large((in.*minima).size(), 0x1p100f);
                BoundIn other = in;
                other.*minima = large;
                return right(other);
              });
}

WrongForm bound_told(std::string name, std::string meaning, float (*change)(float)) {
  return told(std::move(name), std::move(meaning), &Authority::bound, [change](const BoundIn&, BoundTruth& truth) {
    for (float& b : truth.exact.bound) b = change(b);
  });
}

std::vector<WrongForm> bound_forms() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {
      unread("vertex_minima_missing", "the vertex's own distance, d_min_vertex, is not read", &BoundIn::d_min_vertex),
      unread("edge_minima_missing", "distances of the vertex's edges are not read", &BoundIn::d_min_edge),
      unread("triangle_minima_missing", "distances of the vertex's triangles are not read", &BoundIn::d_min_triangle),
      asked("relaxation_missing", "γ_p left out: the smallest distance itself", &Authority::bound,
            [](BoundIn& in) { in.bounds_relaxation = 1; }),
      bound_told("half", "half of the bound", [](float b) { return b / 2; }),
      bound_told("twice", "twice the bound", [](float b) { return 2 * b; }),
      bound_told("rounded_to_nearest",
                 "the product rounded to nearest, not down: above the exact bound by the last bit",
                 [](float b) { return std::nextafter(b, infinity); })};
}

struct Bound : MeshStage<Bound, &Contestant::bound, &Authority::bound>, ParametersOfCase<Bound>, InEveryRun {
  using Case = BoundCase;
  static constexpr StageInfo info{.name = "bound",
                                  .question = "conservative bound of each vertex",
                                  .unit = "vertex",
                                  .reference = "reference/geometry/bound.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"bound", "u b", bound_below_tolerance,
                                                 "ours is the exact product, rounded down: its error is 0. Other "
                                                 "errors are whole units in the last place, 1 or 2 u "
                                                 "b each, of which 4 u b accepts the first ones only"}};
  static constexpr std::array parameters{ranges::bounds_relaxation};
  static float* parameter(Case& c, std::string_view) { return &c.bounds_relaxation; }

  static std::span<const Generator> generators() { return bound_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    problem.require(c.d_min_edge.size() == c.topology->edges.size() &&
                        c.d_min_triangle.size() == c.topology->triangles.size() &&
                        c.d_min_vertex.size() == static_cast<std::size_t>(c.topology->vertex_count),
                    "an array does not have one entry for each face");
    for (const auto* distances : {&c.d_min_vertex, &c.d_min_edge, &c.d_min_triangle})
      for (const float d : *distances) problem.number("a distance", d, 0, vast);
    problem.number("a bound relaxation", c.bounds_relaxation, 0x1p-10f, 0.5f);
  }
  static void mutate(Random& random, Case& c) {
    for (std::vector<float>* distances : {&c.d_min_vertex, &c.d_min_edge, &c.d_min_triangle}) {
      if (distances->empty()) continue;
      const auto any = [&]() -> float& { return (*distances)[random.bits() % distances->size()]; };
      for (int count = 1 + random.below(4); count > 0; --count)
        any() = random.one_in(8) ? 0 : std::abs(placement::beside(random, any()));
    }
  }
  static std::vector<float*> coordinates(Case&) { return {}; }
  static Case of_state(const States& states, std::uint64_t index, Random&) { return states.bound(states.frame(index)); }
  static Case of_scene(const Scene& scene, const Contestant& c) {
    const MeshCase start = case_at_start(scene);
    DetectVertexFacetOut near = c.detect_vertex_facet(detect_question(start));
    return {start.topology, std::move(near.d_min_vertex), c.detect_edge_edge(detect_question(start)).d_min_edge,
            std::move(near.d_min_triangle), static_cast<float>(scene.settings.bounds_relaxation)};
  }

  static Json write(const Case& c) {
    return {{"mesh", topology_to_json(*c.topology)},
            {"d_min_vertex", numbers_to_json(c.d_min_vertex)},
            {"d_min_edge", numbers_to_json(c.d_min_edge)},
            {"d_min_triangle", numbers_to_json(c.d_min_triangle)},
            {"bounds_relaxation", hexadecimal(c.bounds_relaxation)}};
  }
  static Case read(const Json& data) {
    Case c{to_topology(data.at("mesh"), data.at("d_min_vertex").size()), to_numbers(data.at("d_min_vertex")),
           to_numbers(data.at("d_min_edge")), to_numbers(data.at("d_min_triangle")),
           number(data.at("bounds_relaxation"))};
    if (c.d_min_vertex.size() != static_cast<std::size_t>(c.topology->vertex_count) ||
        c.d_min_edge.size() != c.topology->edges.size() || c.d_min_triangle.size() != c.topology->triangles.size())
      throw InputError("d_min_vertex, d_min_edge and d_min_triangle need one entry a vertex, edge and triangle");
    return c;
  }

  static Shape shape(const Case&) { return {}; }
  static std::vector<Quantity> inputs(const Case& c) {
    return joined({scalar("bounds_relaxation", "1", c.bounds_relaxation)}, mesh_quantities(*c.topology),
                  std::vector{compare::numbers("d_min_vertex", "m", c.d_min_vertex),
                              compare::numbers("d_min_edge", "m", c.d_min_edge),
                              compare::numbers("d_min_triangle", "m", c.d_min_triangle)});
  }

  static const Topology* mesh(const Case& c) { return c.topology.get(); }
  static Case part(const Case& c, const MeshPart& part) {
    return {part.topology, MeshPart::picked(c.d_min_vertex, part.vertices), MeshPart::picked(c.d_min_edge, part.edges),
            MeshPart::picked(c.d_min_triangle, part.triangles), c.bounds_relaxation};
  }
  static ShortenedNumbers numbers(Case& c) {
    ShortenedNumbers all;
    for (auto* distances : {&c.d_min_vertex, &c.d_min_edge, &c.d_min_triangle})
      for (float& d : *distances) all.lengths.push_back(&d);
    return all;
  }

  static In question(const Case& c) {
    return {c.topology.get(), c.d_min_vertex, c.d_min_edge, c.d_min_triangle, c.bounds_relaxation};
  }
  static constexpr auto judge = judge_bound;
  static void add(Bits& bits, const Out& out) { bits.add(out.bound); }
  static std::vector<Quantity> outputs(const In&, const Out& out) {
    return {compare::numbers("bound", "m", out.bound)};
  }
  static std::vector<Quantity> outputs(const In& in, const Truth& truth) { return outputs(in, truth.exact); }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return bound_forms(); }

  /// Checks whether renumbering keeps the bits of bounds.
  static bool is_same_renumbered(const TestCase& test, Random& random, const Contestant& contestant) {
    const auto& c = case_of<Case>(test.data);
    const Renumbering to(random, *c.topology);
    const Case other{to.topology(), to.by_vertex(c.d_min_vertex), to.by_edge(c.d_min_edge),
                     to.by_triangle(c.d_min_triangle), c.bounds_relaxation};
    return to.by_vertex(contestant.bound(question(c)).bound) == contestant.bound(question(other)).bound;
  }
};

}  // namespace

constinit const StageTraits stages::bound = make_traits<Bound>();

}  // namespace ogc::compare
