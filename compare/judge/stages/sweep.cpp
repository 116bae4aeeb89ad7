// Makes the traits of stage sweep. The judge checks bounds by its own exact arithmetic. It compares all else with the
// truth, which the authority computes from the question and the contestant's answer.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/cases/colours.hpp"
#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/rods/quaternions.hpp"
#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/rods/orientation_verdict.hpp"
#include "compare/judge/engine/scene_json.hpp"
#include "compare/judge/engine/sweep_question.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/volumes.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

namespace {

bool judge_half_spaces(const SweepIn& in, const SweepOut& out, std::size_t v, Tally& tally) {
  if (in.planes == nullptr) return true;
  for (const VertexPlane& plane : in.planes->of(static_cast<Index>(v))) {
    if (obeys_half_space(out.position[v], {plane.normal, plane.offset})) continue;
    tally.mismatch("vertex " + std::to_string(v) + ": the stored position leaves the half-space of " +
                   pair_name(plane.pair, *in.topology));
    return false;
  }
  return true;
}

/// Checks whether each free or prescribed vertex is in its region; reports the first that is not. Fixed vertices and
/// vertices of volumes may be outside.
bool judge_bounds(const SweepIn& in, const SweepOut& out, const std::vector<Index>& groups, Tally& tally) {
  const std::vector<bool> is_volume = volume_flags(*in.scene);
  for (std::size_t v = 0; v < in.old.size(); ++v) {
    if ((in.colour[v] < 0 && groups[v] <= 0) || is_volume[v]) continue;
    if (!judge_half_spaces(in, out, v, tally)) return false;
    if (obeys_bound(out.position[v], in.previous[v], in.bound[v])) continue;
    const Vec3f &x = out.position[v], &p = in.previous[v];
    const double moved = std::hypot(double{x.x} - p.x, double{x.y} - p.y, double{x.z} - p.z);
    tally.mismatch("vertex " + std::to_string(v) +
                   text(": the stored position is %.17g from X_prev, bound %.9g", moved, in.bound[v]));
    return false;
  }
  return true;
}

/// Returns the number of decisions. Each vertex has one: whether it is cut. Each segment, each contact with a volume,
/// and each vertex of an element or of another contact has one: which value it takes at a jump.
std::uint64_t decisions(const SweepIn& in) {
  constexpr std::array<std::uint64_t, 3> corners{1, 2, 3};
  std::uint64_t count = in.old.size();
  for_each_of<ElementKinds>([&]<class Kind, std::size_t>() {
    for (const auto& element : Kind::elements(*in.scene, *in.rest)) count += Kind::vertices(element).size();
  });
  for (const VertexFacetContact& c : in.vertex_facet) count += 1 + corners[static_cast<std::size_t>(c.face.kind)];
  for (const EdgeEdgeContact& c : in.edge_edge)
    count += corners[static_cast<std::size_t>(c.first.kind)] + corners[static_cast<std::size_t>(c.second.kind)];
  return count + in.volumes.size() + in.segment_colour.size();
}

/// Checks that held segments keep their quaternions. Also checks that the truth about this answer accepts the
/// quaternions of free segments.
void judge_orientations(const SweepIn& in, const SweepTruth& truth, const SweepOut& out, Tally& tally) {
  for (std::size_t e = 0; e < in.segment_colour.size(); ++e)
    if (in.segment_colour[e] < 0 && out.orientation[e] != in.orientation[e])
      return tally.mismatch("segment " + std::to_string(e) + " is held, and its orientation has changed");
  for (std::size_t k = 0; k < truth.free_segments.size(); ++k) {
    const auto e = static_cast<std::size_t>(truth.free_segments[k]);
    const Quaternion& q = out.orientation[e];
    const OrientationAnswer& exact = nearest_answer(q, truth.orientation.accepted[k]);
    const double share = std::max(orientation_errors(q, exact).share(sweep_input_tolerance),
                                  length_error(q) / orientation_length_tolerance);
    tally.error(1, share, [&] {
      return "segment " + std::to_string(e) + ", colour " + std::to_string(in.segment_colour[e]) +
             text(": w is %.9g, exact %.9g", double{q[3]}, exact.orientation[3]);
    });
  }
}

double error_in_units(const SweepTruth& truth, const SweepOut& out, std::size_t v) {
  const Vec3f& x = out.position[v];
  const Vec3& exact = truth.position[v];
  const double error = std::hypot(x.x - exact.x, x.y - exact.y, x.z - exact.z);
  return error == 0 ? 0 : error / truth.accepted[v];
}

}  // namespace

