// Makes the traits of stage orientation (symbols: compare/stages/orientation.hpp, compare/rods.md). Ladders approach
// - t·q = 0, where the sign of a neighbour's target t flips,
// - targets whose director is opposite to D, also with β₋ = 2σ, where stretch and neighbours balance,
// - b = 0, where targets cancel, and stretches or neighbours that are negligible,
// - an old q whose director is opposite to D, and segments without length.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/rods/orientation_verdict.hpp"
#include "compare/judge/engine/stencil_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/rods/rod_cases.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;
using namespace rod_cases;

using placement::single;
using rod_cases::single;

/// A segment to be built, with D = l R(aim) (e₃ + strain) and Dᵗ = l R(start) (e₃ + strain_start).
struct Draft {
  double length = 1;     ///< l [m]
  Four aim{0, 0, 0, 1};  ///< orientation from which D is built
  Four old{0, 0, 0, 1};
  Four start{0, 0, 0, 1};  ///< qᵗ
  Vec3 strain{}, strain_start{};
};

void set_material(Random& random, OrientationCase& question) {
  question.stretch = static_cast<float>(random.one_in(3) ? 0.1 : random.magnitude(-3, 6));
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
}

/// Returns a neighbour whose target for this segment is t; p is the relative rotation at rest. The sign of the
/// neighbour's quaternion is random.
RodNeighbour asks(Random& random, bool is_ahead, const Four& t, const Four& p, double weight) {
  RodNeighbour f;
  Four now = product(t, is_ahead ? p : conjugate(p));
  if (random.one_in(2))
    for (double& x : now) x = -x;
  f.weight = static_cast<float>(weight);
  f.now = single(now);
  f.rest = single(p);
  f.start = single(random.one_in(2) ? product(now, rotation(some_direction(random), random.between(-0.3, 0.3)))
                                    : some_orientation(random));
  return f;
}

OrientationCase placed(Random& random, const Draft& draft) {
  OrientationCase question;
  const auto along = [&](const Four& q, const Vec3& strain) {
    return scaled(turned(q, {strain.x, strain.y, strain.z + 1}), draft.length);
  };
  const Vec3 from = random.one_in(2) ? Vec3{} : scaled(in_box(random, -1, 1), draft.length);
  const Vec3 moved = random.one_in(2) ? from : sum(from, scaled(in_box(random, -1, 1), 0.1 * draft.length));
  question.vertex = {single(from), single(sum(from, along(draft.aim, draft.strain)))};
  question.start = {single(moved), single(sum(moved, along(draft.start, draft.strain_start)))};
  question.orientation = single(draft.old);
  question.orientation_start = single(draft.start);
  question.rest_length = static_cast<float>(draft.length);
  set_material(random, question);
  return question;
}

/// Returns σ of an undamped segment at its rest length [N m], the stiffness that pulls the director to D
/// (compare/rods.md).
double stiffness_of(const OrientationCase& question) { return 2.0 * question.stretch * question.rest_length; }

/// Returns a weight of similar size to the segment's σ.
double some_weight(Random& random, const OrientationCase& question) {
  return std::clamp(stiffness_of(question) * random.magnitude(-1.5, 1.5), 0x1p-39, 0x1p40);
}

Four some_rest(Random& random) {
  return random.one_in(2) ? rotation(some_direction(random), random.between(0, 1)) : some_orientation(random);
}

/// Returns a draft of a segment in a bent rod: q and qᵗ are near the orientation `aim`, and strains are small.
Draft near_rest(Random& random) {
  Draft draft;
  draft.length = some_length(random);
  draft.aim = some_orientation(random);
  draft.old = product(draft.aim, rotation(some_direction(random), random.between(-0.5, 0.5)));
  draft.start = product(draft.old, rotation(some_direction(random), random.between(-0.2, 0.2)));
  draft.strain = in_box(random, -0.2, 0.4);
  draft.strain_start = in_box(random, -0.2, 0.4);
  return draft;
}

/// Returns a target for a neighbour: a frame near draft.aim.
Four near_aim(Random& random, const Draft& draft) {
  return product(draft.aim, rotation(some_direction(random), random.between(-0.7, 0.7)));
}

/// Makes segments of a rod under load.
CaseData bent(Random& random) {
  const Draft draft = near_rest(random);
  OrientationCase question = placed(random, draft);
  const double weight = some_weight(random, question);
  question.behind = asks(random, false, near_aim(random, draft), some_rest(random), weight);
  question.ahead = asks(random, true, near_aim(random, draft), some_rest(random), random.between(0.5, 2) * weight);
  return question;
}

