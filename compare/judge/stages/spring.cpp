// Makes the traits of stage spring. Ladders approach the rest length, length 0, a rest length of 0, and motion across
// the spring, which strain damping ignores. A seam is a spring between a vertex and a point of an edge. Ladders of
// seams approach length 0, and points at the edge's ends.
#include <array>
#include <cmath>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData with_material(Random& random, SpringCase question, double rest_length) {
  question.stiffness = static_cast<float>(random.magnitude(-2, 5));
  question.rest_length = static_cast<float>(rest_length);
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
  if (random.one_in(4)) question.damping_form = another(random, DampingForm::strain);
  return question;
}

/// Returns a spring along x. Its length is `length` now, and was `before` at the start of the step.
CaseData spring_case(Random& random, double length, double before, double rest_length, bool turned = true) {
  std::array<Vec3, 4> points{Vec3{}, Vec3{length, 0, 0}, Vec3{}, Vec3{before, 0, 0}};
  if (random.one_in(2)) points[3] = sum(points[3], scaled(in_box(random, -1, 1), 0.1 * before));
  const Vec3 common = random.one_in(2) ? Vec3{} : scaled(in_box(random, -1, 1), random.magnitude(-4, 0));
  for (std::size_t k = 2; k < 4; ++k) points[k] = sum(points[k], common);
  permute(random, points);
  if (turned) rotate(random, points);
  SpringCase question;
  for (std::size_t k = 0; k < 2; ++k) {
    question.vertex[k] = single(points[k]);
    question.start[k] = single(points[2 + k]);
  }
  return with_material(random, question, rest_length);
}

/// Returns a seam: an edge along y whose point at `ratio` is the origin, and a vertex at the distance `length` from
/// this point. At the start of the step this distance was `before`.
CaseData seam_case(Random& random, double edge, double ratio, double length, double before, double rest_length,
                   bool turned) {
  std::array<Vec3, 6> points{Vec3{length, 0, 0}, Vec3{0, -ratio * edge, 0}, Vec3{0, (1 - ratio) * edge, 0}, {}, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) points[3 + k] = points[k];
  points[3].x = before;
  if (random.one_in(2)) points[4] = sum(points[4], scaled(in_box(random, -1, 1), 0.1 * edge));
  permute(random, points);
  if (turned) rotate(random, points);
  SpringCase question;
  for (std::size_t k = 0; k < 3; ++k) {
    question.vertex[k] = single(points[k]);
    question.start[k] = single(points[3 + k]);
  }
  question.ratio = static_cast<float>(ratio);
  question.own = random.below(question.ratio > 0 ? 3 : 2);
  return with_material(random, question, rest_length);
}

double some_length(Random& random) { return random.magnitude(-3, 0); }

/// Stretches or compresses a spring.
CaseData uniform(Random& random) {
  const double length = some_length(random);
  return spring_case(random, length, length * random.between(0.5, 2), length * random.magnitude(-0.7, 0.7));
}

/// Makes lengths without rounding.
CaseData lattice(Random& random) {
  const double size = std::ldexp(1.0, random.below(9) - 8);
  return spring_case(random, size * random.below(5), size * random.below(5), size * random.below(5), false);
}

/// Takes random bits for coordinates and material.
CaseData bits(Random& random) {
  const std::array<Vec3, 4> points = points_of_bits(random);
  SpringCase question;
  question.vertex = {single(points[0]), single(points[1])};
  question.start = {single(points[2]), single(points[3])};
  question.stiffness = random.pattern();
  question.rest_length = random.pattern();
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
  return question;
}

/// Approaches l = l₀ and lᵗ = l. The force vanishes at l = l₀, and the block has a term across the spring only for l >
/// l₀.
CaseData at_rest(Random& random) {
  const double length = some_length(random);
  return spring_case(random, length, length * (1 + random.rung()), length * (1 + random.rung()));
}

/// Approaches l = 0.
CaseData at_zero(Random& random) {
  const double size = some_length(random);
  return spring_case(random, size * random.rung(), random.one_in(2) ? size : size * random.rung(), size,
                     random.one_in(2));
}