bool can_judge_sweep(const TestCase& test, const SweepIn& in, const SweepOut& out, Tally& tally) {
  tally.begin(test.name);
  if (out.position.size() != in.old.size()) {
    tally.mismatch("the answer does not have one position for each vertex");
    return false;
  }
  if (out.orientation.size() != in.orientation.size()) {
    tally.mismatch("the answer does not have one orientation for each segment");
    return false;
  }
  if (!std::ranges::all_of(out.orientation, [](const Quaternion& q) { return is_finite(q); })) {
    tally.mismatch("an orientation is not finite");
    return false;
  }
  if (std::ranges::all_of(out.position, [](const Vec3f& x) { return is_finite(x); })) return true;
  tally.mismatch("a position is not finite");
  return false;
}

void judge_sweep(const TestCase& test, const SweepIn& in, const SweepTruth& truth, const SweepOut& out, Tally& tally) {
  tally.begin(test.name);
  auto grey = static_cast<std::uint64_t>(std::count(truth.grey.begin(), truth.grey.end(), std::uint8_t{1}));
  for (const auto& accepted : truth.orientation.accepted)
    grey += accepted.size() > 1 || std::isinf(accepted.front().scale);
  tally.count(in.old.size(), decisions(in), grey);
  if (!judge_bounds(in, out, rigid_groups(*in.scene), tally)) return;
  for (std::size_t v = 0; v < in.old.size(); ++v) {
    tally.error(0, error_in_units(truth, out, v), [&] {
      const Vec3f& x = out.position[v];
      const Vec3& exact = truth.position[v];
      return "vertex " + std::to_string(v) + ", colour " + std::to_string(in.colour[v]) +
             text(": %.4g m from the exact position, %.4g accepted",
                  std::hypot(x.x - exact.x, x.y - exact.y, x.z - exact.z), truth.accepted[v]);
    });
  }
  judge_orientations(in, truth, out, tally);
  if (out.cut < truth.cut || out.cut > truth.cut + truth.cut_doubtful)
    tally.mismatch("cut: " + std::to_string(out.cut) + ", exact " + std::to_string(truth.cut) + " and " +
                   std::to_string(truth.cut_doubtful) + " in doubt");
}

