// Stage truncate.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// A vertex at `previous` moved by `step`.
CaseData moved(const Vec3& previous, const Vec3& step, float bound) {
  const Vec3f from = single(previous);
  return TruncateCase{from, single(sum({from.x, from.y, from.z}, step)), bound};
}

double length(const Vec3& a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

CaseData truncate_uniform(Random& random) {
  const Vec3 step = scaled(in_box(random, -1, 1), random.magnitude(-4, 0));
  return moved(in_box(random, -1, 1), step, static_cast<float>(length(step) * random.between(0.05, 2)));
}

CaseData truncate_bits(Random& random) {
  const auto coordinate = [&] { return static_cast<float>(random.sign()) * random.pattern(); };
  const Vec3f a{coordinate(), coordinate(), coordinate()}, b{coordinate(), coordinate(), coordinate()};
  return TruncateCase{a, b, random.pattern()};
}

/// Steps of rational length, so that ‖x − x_prev‖ = b exactly or misses it by one bit.
CaseData truncate_lattice(Random& random) {
  constexpr std::array<Vec3, 6> steps{{{3, 4, 0}, {1, 2, 2}, {2, 3, 6}, {1, 4, 8}, {4, 4, 7}, {5, 0, 0}}};
  constexpr std::array<double, 6> lengths{5, 3, 7, 9, 9, 5};
  const int k = random.below(6);
  const double scale = std::ldexp(1.0, random.below(21) - 10);
  std::array<Vec3, 1> step{scaled(steps[k], scale)};
  permute(random, step);
  return moved(scaled(on_lattice(random, 3), random.one_in(2) ? scale : 1), step[0],
               beside(random, static_cast<float>(lengths[k] * scale)));
}

/// ‖x − x_prev‖ → b.
CaseData truncate_bound(Random& random) {
  const TruncateCase c = case_of<TruncateCase>(
      moved(in_box(random, -1, 1), scaled(in_box(random, -1, 1), random.magnitude(-6, 0)), 0));
  const Vec3 step{double{c.position.x} - c.previous.x, double{c.position.y} - c.previous.y,
                  double{c.position.z} - c.previous.z};
  return TruncateCase{c.previous, c.position, beside(random, static_cast<float>(length(step)))};
}

/// A bound that tends to the spacing of the coordinates and below.
CaseData truncate_far(Random& random) {
  const Vec3 step = scaled(in_box(random, -1, 1), random.magnitude(-3, 0));
  return moved(scaled(in_box(random, -1, 1), random.magnitude(0, 6)), step,
               static_cast<float>(length(step) * random.magnitude(-5, 0.5)));
}

/// Bound or step zero or almost.
CaseData truncate_zero(Random& random) {
  const Vec3 step = random.one_in(3) ? Vec3{} : scaled(in_box(random, -1, 1), std::abs(random.rung()));
  return moved(random.one_in(2) ? Vec3{} : in_box(random, -1, 1), step,
               static_cast<float>(random.one_in(3) ? 0 : std::abs(random.rung())));
}

constexpr std::array<Generator, 7> truncate_table{{{"uniform", 20, true, truncate_uniform},
                                                   {"bits", 20, false, truncate_bits},
                                                   {"dust", 8, false, truncate_uniform},
                                                   {"lattice", 20, false, truncate_lattice},
                                                   {"ladder.bound", 60, false, truncate_bound},
                                                   {"ladder.far", 10, false, truncate_far},
                                                   {"ladder.zero", 10, false, truncate_zero}}};

}  // namespace

void judge_position(const Vec3f& previous, const Vec3f& asked, float bound, const Vec3& exact, const Vec3f& stored,
                    bool cut, std::size_t metric, Tally& tally) {
  if (!is_finite(stored)) {
    tally.mismatch("position: not finite");
    return;
  }
  if (!obeys_bound(stored, previous, bound)) {
    const double moved = std::hypot(double{stored.x} - previous.x, double{stored.y} - previous.y,
                                    double{stored.z} - previous.z);
    tally.mismatch(text("position: the stored position is %.17g from the previous one, bound %.9g", moved, bound));
    return;
  }
  if (!cut && !(stored == asked)) {
    tally.mismatch("position: nothing is cut, but the position did not come back bit for bit");
    return;
  }
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  const double size = std::max({std::abs(previous.x), std::abs(previous.y), std::abs(previous.z)});
  tally.error(metric, in_units(error, size + bound),
              [&] { return text("%.4g from the exact position, bound %.9g", error, bound); });
}

void judge_truncate(Cases cases, const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out,
                    Tally& tally) {
  tally.begin(cases[0].name);
  if (out.position.size() != cases.size() || out.cut.size() != cases.size()) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, truth.grey[i], truth.near[i]);
    if (out.cut[i] > 1 || (out.cut[i] != truth.cut[i] && !truth.grey[i])) {
      tally.mismatch("cut: " + std::to_string(out.cut[i]) + ", exact " + std::to_string(truth.cut[i]));
      continue;
    }
    if (out.cut[i] != truth.cut[i]) tally.answered_not_exactly();
    judge_position(in.previous[i], in.position[i], in.bound[i], truth.position[i], out.position[i], out.cut[i], 0,
                   tally);
  }
}