/// Makes random frames and neighbours.
CaseData uniform(Random& random) {
  Draft draft = near_rest(random);
  draft.old = some_orientation(random);
  draft.start = some_orientation(random);
  OrientationCase question = placed(random, draft);
  question.behind = asks(random, false, some_orientation(random), some_orientation(random),
                         some_weight(random, question));
  question.ahead = asks(random, true, some_orientation(random), some_orientation(random),
                        some_weight(random, question));
  return question;
}

/// Makes segments with one neighbour or none.
CaseData ends(Random& random) {
  const Draft draft = near_rest(random);
  OrientationCase question = placed(random, draft);
  const double weight = some_weight(random, question);
  switch (random.below(3)) {
    case 0: question.behind = asks(random, false, near_aim(random, draft), some_rest(random), weight); break;
    case 1: question.ahead = asks(random, true, near_aim(random, draft), some_rest(random), weight); break;
    case 2: break;
  }
  return question;
}

/// Makes a segment of a ring of three. Its two neighbours are also neighbours of each other. Orientations rotate by up
/// to a radian.
CaseData ring(Random& random) {
  std::array<Vec3, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 3 + random.between(-0.3, 0.3);
    corner[k] = {std::cos(angle), std::sin(angle), random.between(-0.3, 0.3)};
  }
  const Four common = some_orientation(random);
  std::array<Four, 3> rest, now, start;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = corner[k], &b = corner[(k + 1) % 3];
    const Vec3 d{b.x - a.x, b.y - a.y, b.z - a.z};
    const double length = std::hypot(d.x, d.y, d.z);
    const Vec3 half = sum(scaled(d, 1 / length), {0, 0, 1});  // axis of a half turn that rotates e₃ to d (their sum)
    rest[k] = unit({half.x, half.y, half.z, 0});
    now[k] = product(product(common, rest[k]), rotation(some_direction(random), random.between(0, 1)));
    start[k] = product(now[k], rotation(some_direction(random), random.between(0, 0.1)));
  }
  Draft draft;
  draft.length = some_length(random);
  draft.aim = product(common, rest[0]);
  draft.old = now[0];
  draft.start = start[0];
  draft.strain = in_box(random, -0.1, 0.3);
  draft.strain_start = in_box(random, -0.1, 0.3);
  OrientationCase question = placed(random, draft);
  const auto weight = static_cast<float>(some_weight(random, question));
  question.behind = {weight, single(now[2]), single(start[2]), single(product(conjugate(rest[2]), rest[0]))};
  question.ahead = {weight, single(now[1]), single(start[1]), single(product(conjugate(rest[0]), rest[1]))};
  return question;
}

/// Makes cases without rounding: orientations of the cube, ends on a lattice.
CaseData lattice(Random& random) {
  OrientationCase question;
  const double size = std::ldexp(1.0, random.below(9) - 8);
  question.vertex = {single(Vec3{}), single(scaled(on_lattice(random, 1), size))};
  question.start = {single(Vec3{}), single(scaled(on_lattice(random, 1), size))};
  question.orientation = single(on_lattice(random));
  question.orientation_start = single(on_lattice(random));
  question.rest_length = static_cast<float>(size);
  question.stretch = static_cast<float>(std::ldexp(1.0, random.below(9) - 4));
  question.damping = random.one_in(2) ? 0.0f : 1.0f;
  for (RodNeighbour* f : {&question.behind, &question.ahead}) {
    if (random.one_in(5)) continue;
    f->weight = static_cast<float>(std::ldexp(1.0, random.below(9) - 8));
    f->now = single(on_lattice(random));
    f->start = single(on_lattice(random));
    f->rest = single(on_lattice(random));
  }
  return question;
}

/// Takes random bits for coordinates and constants. The rest length is at least 2⁻⁷ m, so that no segment is longer
/// than 2³⁰ rest lengths, the legal limit.
CaseData bits(Random& random) {
  auto question = case_of<OrientationCase>(uniform(random));
  const std::array<Vec3, 4> points = points_of_bits(random);
  question.vertex = {single(points[0]), single(points[1])};
  question.start = {single(points[2]), single(points[3])};
  question.rest_length = random.pattern(0x1p-7f, 0x1p20f);
  question.stretch = random.pattern();
  question.behind.weight = random.pattern();
  question.ahead.weight = random.pattern();
  return question;
}