namespace {

/// The inputs of a sweep, copied so that a form can change them.
struct Read {
  SweepIn in;
  Scene scene;
  RestStateOut rest;
  std::vector<Index> colour, segment_colour;
};

template <class Change>
WrongForm sweep_asked(std::string name, std::string meaning, Change change) {
  return form_of(std::move(name), std::move(meaning), [change](const Authority& authority) {
    Authority wrong = authority;
    wrong.sweep = [right = authority.sweep, change](const SweepIn& in, const SweepOut& out) {
      Read read{in,
                *in.scene,
                *in.rest,
                {in.colour.begin(), in.colour.end()},
                {in.segment_colour.begin(), in.segment_colour.end()}};
      change(read);
      read.in.colour = read.colour;
      read.in.segment_colour = read.segment_colour;
      read.in.scene = &read.scene;
      read.in.rest = &read.rest;
      return right(read.in, out);
    };
    return wrong;
  });
}

template <class Change>
auto materials(Change change) {
  return [change](Read& read) {
    for (Body& body : read.scene.bodies) change(body.material);
  };
}

template <class Change>
auto meetings(Change change) {
  return [change](Read& read) {
    for (MeetingMaterial& meeting : read.rest.meetings) change(meeting);
  };
}

std::vector<WrongForm> sweep_forms() {
  std::vector<WrongForm> forms{
      sweep_asked("contacts_missing", "no contact acts",
                  [](Read& read) { read.in.vertex_facet = {}, read.in.edge_edge = {}, read.in.volumes = {}; }),
      sweep_asked("volumes_missing", "contacts with volumes do not act", [](Read& read) { read.in.volumes = {}; }),
      sweep_asked("vertex_facet_missing", "contacts of vertices with facets do not act",
                  [](Read& read) { read.in.vertex_facet = {}; }),
      sweep_asked("edge_edge_missing", "contacts of edges do not act", [](Read& read) { read.in.edge_edge = {}; }),
      sweep_asked("contacts_twice_as_stiff", "2 k_c for k_c", meetings([](MeetingMaterial& m) { m.stiffness *= 2; })),
      sweep_asked("friction_missing", "no friction", meetings([](MeetingMaterial& m) { m.friction = 0; })),
      sweep_asked("rods_without_bend", "neighbours of a segment do not act",
                  [](Read& read) {
                    for (RestSegment& segment : read.rest.segments) segment.weight = {};
                  }),
      sweep_asked("rods_half_as_stiff", "k_s/2 for k_s of rods", materials([](Material& m) {
                    if (m.rod) m.rod->stretch /= 2;
                  })),
      sweep_asked("rod_damping_missing", "rods without damping", materials([](Material& m) {
                    if (m.rod) m.rod->damping = 0;
                  })),
      sweep_asked("segments_jacobi", "neighbours of a segment are read before the sweep, whatever their colour",
                  [](Read& read) {
                    for (Index& colour : read.segment_colour)
                      if (colour > 0) colour = 0;
                  }),
      sweep_asked("mollifier_missing", "e_k is 1: nearly parallel edges act in full",
                  [](Read& read) { read.rest.edge_length_squared.assign(read.rest.edge_length_squared.size(), -1); }),
      sweep_asked("damping_missing", "membranes, hinges and springs without damping",
                  [](Read& read) {
                    materials([](Material& m) { m.membrane_damping = m.bending_damping = 0; })(read);
                    for (Spring& spring : read.scene.springs) spring.damping = 0;
                  }),
      sweep_asked("bending_damping_missing", "hinges without damping",
                  materials([](Material& m) { m.bending_damping = 0; })),
      sweep_asked("membrane_damping_missing", "membranes without damping",
                  materials([](Material& m) { m.membrane_damping = 0; })),
      sweep_asked("jacobi", "every neighbour is read where it was before the sweep, whatever its colour",
                  [](Read& read) {
                    for (Index& colour : read.colour)
                      if (colour > 0) colour = 0;
                  }),
      sweep_asked("colours_backwards", "neighbours of higher colour are read after their update, others before",
                  [](Read& read) {
                    const Index last = *std::ranges::max_element(read.colour);
                    for (Index& colour : read.colour)
                      if (colour >= 0) colour = last - colour;
                  }),
      sweep_asked("start_of_iteration", "slip and damping since the last iteration, not since the start of the step",
                  [](Read& read) { read.in.start = read.in.old; }),
      sweep_asked("prescribed_stay", "prescribed vertices stay", [](Read& read) { read.scene.motions.clear(); })};
  for_each_of<ElementKinds>([&]<class Kind, std::size_t>() {
    if constexpr (!std::is_same_v<Kind, SegmentKind>)  // segments cannot be left out, because each has a quaternion
      forms.push_back(sweep_asked(std::string(Kind::plural) + "_missing", std::string("no ") + Kind::name + " acts",
                                  [](Read& read) { Kind::elements(read.scene, read.rest).clear(); }));
  });
  for (const auto& [kind, name, meaning] : other_activations)
    forms.push_back(sweep_asked(name, std::string(meaning) + ", where `ogc` is asked for", [to = kind](Read& read) {
      if (read.scene.settings.contact_activation == ContactActivation::ogc) read.scene.settings.contact_activation = to;
    }));
  return forms;
}

/// Checks that exactly the free items have a colour, and that no two neighbours share one.
bool are_coloured(std::span<const Index> colour, std::span<const Index> groups, const Neighbours& near) {
  bool legal = colour.size() == groups.size();
  for (std::size_t i = 0; i < groups.size() && legal; ++i) {
    legal = (colour[i] >= 0) == (groups[i] < 0);
    for (const Index other : near[i])
      legal = legal && (colour[i] < 0 || colour[i] != colour[static_cast<std::size_t>(other)]);
  }
  return legal;
}

bool is_coloured(const SweepCase& c) {
  const std::vector<Index> held = segment_groups(*c.scene, rod_segments(*c.scene));
  return are_coloured(c.colour, rigid_groups(*c.scene), element_neighbours(*c.scene, build_topology(*c.scene))) &&
         are_coloured(c.segment_colour, held, segment_neighbours(*c.scene));
}

struct Sweep : TakenWhole, Numbered, OwnCases {
  using Case = SweepCase;
  static constexpr StageInfo info{.name = "sweep",
                                  .question = "one sweep over all colours",
                                  .unit = "vertex",
                                  .reference = "reference/solvers/sweep.cpp",
                                  .kind = CaseKind::followed,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"position", "accepted error", 1},
                                      MetricInfo{"orientation", "accepted error", 1}};
  static constexpr std::array parameters{ranges::contact_radius,    ranges::query_radius,      ranges::time_step,
                                         ranges::bounds_relaxation, ranges::contact_stiffness, ranges::friction};
  static std::string set(Case& c, std::span<const Override> values) {
    c.scene = ranges::with_parameters(*c.scene, values);
    for (const Override& value : values)
      if (value.name == ranges::query_radius.name) c.query_radius = value.value;
    return ranges::check_radii(static_cast<float>(c.scene->settings.contact_radius), c.query_radius);
  }