namespace {

TruncateIn truncate_question(Cases cases) {
  TruncateIn in;
  for (const TestCase& test : cases) {
    const auto& c = case_of<TruncateCase>(test.data);
    in.previous.push_back(c.previous);
    in.position.push_back(c.position);
    in.bound.push_back(c.bound);
  }
  return in;
}

/// Whether the stored position lies where the truth does, by the distance alone: the bound, which the judge checks
/// exactly, may be missed by a rounding.
bool lies_there(const Vec3f& stored, const Vec3& exact, const Vec3f& previous, double bound) {
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  const double size = std::max({std::abs(previous.x), std::abs(previous.y), std::abs(previous.z)});
  return in_units(error, size + bound) <= truncate_position_tolerance;
}

/// `stored(X_prev, x, b_v, truth)`: where the form stores a vertex that is cut; which ones are cut the truth says.
template <class Stored>
WrongForm stored_at(std::string name, std::string meaning, Stored stored) {
  return {std::move(name), std::move(meaning), [stored](const Evidence& evidence, const Authority& authority) {
            const TruncateIn in = truncate_question({&evidence.test, 1});
            const TruncateOut out = evidence.answered.truncate(in);
            const TruncateTruth truth = authority.truncate(in);
            if (out.position.size() != 1 || out.cut.size() != 1) return false;
            if (out.cut[0] != truth.cut[0] && !truth.grey[0]) return false;
            const Vec3 where = truth.cut[0]
                                   ? stored(in.previous[0], in.position[0], double{in.bound[0]}, truth.position[0])
                                   : truth.position[0];
            return lies_there(out.position[0], where, in.previous[0], in.bound[0]);
          }};
}

Vec3 wide(const Vec3f& p) { return {p.x, p.y, p.z}; }

std::vector<WrongForm> truncate_forms() {
  return {
      stored_at("rounded_to_nearest",
                "the right position, rounded to nearest: by the last bit the stored one may lie outside the bound",
                [](const Vec3f&, const Vec3f&, double, const Vec3& exact) { return exact; }),
      stored_at("not_truncated", "what exceeds the bound is stored as it came",
                [](const Vec3f&, const Vec3f& position, double, const Vec3&) { return wide(position); }),
      stored_at("moved_back", "what exceeds the bound goes back to X_prev: a stale position",
                [](const Vec3f& previous, const Vec3f&, double, const Vec3&) { return wide(previous); }),
      stored_at("clamped_by_coordinate", "each coordinate of the motion is clamped to ±b: a box in place of the ball",
                [](const Vec3f& p, const Vec3f& x, double b, const Vec3&) {
                  const auto clamped = [b](double from, double to) { return from + std::clamp(to - from, -b, b); };
                  return Vec3{clamped(p.x, x.x), clamped(p.y, x.y), clamped(p.z, x.z)};
                }),
      {"flag_inverted", "`cut` says the opposite", [](const Evidence& evidence, const Authority& authority) {
         const TruncateIn in = truncate_question({&evidence.test, 1});
         const TruncateOut out = evidence.answered.truncate(in);
         Evidence flipped = evidence;
         flipped.answered.truncate = [out](const TruncateIn&) {
           TruncateOut other = out;
           for (std::uint8_t& flag : other.cut) flag = !flag;
           return other;
         };
         return agrees(flipped, authority);
       }}};
}

struct Truncate : BatchStage<Truncate, &Contestant::truncate, &Authority::truncate>,
                  TakenWhole,
                  ParametersOfCase<Truncate>,
                  InEveryRun {
  using Case = TruncateCase;
  static constexpr StageInfo info{.name = "truncate",
                                  .question = "a position kept within its bound",
                                  .unit = "vertex",
                                  .reference = "reference/geometry/truncate.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"position", "u (|x_prev| + b)", truncate_position_tolerance}};
  static constexpr std::array parameters{ranges::bound};
  static float* parameter(Case& c, std::string_view) { return &c.bound; }

  static std::span<const Generator> generators() { return truncate_table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vector("a coordinate", c.previous);
    problem.vector("a coordinate", c.position);
    problem.number("a bound", c.bound, 0, std::numeric_limits<float>::max());
  }
  static void mutate(Random& random, Case& c) {
    mutate_together(random, std::span(&c.previous, 1), std::span(&c.position, 1));
  }
  static std::vector<float*> coordinates(Case& c) {
    auto all = coordinates_of({{&c.previous, 1}, {&c.position, 1}});
    all.push_back(&c.bound);
    return all;
  }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.moved_vertex(states.frame(index), random);
  }

  static Json write(const Case& c) {
    return {{"previous", to_json(c.previous)}, {"position", to_json(c.position)}, {"bound", hexadecimal(c.bound)}};
  }
  static Case read(const Json& data) {
    return {to_point(data.at("previous")), to_point(data.at("position")), number(data.at("bound"))};
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.dots.push_back(shape.add(c.previous));
    shape.add(c.position);
    shape.lines.push_back({0, 1});
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    return {points("previous", "m", std::array{c.previous}), points("position", "m", std::array{c.position}),
            scalar("bound", "m", c.bound)};
  }

  static constexpr auto question = truncate_question;
  static constexpr auto judge = judge_truncate;
  static auto arrays(const Out& out) { return std::tie(out.position, out.cut); }

  /// `Out` and `Truth` have the same members.
  template <class Answer>
  static std::vector<Quantity> outputs(const In&, const Answer& answer) {
    return {points("position", "m", std::array{answer.position.at(0)}), flag("cut", answer.cut.at(0))};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return truncate_forms(); }
};

}  // namespace

constinit const StageTraits stages::truncate = make_traits<Truncate>();

}  // namespace ogc::compare