/// Makes segments of the largest and smallest sizes that scenes may have.
CaseData scales(Random& random) {
  Draft draft = near_rest(random);
  draft.length = std::ldexp(random.between(1, 2), random.one_in(2) ? 19 : -20);
  OrientationCase question = placed(random, draft);
  const double weight = some_weight(random, question);
  question.behind = asks(random, false, near_aim(random, draft), some_rest(random), weight);
  question.ahead = asks(random, true, near_aim(random, draft), some_rest(random), weight);
  return question;
}

/// Approaches t·q = 0: the target t of a neighbour is nearly the old q rotated by π.
CaseData sign(Random& random) {
  if (random.one_in(2)) random.be_fine();
  const Draft draft = near_rest(random);
  OrientationCase question = placed(random, draft);
  const double weight = some_weight(random, question);
  const Vec3 axis = some_direction(random);
  const Four half{axis.x, axis.y, axis.z, random.rung()};
  const bool is_ahead = random.one_in(2);
  const RodNeighbour asking = asks(random, is_ahead, product(draft.old, unit(half)), some_rest(random), weight),
                     other = asks(random, !is_ahead, near_aim(random, draft), some_rest(random),
                                  weight * random.between(0.1, 2));
  (is_ahead ? question.ahead : question.behind) = asking;
  if (random.one_in(2)) (is_ahead ? question.behind : question.ahead) = other;
  return question;
}

/// Returns a target whose director is −D/‖D‖: the aim, rotated by π about an axis perpendicular to D, then by a rung.
Four against(Random& random, const Draft& draft) {
  const double angle = random.between(0, 2 * std::numbers::pi);
  const Four half{std::cos(angle), std::sin(angle), 0, 0};
  return beside(random, product(draft.aim, half));
}

Draft straight(Random& random) {
  Draft draft = near_rest(random);
  draft.strain = {0, 0, random.between(-0.2, 0.4)};
  return draft;
}

/// Approaches β₊ = 0, where neighbours do not pull towards D (β₊ is in compare/rods.md): the directors of all targets
/// are opposite to D.
CaseData reversed(Random& random) {
  if (random.one_in(2)) random.be_fine();
  const Draft draft = straight(random);
  OrientationCase question = placed(random, draft);
  question.damping = 0;
  const double weight = some_weight(random, question);
  const Four t = against(random, draft);
  question.behind = asks(random, false, t, some_rest(random), weight);
  if (random.one_in(2)) {
    const Four other = against(random, draft);
    question.ahead = asks(random, true, random.one_in(2) ? t : other, some_rest(random),
                          weight * random.between(0.5, 2));
  }
  return question;
}

/// Approaches β₋ = 2σ (compare/rods.md) with targets whose directors are opposite to D. There the stretch force
/// balances the pull of the neighbours towards −D.
CaseData balance(Random& random) {
  const Draft draft = straight(random);
  OrientationCase question = placed(random, draft);
  question.damping = 0;
  const double sigma = stiffness_of(question) * (1 + draft.strain.z);
  question.ahead = asks(random, true, against(random, draft), some_rest(random), 2 * sigma * (1 + random.rung()));
  return question;
}

/// Approaches b = 0 (compare/rods.md), where the pulls of both neighbours cancel. One target is nearly the old q
/// rotated by +π about an axis, the other target is nearly the old q rotated by −π about this axis.
CaseData opposed(Random& random) {
  if (random.one_in(2)) random.be_fine();
  const Draft draft = near_rest(random);
  OrientationCase question = placed(random, draft);
  question.damping = 0;
  const double weight = some_weight(random, question);
  const Vec3 n = some_direction(random);
  const double rest = std::abs(random.rung());
  question.behind = asks(random, false, product(draft.old, unit({n.x, n.y, n.z, rest})), some_rest(random), weight);
  question.ahead = asks(random, true, product(draft.old, unit({-n.x, -n.y, -n.z, rest})), some_rest(random),
                        random.one_in(2) ? weight : weight * (1 + random.rung()));
  return question;
}

/// Makes ‖b‖ ≪ σ and ‖b‖ ≫ σ, that is, weak and strong neighbours, with ratios of up to 10¹⁴.
CaseData stiff(Random& random) {
  const Draft draft = near_rest(random);
  OrientationCase question = placed(random, draft);
  const double rung = std::abs(random.rung()), factor = rung == 0 ? 1e-14 : rung,
               weight = std::clamp(stiffness_of(question) * (random.one_in(2) ? factor : 1 / factor), 0x1p-40, 0x1p50);
  question.behind = asks(random, false, near_aim(random, draft), some_rest(random), weight);
  if (random.one_in(2)) question.ahead = asks(random, true, near_aim(random, draft), some_rest(random), weight);
  return question;
}