  static std::span<const Generator> generators() { return sweep_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    check_scene(problem, *c.scene);
    problem.require(is_coloured(c), "two vertices of an element share a colour, or one that is held has any");
    for (const auto* positions : {&c.old, &c.start, &c.target, &c.previous})
      problem.vectors("a coordinate", *positions);
    for (const auto* orientations : {&c.orientation, &c.orientation_start}) {
      problem.require(orientations->size() == c.segment_colour.size(), "a segment has no orientation");
      for (const Quaternion& q : *orientations) rod_cases::check_unit(problem, q);
    }
    for (const float bound : c.largest_bound) problem.number("a bound", bound, 0, std::numeric_limits<float>::max());
    problem.number("a query radius", c.query_radius, static_cast<float>(c.scene->settings.contact_radius), vast);
  }
  static void mutate(Random& random, Case& c) {
    mutate_points(random, c.target);
    mutate_points(random, c.start);
  }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.old, c.start, c.target, c.previous}); }
  static std::string missing_in(const States& states) { return stages::rest_state.missing_in(states); }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.sweep(states.frame(index), random);
  }

  static Json write(const Case& c) { return sweep_case_to_json(c); }
  static Case read(const Json& data) { return to_sweep_case(data); }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(build_topology(*c.scene), c.previous);
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    return joined(
        mesh_quantities(build_topology(*c.scene)), scene_quantities(*c.scene),
        std::vector{scalar("query_radius", "m", c.query_radius), indices("colour", c.colour), points("old", "m", c.old),
                    points("start", "m", c.start), points("target", "m", c.target), points("previous", "m", c.previous),
                    compare::numbers("largest_bound", "m", c.largest_bound),
                    indices("segment_colour", c.segment_colour), rows("orientation", "1", c.orientation),
                    rows("orientation_start", "1", c.orientation_start)});
  }

  static bool can_judge(const Contestant& c, const Authority& a) {
    return c.sweep && a.sweep && a.rest_state && a.detect_vertex_facet && a.detect_edge_edge && a.bound &&
           a.volume_depth;
  }
  /// Calls the contestant first, because the truth is about the contestant's answer.
  static void ask(Cases cases, const Contestant& c, const Authority& a, Asker& asker, Tally& tally) {
    for (const TestCase& test : cases) {
      const SweepQuestion question(case_of<Case>(test.data), a);
      const SweepOut out = asker.answer(question.in(), c.sweep);
      if (!can_judge_sweep(test, question.in(), out, tally)) continue;
      const std::function<SweepTruth(const SweepIn&)> about_answer = [&](const SweepIn& in) {
        return a.sweep(in, out);
      };
      judge_sweep(test, question.in(), asker.truth(question.in(), about_answer), out, tally);
    }
  }
  static std::vector<std::string> bits(Cases cases, const Contestant& c, const Authority& a) {
    std::vector<std::string> all;
    for (const TestCase& test : cases) {
      Bits bits;
      bits.add(c.sweep(SweepQuestion(case_of<Case>(test.data), a).in()));
      all.push_back(bits.take());
    }
    return all;
  }
  static BenchmarkCall benchmark(Cases cases, const Contestant& c, const Authority& a) {
    const auto test = std::make_shared<const TestCase>(cases.front());
    const auto question = std::make_shared<const SweepQuestion>(case_of<Case>(test->data), a);
    return {[test, question, stage = c.sweep] { stage(question->in()); },
            static_cast<std::int64_t>(question->in().colour.size())};
  }
  static Answers answers(const TestCase& test, const Contestant& c, const Authority& a) {
    const SweepQuestion question(case_of<Case>(test.data), a);
    std::string note;
    const auto out = answer_or_note(c.sweep, question.in(), note);
    if (!out) return {{}, note};
    if (out->position.size() != question.in().old.size() || out->orientation.size() != question.in().orientation.size())
      return {{}, "the answer does not have one position for each vertex"};
    const SweepTruth truth = a.sweep(question.in(), *out);
    const auto cut = [](Index count) { return scalar("cut", "", count); };
    std::vector<Quantity> given{points("position", "m", out->position), cut(out->cut)},
        exact{points("position", "m", truth.position), cut(truth.cut)};
    if (!out->orientation.empty()) {
      std::vector<Quaternion> orientations = out->orientation;
      given.push_back(rows("orientation", "1", orientations));
      for (std::size_t k = 0; k < truth.free_segments.size(); ++k)
        for (std::size_t i = 0; i < 4; ++i)
          orientations[static_cast<std::size_t>(truth.free_segments[k])][i] = static_cast<float>(
              truth.orientation.accepted[k].front().orientation[i]);
      exact.push_back(rows("orientation", "1", orientations));
    }
    return paired(given, exact, note);
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return sweep_forms(); }
};

}  // namespace

constinit const StageTraits stages::sweep = make_traits<Sweep>();

}  // namespace ogc::compare