/// Makes stitches: l₀ = 0.
CaseData stitch(Random& random) {
  const double size = some_length(random);
  return spring_case(random, size * random.rung(), size * random.rung(), 0);
}

/// Makes seams of any shape and length, also of nearly 0.
CaseData seam(Random& random) {
  const double edge = some_length(random),
               length = edge * (random.one_in(2) ? random.magnitude(-1, 0.5) : std::abs(random.rung()));
  return seam_case(random, edge, random.unit(), length, length * random.between(0.5, 2),
                   random.one_in(2) ? 0 : length * random.magnitude(-0.5, 0.5), true);
}

/// Puts the point at an end of the edge, at its middle or its quarters, without rounding. The length may be 0.
CaseData seam_lattice(Random& random) {
  const double edge = std::ldexp(1.0, random.below(9) - 8);
  const double ratio = 0.25 * random.below(5);
  return seam_case(random, edge, ratio, edge * random.below(3), edge * random.below(3), edge * random.below(2), false);
}

/// Approaches ratios of 0 and 1, at which the point on the edge is an end.
CaseData seam_end(Random& random) {
  const double edge = some_length(random), rung = std::abs(random.rung());
  return seam_case(random, edge, std::min(1.0, random.one_in(2) ? rung : 1 - rung), edge * random.magnitude(-2, 0),
                   edge, 0, random.one_in(2));
}

/// Makes seams whose l and l₀ approach 0 independently.
CaseData closed(Random& random) {
  const double edge = some_length(random), ratio = random.unit(), length = edge * std::abs(random.rung()),
               before = edge * std::abs(random.rung());
  const double rest_length = edge * random.magnitude(-10, 0);
  return seam_case(random, edge, ratio, length, before, rest_length, true);
}

constexpr std::array<Generator, 11> table{{{"uniform", 40, true, uniform},
                                           {"bits", 15, false, bits},
                                           {"dust", 8, false, uniform},
                                           {"lattice", 15, false, lattice},
                                           {"ladder.rest", 20, false, at_rest},
                                           {"ladder.zero", 15, false, at_zero},
                                           {"ladder.stitch", 10, false, stitch},
                                           {"seam", 20, true, seam},
                                           {"ladder.seam_lattice", 10, false, seam_lattice},
                                           {"ladder.seam", 15, false, seam_end},
                                           {"ladder.closed", 10, false, closed}}};

/// Returns l of the spring at these positions [m].
double length_of(const SpringCase& c, const std::array<Vec3f, 3>& x) {
  const double s = c.ratio;
  const auto apart = [&](float Vec3f::*k) {
    return double{x[0].*k} - (1 - s) * (x[1].*k) - (s > 0 ? s * (x[2].*k) : 0);
  };
  return std::hypot(apart(&Vec3f::x), apart(&Vec3f::y), apart(&Vec3f::z));
}

/// Removes strain damping unless the spring shortens (`sign` −1) or lengthens (`sign` 1).
void damped_alone(SpringCase& c, double sign) {
  const double change = length_of(c, c.vertex) - length_of(c, c.start);
  if (damps_strain(c.damping_form) && !(sign * change > 0)) c.damping = 0;
}