/// Makes the old director approach −D, with or without neighbours.
CaseData antiparallel(Random& random) {
  Draft draft = straight(random);
  draft.old = against(random, draft);
  OrientationCase question = placed(random, draft);
  if (random.one_in(2)) question.damping = 0;
  if (random.one_in(2)) return question;
  question.ahead = asks(random, true, near_aim(random, draft), some_rest(random), some_weight(random, question));
  return question;
}

/// Approaches σ = 2 k_s ‖D‖ ‖c‖ = 0 (compare/rods.md): D nears 0, or the damping part of c = e₃ + k R(qᵗ)ᵀ Dᵗ/l cancels
/// e₃.
CaseData soft(Random& random) {
  Draft draft = near_rest(random);
  draft.length = random.magnitude(-2, 0);  // so that a rung times this length is a legal length
  const bool is_damped = random.one_in(3);
  const double rung = random.rung();
  if (is_damped) {
    draft.strain_start = {0, 0, -2 + rung};
  } else {
    draft.strain = {random.rung(), random.rung(), -1 + rung};
  }
  OrientationCase question = placed(random, draft);
  if (is_damped) question.damping = 1;
  if (random.one_in(4)) return question;
  question.ahead = asks(random, true, near_aim(random, draft), some_rest(random), some_weight(random, question));
  return question;
}

constexpr std::array<Generator, 15> table{{{"uniform", 15, true, uniform},
                                           {"bent", 15, true, bent},
                                           {"ends", 8, true, ends},
                                           {"ring", 8, true, ring},
                                           {"bits", 8, false, bits},
                                           {"dust", 5, false, bent},
                                           {"scales", 6, true, scales},
                                           {"lattice", 15, false, lattice},
                                           {"ladder.sign", 75, false, sign},
                                           {"ladder.reversed", 45, false, reversed},
                                           {"ladder.balance", 10, false, balance},
                                           {"ladder.opposed", 45, false, opposed},
                                           {"ladder.stiff", 8, false, stiff},
                                           {"ladder.antiparallel", 15, false, antiparallel},
                                           {"ladder.soft", 10, false, soft}}};

double inner(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

void judge_case(const TestCase& test, const std::vector<OrientationAnswer>& accepted, bool near, const Quaternion& q,
                Tally& tally) {
  tally.begin(test.name);
  const bool grey = accepted.size() > 1 || std::isinf(accepted.front().scale);
  tally.count(1, 1, grey, near);
  if (!is_finite(q)) {
    tally.mismatch("an orientation is no finite quaternion");
    return;
  }
  const OrientationAnswer& exact = nearest_answer(q, accepted);
  const OrientationErrors errors = orientation_errors(q, exact);
  const auto both = [&] {
    const auto& e = exact.orientation;
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, "(%.9g, %.9g, %.9g, %.9g), exact (%.9g, %.9g, %.9g, %.9g)", double{q[0]},
                  double{q[1]}, double{q[2]}, double{q[3]}, e[0], e[1], e[2], e[3]);
    return std::string(buffer);
  };
  if (errors.share() <= 1 && orientation_errors(q, accepted.front()).share() > 1) tally.answered_not_exactly();
  if (!std::isinf(exact.scale)) tally.error(0, errors.orientation, both);
  tally.error(1, errors.residual, both);
  tally.error(2, errors.energy, both);
  tally.error(3, length_error(q), both);
}

/// Makes a form that changes each case of the question by `change(case)`.
template <class Change>
WrongForm changed(const char* name, const char* meaning, Change change) {
  return asked(name, meaning, &Authority::orientation, [change](OrientationIn& in) {
    for (OrientationCase& c : in.cases) change(c);
  });
}

/// Makes a form that replaces the q of each answer by the minimiser of another function; residual and energy are then
/// not compared.
template <class Change>
WrongForm replaced(const char* name, const char* meaning, Change change) {
  return told(name, meaning, &Authority::orientation, [change](const OrientationIn& in, OrientationTruth& truth) {
    for (std::size_t i = 0; i < in.cases.size(); ++i)
      for (OrientationAnswer& answer : truth.accepted[i]) {
        answer.orientation = change(in.cases[i], answer);
        answer = {answer.orientation, {}, {}, 0, std::isinf(answer.scale) ? 1 : answer.scale, 1};
      }
  });
}

