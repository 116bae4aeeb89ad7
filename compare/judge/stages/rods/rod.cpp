// Makes the traits of stage rod. Ladders approach the rest shape, where the force cancels; a rigid motion since the
// start, where damping vanishes; segments without length; and a director opposite to D.
#include <array>
#include <cmath>
#include <numbers>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"
#include "compare/judge/stages/rods/rod_cases.hpp"

namespace ogc::compare {

namespace {

using namespace placement;
using rod_cases::Four;

void set_material(Random& random, RodCase& question) {
  question.stretch = static_cast<float>(random.one_in(3) ? 0.1 : random.magnitude(-3, 6));
  question.damping = random.one_in(2) ? 0 : static_cast<float>(random.magnitude(-3, 1));
  if (random.one_in(4)) question.damping_form = another(random, DampingForm::strain);
  question.own = random.below(2);
}

/// Returns a segment at a random position with D = `apart` and Dᵗ = `before`, where D is x₁ − x₀.
CaseData placed(Random& random, double rest_length, const Vec3& apart, const Vec3& before, const Four& q,
                const Four& start, bool around = true) {
  RodCase question;
  const double size = std::hypot(apart.x, apart.y, apart.z) + rest_length;
  const Vec3 from = around ? scaled(in_box(random, -1, 1), random.one_in(2) ? size : 0) : Vec3{};
  const Vec3 moved = random.one_in(2) ? from : sum(from, scaled(in_box(random, -1, 1), 0.1 * size));
  question.vertex = {single(from), single(sum(from, apart))};
  question.start = {single(moved), single(sum(moved, before))};
  question.orientation = rod_cases::single(q);
  question.orientation_start = rod_cases::single(start);
  question.rest_length = static_cast<float>(rest_length);
  set_material(random, question);
  return question;
}

/// Returns D = l R(q) (e₃ + strain), the vector along a segment with this strain relative to q.
Vec3 strained(const Four& q, double length, const Vec3& strain) {
  return scaled(rod_cases::turned(q, {strain.x, strain.y, strain.z + 1}), length);
}

/// Stretches, shears and turns a segment.
CaseData uniform(Random& random) {
  const Four q = rod_cases::some_orientation(random), start = rod_cases::some_orientation(random);
  const double length = rod_cases::some_length(random);
  return placed(random, length, strained(q, length, in_box(random, -1, 2)),
                strained(start, length, in_box(random, -1, 2)), q, start);
}

/// Makes cases without rounding: ends on a lattice, orientations of the cube.
CaseData lattice(Random& random) {
  const double size = std::ldexp(1.0, random.below(9) - 8);
  return placed(random, size, scaled(on_lattice(random, 3), size), scaled(on_lattice(random, 3), size),
                rod_cases::on_lattice(random), rod_cases::on_lattice(random), false);
}

/// Takes random bits for coordinates and material.
CaseData bits(Random& random) {
  RodCase question;
  const std::array<Vec3, 4> points = points_of_bits(random);
  question.vertex = {single(points[0]), single(points[1])};
  question.start = {single(points[2]), single(points[3])};
  question.orientation = rod_cases::single(rod_cases::some_orientation(random));
  question.orientation_start = rod_cases::single(rod_cases::some_orientation(random));
  set_material(random, question);
  question.rest_length = random.pattern(0x1p-7f, 0x1p20f);  // The contract allows growth up to 2³⁰ times this length.
  question.stretch = random.pattern();
  return question;
}

/// Makes segments of the largest and smallest sizes that scenes may have.
CaseData scales(Random& random) {
  const double length = std::ldexp(random.between(1, 2), random.one_in(2) ? 19 : -20);
  const Four q = rod_cases::some_orientation(random), start = rod_cases::beside(random, q);
  return placed(random, length, strained(q, length, in_box(random, -0.5, 0.5)),
                strained(start, length, in_box(random, -0.5, 0.5)), q, start, random.one_in(2));
}

/// Approaches D/l = R(q) e₃.
CaseData at_rest(Random& random) {
  const Four q = rod_cases::some_orientation(random), start = rod_cases::beside(random, q);
  const double length = rod_cases::some_length(random);
  const Vec3 strain{random.rung(), random.rung(), random.rung()};
  return placed(random, length, strained(q, length, strain), strained(start, length, in_box(random, -0.1, 0.1)), q,
                start);
}

/// Moves a segment rigidly since the start of the time step, except for a strain of a rung. Then damping nearly
/// vanishes.
CaseData turned_rigidly(Random& random) {
  const Four q = rod_cases::some_orientation(random), start = rod_cases::some_orientation(random);
  const double length = rod_cases::some_length(random);
  const Vec3 strain = in_box(random, -0.5, 1), more{random.rung(), random.rung(), random.rung()};
  return placed(random, length, strained(q, length, sum(strain, more)), strained(start, length, strain), q, start);
}

/// Approaches D = 0 and Dᵗ = 0.
CaseData short_one(Random& random) {
  const Four q = rod_cases::some_orientation(random), start = rod_cases::some_orientation(random);
  const double length = random.magnitude(-2, 0);  // so that a rung times this length is a legal length
  const Vec3 before = random.one_in(2) ? strained(start, length, {})
                                       : scaled(rod_cases::some_direction(random), length * random.rung());
  return placed(random, length, scaled(rod_cases::some_direction(random), length * random.rung()), before, q, start,
                false);
}

/// Approaches a director R(q) e₃ = −D/‖D‖. In half of the cases q approaches the rotation by π about the x axis, whose
/// real part is 0.
CaseData reversed(Random& random) {
  const Vec3 axis = rod_cases::some_direction(random);
  Four q = rod_cases::product(rod_cases::rotation({1, 0, 0}, std::numbers::pi),
                              rod_cases::rotation(axis, random.rung()));
  const Four turn = random.one_in(2) ? Four{0, 0, 0, 1} : rod_cases::some_orientation(random);
  q = rod_cases::product(turn, q);
  const double length = rod_cases::some_length(random);
  return placed(random, length, strained(turn, length, {}), strained(turn, length, {}), q, turn);
}

constexpr std::array<Generator, 9> table{{{"uniform", 30, true, uniform},
                                          {"bits", 15, false, bits},
                                          {"dust", 8, false, uniform},
                                          {"scales", 10, true, scales},
                                          {"lattice", 15, false, lattice},
                                          {"ladder.rest", 20, false, at_rest},
                                          {"ladder.rigid", 15, false, turned_rigidly},
                                          {"ladder.zero", 10, false, short_one},
                                          {"ladder.reversed", 10, false, reversed}}};

std::vector<WrongForm> rod_forms() {
  constexpr auto stage = &Authority::rod;
  std::vector<WrongForm> forms = common_forms(stage);
  // the block is k I
  std::erase_if(forms, [](const WrongForm& form) { return form.name == "hessian_diagonal_alone"; });
  add_damping(forms, stage);
  const auto add = [&](const char* name, const char* meaning, auto change) {
    forms.push_back(case_asked(name, meaning, stage, change));
  };
  const auto conjugated = [](Quaternion& q) {
    for (std::size_t k = 0; k < 3; ++k) q[k] = -q[k];
  };
  add("conjugate_frame", "R(q)ᵀ for R(q): the director of the conjugate",
      [=](RodCase& c) { conjugated(c.orientation); });
  add("conjugate_start", "R(qᵗ) for R(qᵗ)ᵀ", [=](RodCase& c) { conjugated(c.orientation_start); });
  add("old_frame_read", "qᵗ in place of q", [](RodCase& c) { c.orientation = c.orientation_start; });
  add("start_frame_now", "q in place of qᵗ: damping turns with the segment",
      [](RodCase& c) { c.orientation_start = c.orientation; });
  add("other_end", "the force of the other end", [](RodCase& c) {
    if (damps_strain(c.damping_form)) c.own = 1 - c.own;
  });
  add("length_missing", "l is 1 m", [](RodCase& c) { c.rest_length = 1; });
  add("real_part_first", "w read as x: the order w, x, y, z", [](RodCase& c) {
    for (Quaternion* q : {&c.orientation, &c.orientation_start}) *q = {(*q)[1], (*q)[2], (*q)[3], (*q)[0]};
  });
  return forms;
}

struct RodStage : ForceStage<RodStage, RodCase, &Contestant::rod, &Authority::rod> {
  static constexpr StageInfo info{.name = "rod",
                                  .question = "force and block of one end of one segment of a rod",
                                  .unit = "stencil",
                                  .reference = "reference/energies/rods/rod.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"force", "u cond", rod_force_tolerance},
                                      MetricInfo{"block", "u cond", rod_block_tolerance}};
  static constexpr std::array parameters = rod_cases::segment_parameters;
  static float* parameter(Case& c, std::string_view name) { return rod_cases::segment_parameter(c, name); }

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& c, FirstProblem& problem) {
    rod_cases::check_segment(problem, c);
    problem.require(c.own == 0 || c.own == 1, "no such end is asked about");
  }
  static void mutate(Random& random, Case& c) { mutate_together(random, c.vertex, c.start); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.vertex, c.start}); }
  static std::string missing_in(const States& states) {
    return states.topology().edges.empty() ? "its mesh has no edge" : "";
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    const rod_cases::EdgeOfState edge(random, states.edge_edge(states.frame(index), random).first);
    RodCase question{.vertex = edge.vertex,
                     .start = edge.start,
                     .orientation = rod_cases::single(edge.frame),
                     .orientation_start = rod_cases::single(edge.frame_start),
                     .rest_length = static_cast<float>(edge.length)};
    set_material(random, question);
    return question;
  }
  static Case checked(Case c) {
    if (c.own != 0 && c.own != 1) throw InputError("own: " + std::to_string(c.own) + " is not an end of the segment");
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.add_all(c.vertex);
    shape.lines = {{0, 1}};
    shape.dots.push_back(c.own);
    return shape;
  }
  static std::vector<std::string> roles(const Case&) { return {"vertex 0, the first end", "vertex 1, the second end"}; }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return rod_forms(); }
};

}  // namespace

constinit const StageTraits stages::rod = make_traits<RodStage>();

}  // namespace ogc::compare
