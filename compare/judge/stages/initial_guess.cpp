// Makes the traits of stage initial_guess. Ladders approach bounds: a generator sets b_v to (1 + rung) ‖y − X_prev‖ in
// double. This differs from every contestant's value by only a few roundings to single precision.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/cases/rods/quaternions.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

Vec3 wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// Returns ‖y − x_prev‖ [m].
double move_of(const InitialGuessCase& c) {
  const double h = c.time_step;
  const Vec3 y = sum(wide(c.start), sum(scaled(wide(c.velocity), h), scaled(wide(c.acceleration), h * h)));
  return length(sum(y, scaled(wide(c.previous), -1)));
}

/// Returns a vertex of cloth in a scene of everyday size, at up to `speed` m/s.
InitialGuessCase falling(Random& random, double speed) {
  InitialGuessCase c;
  c.start = single(in_box(random, -1, 1));
  c.velocity = single(scaled(in_box(random, -1, 1), speed));
  c.acceleration = random.one_in(4) ? single(scaled(in_box(random, -1, 1), 20)) : Vec3f{0, -9.81f, 0};
  c.time_step = static_cast<float>(random.magnitude(-4, -1));
  // In a later round of the guess loop, X_prev is beyond xᵗ by a part of the step.
  const double part = random.one_in(2) ? 0 : random.unit();
  c.previous = single(sum(wide(c.start), scaled(wide(c.velocity), part * c.time_step)));
  return c;
}

float times(double length, double factor) { return static_cast<float>(length * factor); }

InitialGuessCase uniform(Random& random) {
  InitialGuessCase c = falling(random, 5);
  c.bound = times(move_of(c), random.between(0.05, 2));
  return c;
}

InitialGuessCase bits(Random& random) {
  const auto vector = [&] {
    return Vec3f{static_cast<float>(random.sign()) * random.pattern(),
                 static_cast<float>(random.sign()) * random.pattern(),
                 static_cast<float>(random.sign()) * random.pattern()};
  };
  InitialGuessCase c{vector(), vector(), vector(), 0, vector(), random.pattern()};
  c.time_step = static_cast<float>(std::ldexp(random.between(0.5, 1), -random.below(20)));
  return c;
}

/// Makes moves without rounding: powers of two, small integers, moves of rational length.
InitialGuessCase lattice(Random& random) {
  constexpr std::array<Vec3, 5> steps{{{3, 4, 0}, {1, 2, 2}, {2, 3, 6}, {1, 4, 8}, {5, 0, 0}}};
  constexpr std::array<float, 5> lengths{5, 3, 7, 9, 5};
  const int k = random.below(5);
  const float h = std::ldexp(1.0f, -random.below(7));
  std::array<Vec3, 1> step{steps[static_cast<std::size_t>(k)]};
  permute(random, step);
  InitialGuessCase c;
  c.start = c.previous = single(on_lattice(random, 3));
  (random.one_in(2) ? c.velocity : c.acceleration) = single(step[0]);
  c.time_step = h;
  const bool is_speed = !(c.velocity == Vec3f{});
  const float moved = lengths[static_cast<std::size_t>(k)] * h * (is_speed ? 1 : h);
  const std::array<float, 4> bounds{moved, std::nextafter(moved, 0.0f),
                                    std::nextafter(moved, std::numeric_limits<float>::infinity()), 2 * moved};
  c.bound = random.pick(std::span<const float>(bounds));
  return c;
}

/// Approaches b_v = ‖y − x_prev‖.
InitialGuessCase bound(Random& random) {
  InitialGuessCase c = falling(random, random.magnitude(-2, 2));
  c.bound = times(move_of(c), 1 + random.rung());
  return c;
}

/// Takes cases of `bound` with rungs of at most 10⁻⁵.
InitialGuessCase boundary(Random& random) {
  random.be_fine();
  return bound(random);
}

/// Makes fast vertices with small bounds: they move by 10² … 10⁶ bounds in a step.
InitialGuessCase fast(Random& random) {
  InitialGuessCase c = falling(random, random.magnitude(0, 5));
  c.bound = times(move_of(c), random.magnitude(-6, -2));
  return c;
}