Four published(const OrientationCase&, const OrientationAnswer& answer) {
  const auto& b = answer.vector;
  Four turned;
  double sigma = 0;
  for (std::size_t row = 0; row < 4; ++row) {
    turned[row] = inner(answer.matrix[row], b);
    sigma += answer.matrix[0][row] * answer.matrix[0][row];  // M² = σ² I, so each row has the length σ
  }
  const double multiplier = std::sqrt(sigma) + std::sqrt(inner(b, b));
  for (std::size_t k = 0; k < 4; ++k) turned[k] += multiplier * b[k];
  return inner(turned, turned) > 0 ? unit(turned) : answer.orientation;
}

Quaternion turned_back(const Quaternion& q) { return {-q[0], -q[1], -q[2], q[3]}; }

std::vector<WrongForm> orientation_forms() {
  std::vector<WrongForm> forms{
      replaced("as_published", "μ = σ + ‖b‖, the published multiplier, in place of the root", published),
      replaced("other_sign", "−q: the quaternion of the other sign",
               [](const OrientationCase&, const OrientationAnswer& answer) {
                 Four q = answer.orientation;
                 for (double& x : q) x = -x;
                 return q;
               }),
      replaced("conjugate", "the conjugate of the answer",
               [](const OrientationCase&, const OrientationAnswer& answer) { return conjugate(answer.orientation); }),
      replaced("stays", "the old q: nothing is updated",
               [](const OrientationCase& c, const OrientationAnswer&) { return wide(c.orientation); })};
  const auto add = [&](const char* name, const char* meaning, auto change) {
    forms.push_back(changed(name, meaning, change));
  };
  add("rest_transposed", "p° for p̄°: the rest rotation the other way", [](OrientationCase& c) {
    for (RodNeighbour* f : {&c.behind, &c.ahead}) f->rest = turned_back(f->rest);
  });
  add("rest_ahead_transposed", "p° for p̄° of the neighbour ahead",
      [](OrientationCase& c) { c.ahead.rest = turned_back(c.ahead.rest); });
  add("rest_missing", "p° is 1: neighbours ask for their own frame", [](OrientationCase& c) {
    for (RodNeighbour* f : {&c.behind, &c.ahead}) f->rest = {0, 0, 0, 1};
  });
  add("half_the_bend", "2 k_b/l̄ for 4 k_b/l̄", [](OrientationCase& c) {
    for (RodNeighbour* f : {&c.behind, &c.ahead}) f->weight *= 0.5f;
  });
  add("twice_the_bend", "8 k_b/l̄ for 4 k_b/l̄", [](OrientationCase& c) {
    for (RodNeighbour* f : {&c.behind, &c.ahead}) f->weight *= 2;
  });
  add("half_the_stretch", "k_s/2 for k_s: M without its factor 2", [](OrientationCase& c) { c.stretch *= 0.5f; });
  add("twice_the_stretch", "2 k_s for k_s", [](OrientationCase& c) { c.stretch *= 2; });
  add("damping_missing", "without damping", [](OrientationCase& c) { c.damping = 0; });
  add("damping_doubled", "2 k for the damping k", [](OrientationCase& c) { c.damping *= 2; });
  add("old_frame_read", "neighbours as they were at the start of the step", [](OrientationCase& c) {
    for (RodNeighbour* f : {&c.behind, &c.ahead}) f->now = f->start;
  });
  add("start_now", "quaternions of now in place of those at the start: no change of strain is damped",
      [](OrientationCase& c) {
        c.orientation_start = c.orientation;
        for (RodNeighbour* f : {&c.behind, &c.ahead}) f->start = f->now;
      });
  add("ahead_alone", "the neighbour behind is left out", [](OrientationCase& c) { c.behind.weight = 0; });
  add("behind_alone", "the neighbour ahead is left out", [](OrientationCase& c) { c.ahead.weight = 0; });
  add("neighbours_missing", "both neighbours are left out: no bend and no twist",
      [](OrientationCase& c) { c.behind.weight = c.ahead.weight = 0; });
  add("neighbours_exchanged", "the neighbour ahead as that behind, and the reverse",
      [](OrientationCase& c) { std::swap(c.ahead, c.behind); });
  add("ends_exchanged", "D = x₀ − x₁", [](OrientationCase& c) {
    std::swap(c.vertex[0], c.vertex[1]);
    std::swap(c.start[0], c.start[1]);
  });
  add("signs_of_the_start", "signs from qᵗ, not from the old q",
      [](OrientationCase& c) { c.orientation = c.orientation_start; });
  return forms;
}