std::vector<WrongForm> spring_forms() {
  constexpr auto stage = &Authority::spring;
  std::vector<WrongForm> forms = common_forms(stage);
  add_damping(forms, stage);
  forms.push_back(case_asked("damping_on_approach_alone",
                             "damping acts while the ends approach, and not while they part", stage,
                             [](SpringCase& c) { damped_alone(c, -1); }));
  forms.push_back(case_asked("damping_on_parting_alone",
                             "damping acts while the ends part, and not while they approach", stage,
                             [](SpringCase& c) { damped_alone(c, 1); }));
  forms.push_back(case_asked("rest_length_missing", "l₀ is 0", stage, [](SpringCase& c) { c.rest_length = 0; }));
  forms.push_back(
      case_asked("ratio_exchanged", "1 − s for s: the weights of the edge's ends exchanged", stage, [](SpringCase& c) {
        if (c.ratio > 0 && c.ratio < 1) c.ratio = 1 - c.ratio;
      }));
  forms.push_back(
      form("ones_for_identity", "the block from a matrix full of ones where I belongs: 1 − n nᵀ for I − n nᵀ", stage,
           [](const std::function<ForceTruth(const SpringIn&)>& right, const SpringIn& in) {
             ForceTruth truth = right(in);
             SpringIn undamped = in;
             for (SpringCase& c : undamped.cases) c.damping = 0;
             const ForceTruth elastic = right(undamped);
             for (SpringCase& c : undamped.cases) c.rest_length = 0;  // the block is then w² k_s I
             const ForceTruth full = right(undamped);
             for (std::size_t i = 0; i < in.cases.size(); ++i) {
               const SpringCase& c = in.cases[i];
               const double of_identity = (trace(elastic.accepted[i][0]) - trace(full.accepted[i][0]) / 3) / 2,
                            factor = damps_strain(c.damping_form) ? 1 : 1 + double{c.damping};
               for (ForceAnswer& answer : truth.accepted[i]) add_ones(answer, factor * of_identity);
             }
             return truth;
           }));
  forms.push_back(
      case_asked("edge_end_for_point", "an end of the edge in place of the point between", stage, [](SpringCase& c) {
        if (c.own < 2) c.ratio = 0;
      }));
  return forms;
}

struct SpringStage : ForceStage<SpringStage, SpringCase, &Contestant::spring, &Authority::spring> {
  static constexpr StageInfo info{.name = "spring",
                                  .question = "force and block of one end of one spring",
                                  .unit = "stencil",
                                  .reference = "reference/energies/spring.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", spring_force_tolerance},
                                      MetricInfo{"block", "u cond", spring_block_tolerance}};
  static constexpr std::array parameters{ParameterInfo{"k_s", "stiffness of the spring [N/m]", 0x1p-30f, ranges::vast},
                                         ParameterInfo{"l_0", "rest length [m]", 0, ranges::most}, ranges::damping};
  static float* parameter(Case& c, std::string_view name) {
    return name == "k_s" ? &c.stiffness : name == "l_0" ? &c.rest_length : &c.damping;
  }

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vectors("a coordinate", c.vertex);
    problem.vectors("a coordinate at the start", c.start);
    check_lengths(problem, std::span(c.vertex).first(c.ratio > 0 ? 3 : 2), 0x1p-63f, 0x1p-63f);
    check_lengths(problem, std::span(c.start).first(c.ratio > 0 ? 3 : 2), 0x1p-63f, 0x1p-63f);
    problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
    problem.number("a rest length", c.rest_length, 0, most_length);
    problem.number("a damping", c.damping, 0, most_length);
    problem.number("a ratio", c.ratio, 0, 1);
    problem.require(c.own >= 0 && c.own <= (c.ratio > 0 ? 2 : 1), "no such vertex is asked about");
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.vertex, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.vertex, c.start}); }
  static std::string missing_in(const States& states) {
    return states.scene().springs.empty() ? "its scene has no spring" : "";
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.spring(states.frame(index), random);
  }
  static Case checked(Case c) {
    if (!(c.ratio >= 0 && c.ratio <= 1)) throw InputError("ratio: give a number from 0 to 1");
    if (c.own < 0 || c.own > (c.ratio > 0 ? 2 : 1))
      throw InputError("own: " + std::to_string(c.own) + " is not a vertex of the spring");
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.vertex);
    shape.lines = {{0, 1}};
    if (c.ratio > 0) shape.lines.push_back({1, 2});
    shape.dots.push_back(c.own);
    return shape;
  }
  static std::vector<std::string> roles(const Case& c) {
    if (c.ratio == 0) return {"vertex 0, one end", "vertex 1, the other end"};
    return {"vertex 0, the end", "vertex 1, of the edge", "vertex 2, of the edge"};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return spring_forms(); }
};

}  // namespace

constinit const StageTraits stages::spring = make_traits<SpringStage>();

}  // namespace ogc::compare