/// Puts the vertex far from the origin, where the move nears the spacing of coordinates.
InitialGuessCase far(Random& random) {
  InitialGuessCase c = falling(random, random.magnitude(-3, 0));
  const Vec3 shift = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  c.start = single(sum(wide(c.start), shift));
  c.previous = single(sum(wide(c.previous), shift));
  c.bound = times(move_of(c), random.magnitude(-1, 0.5));
  return c;
}

/// Makes vertices nearly at rest: velocity, acceleration and bound are 0 or a rung.
InitialGuessCase still(Random& random) {
  InitialGuessCase c = falling(random, 1);
  const auto little = [&] {
    return random.one_in(2) ? Vec3f{} : single(scaled(in_box(random, -1, 1), std::abs(random.rung())));
  };
  c.velocity = little();
  c.acceleration = little();
  if (random.one_in(2)) c.previous = c.start;
  c.bound = static_cast<float>(random.one_in(3) ? 0 : std::abs(random.rung()));
  return c;
}

template <InitialGuessCase (*make)(Random&)>
CaseData alone(Random& random) {
  return GuessCase{make(random), {}};
}

using rod_cases::Four;

/// Returns a vector of this direction, with any length that a segment may have.
Vec3f stretched(Random& random, const Vec3& direction) {
  return single(scaled(direction, random.one_in(6) ? std::ldexp(1.0, random.below(70) - 38) : random.magnitude(-4, 0)));
}

/// Returns a case with a segment whose direction changes from `from` to `to`.
CaseData turned(Random& random, const Vec3& from, const Vec3& to, const Four& frame) {
  return GuessCase{uniform(random), TurnCase{stretched(random, from), stretched(random, to), rod_cases::single(frame)}};
}

/// Makes a segment that rotates by any angle, or by a small angle as in a time step.
CaseData turn(Random& random) {
  const Vec3 from = rod_cases::some_direction(random);
  const Four by = rod_cases::rotation(rod_cases::some_direction(random), random.magnitude(-6, 0.4));
  const Four frame = random.one_in(2) ? rod_cases::frame_along(random, from) : rod_cases::some_orientation(random);
  return turned(random, from, rod_cases::turned(by, from), frame);
}

/// Approaches rotations by an angle of 0 and of π. A direction may have length 0.
CaseData turn_at(Random& random) {
  if (random.one_in(2)) random.be_fine();
  const Vec3 from = random.one_in(2) ? rod_cases::some_direction(random)
                                     : scaled(on_lattice(random, 2), random.magnitude(-3, 0));
  const Vec3 across = rod_cases::some_direction(random);
  const double side = random.one_in(2) ? -1 : 1, size = length(from);
  const Vec3 to = random.one_in(10) ? Vec3{} : sum(scaled(from, side), scaled(across, size * random.rung()));
  return turned(random, from, to, rod_cases::some_orientation(random));
}

constexpr std::array<Generator, 11> table{{{"uniform", 25, true, alone<uniform>},
                                           {"bits", 15, false, alone<bits>},
                                           {"dust", 8, false, alone<uniform>},
                                           {"lattice", 20, false, alone<lattice>},
                                           {"ladder.bound", 15, false, alone<bound>},
                                           {"ladder.fast", 10, false, alone<fast>},
                                           {"ladder.far", 10, false, alone<far>},
                                           {"ladder.still", 5, false, alone<still>},
                                           {"ladder.boundary", 290, false, alone<boundary>},
                                           {"turn", 20, true, turn, 0, Stage::orientation},
                                           {"ladder.turn", 25, false, turn_at, 0, Stage::orientation}}};

}  // namespace

TruncateIn cut_question(const InitialGuessIn& in, const InitialGuessOut& out) {
  TruncateIn cut;
  for (std::size_t i = 0; i < in.cases.size(); ++i) {
    const bool is_point = i < out.target.size() && is_finite(out.target[i]);
    cut.previous.push_back(in.cases[i].previous);
    cut.position.push_back(is_point ? out.target[i] : in.cases[i].previous);
    cut.bound.push_back(in.cases[i].bound);
  }
  return cut;
}