struct OrientationStage : BatchStage<OrientationStage, &Contestant::orientation, &Authority::orientation>,
                          TakenWhole,
                          ParametersOfCase<OrientationStage> {
  using Case = OrientationCase;
  static constexpr StageInfo info{.name = "orientation",
                                  .question = "the quaternion of one segment from its ends and neighbours",
                                  .unit = "segment",
                                  .reference = "reference/energies/rods/orientation.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"orientation", "u cond", orientation_tolerance},
                                      MetricInfo{"residual", "u (σ + Σ w)", orientation_residual_tolerance},
                                      MetricInfo{"energy", "u (σ + Σ w)", orientation_energy_tolerance},
                                      MetricInfo{"length", "u", orientation_length_tolerance}};
  static constexpr std::array parameters = segment_parameters;
  static float* parameter(Case& c, std::string_view name) { return segment_parameter(c, name); }

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    check_segment(problem, c);
    for (const RodNeighbour* f : {&c.behind, &c.ahead}) {
      if (f->weight == 0) continue;
      problem.number("a weight", f->weight, 0x1p-40f, 0x1p60f);
      problem.require(f->weight * (1 + double{c.damping}) <= 0x1p60, "a weight is damped beyond the contract");
      for (const Quaternion* q : {&f->now, &f->start, &f->rest}) check_unit(problem, *q);
    }
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.vertex, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.vertex, c.start}); }
  static std::string missing_in(const States& states) {
    return states.topology().edges.empty() ? "its mesh has no edge" : "";
  }
  /// Makes a segment with two neighbours: the nearest other edge, and a nearly straight continuation.
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    const ClosestPointsCase pair = states.edge_edge(states.frame(index), random);
    const EdgeOfState own(random, pair.first), other(random, pair.second);
    OrientationCase question{.vertex = own.vertex,
                             .start = own.start,
                             .orientation = single(own.frame),
                             .orientation_start = single(own.frame_start),
                             .rest_length = static_cast<float>(own.length),
                             .behind = {},
                             .ahead = {}};
    set_material(random, question);
    const double weight = some_weight(random, question);
    question.ahead = asks(random, true, other.frame, some_rest(random), weight);
    question.behind = asks(random, false, beside(random, own.frame), some_rest(random), weight);
    return question;
  }

  static Json write(const Case& c) { return write_stencil(c); }
  static Case read(const Json& data) { return read_stencil<Case>(data); }
  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.vertex);
    shape.lines = {{0, 1}};
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    std::vector<Quantity> all;
    visit_members(c, [&]<class Member>(const char* name, const char* unit, const Member& member) {
      if constexpr (std::is_same_v<Member, float>)
        all.push_back(scalar(name, unit, member));
      else if constexpr (std::is_same_v<Member, Quaternion>)
        all.push_back(compare::numbers(name, unit, member));
      else
        all.push_back(labelled(points(name, unit, member), {"vertex 0, the first end", "vertex 1, the second end"}));
    });
    return all;
  }

  static In question(Cases cases) { return case_question(cases, &In::cases); }
  static void judge(Cases cases, const In&, const Truth& truth, const Out& out, Tally& tally) {
    tally.begin(cases[0].name);
    if (out.orientation.size() != cases.size()) {
      tally.mismatch("the answer does not have one orientation for each case");
      return;
    }
    for (std::size_t i = 0; i < cases.size(); ++i)
      judge_case(cases[i], truth.accepted[i], truth.near[i] != 0, out.orientation[i], tally);
  }
  static auto arrays(const Out& out) { return std::tie(out.orientation); }
  static std::string note(const Truth& truth) {
    const auto& accepted = truth.accepted[0];
    if (std::isinf(accepted.front().scale))
      return "grey: energy and residual decide alone; one of the minimisers is shown";
    return accepted.size() == 1 ? ""
                                : "grey: " + std::to_string(accepted.size()) + " answers are accepted, by their signs";
  }
  static std::vector<Quantity> outputs(const In&, const Out& out) {
    return {compare::numbers("orientation", "1", out.orientation.at(0))};
  }
  static std::vector<Quantity> outputs(const In&, const Truth& truth) {
    return {compare::numbers("orientation", "1", truth.accepted[0][0].orientation)};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return orientation_forms(); }
};

}  // namespace

constinit const StageTraits stages::orientation = make_traits<OrientationStage>();

}  // namespace ogc::compare