void judge_turns(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth, const InitialGuessOut& out,
                 Tally& tally) {
  if (out.orientation.size() != in.turns.size()) {
    tally.mismatch("the answer does not have one orientation for each segment");
    return;
  }
  for (std::size_t i = 0; i < in.turns.size(); ++i) {
    tally.begin(cases[std::min(i, cases.size() - 1)].name);
    const Quaternion& q = out.orientation[i];
    const auto& exact = truth.orientation[i];
    double squared = 0, off = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      squared += double{q[k]} * q[k];
      off += (q[k] - exact[k]) * (q[k] - exact[k]);
    }
    if (!(std::abs(squared - 1) <= unit_quaternion_slack)) {
      tally.mismatch("turn: segment " + std::to_string(i) + " has no unit quaternion");
      continue;
    }
    if (std::isinf(truth.orientation_scale[i])) continue;
    tally.error(2, in_units(std::sqrt(off), truth.orientation_scale[i]), [&] {
      return "turn: segment " + std::to_string(i) +
             text(" is %.4g off, scale %.4g", std::sqrt(off), truth.orientation_scale[i]);
    });
  }
}

void judge_initial_guess(Cases cases, const InitialGuessIn& in, const InitialGuessTruth& truth,
                         const TruncateTruth& cut, const InitialGuessOut& out, Tally& tally) {
  tally.begin(cases[0].name);
  const std::size_t n = cases.size();
  if (out.target.size() != n || out.position.size() != n || out.cut.size() != n) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  judge_turns(cases, in, truth, out, tally);
  for (std::size_t i = 0; i < n; ++i) {
    const InitialGuessCase& c = in.cases[i];
    const Vec3f& y = out.target[i];
    tally.begin(cases[i].name);
    tally.count(1, 1, cut.grey[i], cut.near[i]);
    const Vec3& exact = truth.target[i];
    const double error = std::max({std::abs(y.x - exact.x), std::abs(y.y - exact.y), std::abs(y.z - exact.z)});
    tally.error(
        0, is_finite(y) ? in_units(error, truth.target_scale[i]) : std::numeric_limits<double>::infinity(),
        [&] { return text("a coordinate is %.4g from the exact one, terms of %.4g", error, truth.target_scale[i]); });
    if (!is_finite(y)) continue;
    if (out.cut[i] > 1 || (out.cut[i] != cut.cut[i] && !cut.grey[i])) {
      tally.mismatch("cut: " + std::to_string(out.cut[i]) + ", exact " + std::to_string(cut.cut[i]));
      continue;
    }
    if (out.cut[i] != cut.cut[i]) tally.answered_not_exactly();
    judge_position(c.previous, y, c.bound, cut.position[i], out.position[i], out.cut[i], 1, tally);
  }
}

namespace {

template <class Change>
WrongForm guess_asked(std::string name, std::string meaning, Change change) {
  return asked(std::move(name), std::move(meaning), &Authority::initial_guess, [change](InitialGuessIn& in) {
    for (InitialGuessCase& c : in.cases) change(c);
  });
}

template <class Change>
WrongForm turn_asked(std::string name, std::string meaning, Change change) {
  return asked(std::move(name), std::move(meaning), &Authority::initial_guess, [change](InitialGuessIn& in) {
    for (TurnCase& c : in.turns) change(c);
  });
}

Vec3f times(const Vec3f& v, float factor) { return {factor * v.x, factor * v.y, factor * v.z}; }

std::vector<WrongForm> initial_guess_forms() {
  return {
      guess_asked("acceleration_missing", "y without h² a_ext", [](InitialGuessCase& c) { c.acceleration = {}; }),
      guess_asked("half_acceleration", "h²/2 a_ext for h² a_ext",
                  [](InitialGuessCase& c) { c.acceleration = times(c.acceleration, 0.5f); }),
      guess_asked("acceleration_times_h", "h a_ext for h² a_ext",
                  [](InitialGuessCase& c) { c.acceleration = times(c.acceleration, 1 / c.time_step); }),
      guess_asked("acceleration_flipped", "a_ext with the other sign",
                  [](InitialGuessCase& c) { c.acceleration = times(c.acceleration, -1); }),
      guess_asked("velocity_missing", "y without h vᵗ", [](InitialGuessCase& c) { c.velocity = {}; }),
      guess_asked("from_previous", "y from X_prev in place of xᵗ", [](InitialGuessCase& c) { c.start = c.previous; }),
      turn_asked("turn_missing", "frames stay as they were", [](TurnCase& c) { c.now = c.before; }),
      turn_asked("turn_back", "the rotation from D to Dᵗ", [](TurnCase& c) { std::swap(c.now, c.before); }),
      turn_asked("turn_of_conjugate", "the conjugate of the frame, turned", [](TurnCase& c) {
        for (std::size_t k = 0; k < 3; ++k) c.orientation[k] = -c.orientation[k];
      })};
}

struct InitialGuess : BatchStage<InitialGuess, &Contestant::initial_guess, &Authority::initial_guess>,
                      TakenWhole,
                      ParametersOfCase<InitialGuess>,
                      InEveryRun {
  using Case = GuessCase;
  static constexpr StageInfo info{.name = "initial_guess",
                                  .question = "inertial target, truncated; a frame, turned",
                                  .unit = "vertex",
                                  .reference = "reference/solvers/initial_guess.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"target", "u scale", initial_guess_target_tolerance},
                                      MetricInfo{"position", "u (|x_prev| + b)", truncate_position_tolerance},
                                      MetricInfo{"turn", "u cond", initial_guess_turn_tolerance}};
  static constexpr std::array parameters{ranges::time_step, ranges::bound};
  static float* parameter(Case& c, std::string_view name) {
    return name == "h" ? &c.vertex.time_step : &c.vertex.bound;
  }

  static std::span<const Generator> generators() { return table; }

  static void check(const Case& whole, FirstProblem& problem) {
    const InitialGuessCase& c = whole.vertex;
    problem.vector("a coordinate", c.start);
    problem.vector("a coordinate", c.previous);
    problem.vector("a velocity", c.velocity);
    problem.vector("an acceleration", c.acceleration);
    problem.number("a time step", c.time_step, least_length, 1);
    problem.number("a bound", c.bound, 0, vast);
    if (!whole.turn) return;
    rod_cases::check_unit(problem, whole.turn->orientation);
    for (const Vec3f& d : {whole.turn->before, whole.turn->now}) {
      const double size = std::hypot(d.x, d.y, d.z);
      problem.require(size == 0 || (size >= 0x1p-50 && size <= 0x1p40), "a segment is too short or too long");
    }
  }
  static void mutate(Random& random, Case& c) {
    mutate_together(random, std::span(&c.vertex.previous, 1), std::span(&c.vertex.start, 1));
  }
  static std::vector<float*> coordinates(Case& whole) {
    InitialGuessCase& c = whole.vertex;
    auto all = coordinates_of({{&c.start, 1}, {&c.velocity, 1}, {&c.acceleration, 1}, {&c.previous, 1}});
    all.push_back(&c.bound);
    return all;
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return {states.guessed_vertex(states.frame(index), random), {}};
  }

  static Json write(const Case& whole) {
    const InitialGuessCase& c = whole.vertex;
    Json json{{"start", to_json(c.start)},
              {"velocity", to_json(c.velocity)},
              {"acceleration", to_json(c.acceleration)},
              {"time_step", hexadecimal(c.time_step)},
              {"previous", to_json(c.previous)},
              {"bound", hexadecimal(c.bound)}};
    if (whole.turn)
      json["turn"] = {
          {"before", to_json(whole.turn->before)},
          {"now", to_json(whole.turn->now)},
          {"orientation", numbers_to_json({whole.turn->orientation.begin(), whole.turn->orientation.end()})}};
    return json;
  }
  static Case read(const Json& data) {
    Case whole{{to_point(data.at("start")), to_point(data.at("velocity")), to_point(data.at("acceleration")),
                number(data.at("time_step")), to_point(data.at("previous")), number(data.at("bound"))},
               {}};
    if (!data.contains("turn")) return whole;
    const Json& turn = data.at("turn");
    const std::vector<float> q = to_numbers(turn.at("orientation"));
    if (q.size() != 4) throw InputError("an orientation needs four numbers");
    whole.turn = {to_point(turn.at("before")), to_point(turn.at("now")), {q[0], q[1], q[2], q[3]}};
    return whole;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.dots.push_back(shape.add(c.vertex.previous));
    shape.add(c.vertex.start);
    shape.lines.push_back({0, 1});
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& whole) {
    const InitialGuessCase& c = whole.vertex;
    std::vector<Quantity> all{points("start", "m", std::array{c.start}),
                              points("velocity", "m/s", std::array{c.velocity}),
                              points("acceleration", "m/s²", std::array{c.acceleration}),
                              scalar("time_step", "s", c.time_step),
                              points("previous", "m", std::array{c.previous}),
                              scalar("bound", "m", c.bound)};
    if (!whole.turn) return all;
    all.push_back(points("before", "m", std::array{whole.turn->before}));
    all.push_back(points("now", "m", std::array{whole.turn->now}));
    all.push_back(compare::numbers("orientation", "1", whole.turn->orientation));
    return all;
  }

  /// If any case has a segment, every case gets one, so that entry i of each array belongs to case i. Cases without a
  /// segment get one of length 0.
  static In question(Cases cases) {
    In in;
    const bool any = std::ranges::any_of(cases,
                                         [](const TestCase& t) { return case_of<Case>(t.data).turn.has_value(); });
    for (const TestCase& test : cases) {
      const Case& c = case_of<Case>(test.data);
      in.cases.push_back(c.vertex);
      if (any) in.turns.push_back(c.turn.value_or(TurnCase{}));
    }
    return in;
  }
  /// Adds a segment's bits only for cases with a segment, because bits must not depend on other cases of the batch.
  static std::vector<std::string> bits(Cases cases, const Contestant& c, const Authority&) {
    const Out out = c.initial_guess(question(cases));
    std::vector<std::string> all = bits_by_case(cases.size(), out.target, out.position, out.cut);
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (case_of<Case>(cases[i].data).turn)
        all[i].append(reinterpret_cast<const char*>(&out.orientation[i]), sizeof out.orientation[i]);
    return all;
  }
  static auto arrays(const Out& out) { return std::tie(out.target, out.position, out.cut, out.orientation); }

  static bool can_judge(const Contestant& c, const Authority& a) {
    return c.initial_guess && a.initial_guess && a.truncate;
  }
  /// Judges position and cut by the authority's truncation of the answer's y.
  static void ask(Cases cases, const Contestant& c, const Authority& a, Asker& asker, Tally& tally) {
    const In in = question(cases);
    const Out out = asker.answer(in, c.initial_guess);
    const TruncateTruth cut = asker.truth(cut_question(in, out), a.truncate);
    judge_initial_guess(cases, in, asker.truth(in, a.initial_guess), cut, out, tally);
  }

  static std::vector<Quantity> outputs(const Quantity& target, const Quantity& position, unsigned cut) {
    return {target, position, flag("cut", cut)};
  }
  static Answers answers(const TestCase& test, const Contestant& c, const Authority& a) {
    const In in = question({&test, 1});
    const Truth truth = a.initial_guess(in);
    std::string note;
    const std::optional<Out> out = answer_or_note(c.initial_guess, in, note);
    const TruncateTruth cut = a.truncate(cut_question(in, out ? *out : Out{}));
    std::vector<Quantity> given;
    if (out)
      given = outputs(points("target", "m", std::array{out->target.at(0)}),
                      points("position", "m", std::array{out->position.at(0)}), out->cut.at(0));
    return paired(given,
                  outputs(points("target", "m", std::array{truth.target[0]}),
                          points("position", "m", std::array{cut.position[0]}), cut.cut[0]),
                  note);
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return initial_guess_forms(); }
};

}  // namespace

constinit const StageTraits stages::initial_guess = make_traits<InitialGuess>();

}  // namespace ogc::compare
