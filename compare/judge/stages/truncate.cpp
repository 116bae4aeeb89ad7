// Makes the traits of stage truncate.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/exact_sum.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

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

namespace {

/// Judges a position with half-spaces.
void judge_region(const TruncateIn& in, const TruncateTruth& truth, const TruncateOut& out, std::size_t i,
                  Tally& tally) {
  const Vec3f &stored = out.position[i], &previous = in.previous[i];
  if (!is_finite(stored)) return tally.mismatch("region: the position is not finite");
  if (!obeys_bound(stored, previous, in.bound[i]))
    return tally.mismatch(
        text("region: the stored position leaves the ball of %.9g m, %.9g m from X_prev", in.bound[i],
             std::hypot(double{stored.x} - previous.x, double{stored.y} - previous.y, double{stored.z} - previous.z)));
  const auto half_spaces = in.half_spaces.of(i);
  for (std::size_t k = 0; k < half_spaces.size(); ++k) {
    const HalfSpace& h = half_spaces[k];
    if (obeys_half_space(stored, h)) continue;
    const double height = double{h.normal.x} * stored.x + double{h.normal.y} * stored.y + double{h.normal.z} * stored.z;
    return tally.mismatch("region: the stored position leaves half-space " + std::to_string(k) +
                          text(", n·x = %.17g, o = %.17g", height, h.offset));
  }
  if (out.cut[i] == 0 && !(stored == in.position[i]))
    return tally.mismatch("region: nothing is cut, but the position did not come back bit for bit");
  const Vec3& exact = truth.position[i];
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  tally.error(1, error == 0 ? 0 : error / truth.accepted[i], [&] {
    return text("%.4g m from where it slides, or its way ends; %.4g accepted", error, truth.accepted[i]);
  });
}

}  // namespace

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
    if (!in.half_spaces.of(i).empty())
      judge_region(in, truth, out, i, tally);
    else
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
  const auto has_half_spaces = [](const TestCase& test) {
    return !case_of<TruncateCase>(test.data).half_spaces.empty();
  };
  if (!std::ranges::any_of(cases, has_half_spaces)) return in;
  HalfSpacesIn& all = in.half_spaces;
  all.offsets.push_back(0);
  for (const TestCase& test : cases) {
    const auto& c = case_of<TruncateCase>(test.data);
    all.items.insert(all.items.end(), c.half_spaces.begin(), c.half_spaces.end());
    all.offsets.push_back(static_cast<Index>(all.items.size()));
    all.current.push_back(c.current);
    all.block.push_back(c.block);
    all.is_prescribed.push_back(c.is_prescribed);
  }
  return in;
}

/// Checks whether the stored position is the exact one up to the tolerance. The bound is not checked here, because the
/// position of a form may exceed the bound by a rounding error.
bool lies_there(const Vec3f& stored, const Vec3& exact, const Vec3f& previous, double bound) {
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  const double size = std::max({std::abs(previous.x), std::abs(previous.y), std::abs(previous.z)});
  return in_units(error, size + bound) <= truncate_position_tolerance;
}

/// Makes a form that stores a cut vertex at `stored(X_prev, x, b_v, exact)`, where `exact` is the right position. A
/// vertex is cut in this form if it is cut in the truth.
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
      {"flag_inverted", "`cut` says the opposite",
       [](const Evidence& evidence, const Authority& authority) {
         const TruncateIn in = truncate_question({&evidence.test, 1});
         const TruncateOut out = evidence.answered.truncate(in);
         Evidence flipped = evidence;
         flipped.answered.truncate = [out](const TruncateIn&) {
           TruncateOut other = out;
           for (std::uint8_t& flag : other.cut) flag = !flag;
           return other;
         };
         return agrees(flipped, authority);
       }},
      asked("scaled_in_place_of_slid", "a vertex stops on its way to a half-space in place of sliding along it",
            &Authority::truncate, [](TruncateIn& in) { std::ranges::fill(in.half_spaces.is_prescribed, 1); }),
      asked("slid_by_distance", "the shortest way out of a half-space in place of that of H", &Authority::truncate,
            [](TruncateIn& in) { std::ranges::fill(in.half_spaces.block, inertia_block); }),
      asked("prescribed_slides", "a prescribed vertex slides by the shortest way", &Authority::truncate,
            [](TruncateIn& in) {
              for (std::size_t i = 0; i < in.half_spaces.is_prescribed.size(); ++i)
                if (std::exchange(in.half_spaces.is_prescribed[i], 0) != 0) in.half_spaces.block[i] = inertia_block;
            })};
}

/// Checks whether n·x is below o by at least 2⁻⁵⁰ (Σ|n_k x_k| + |o|).
bool keeps_with_room(const HalfSpace& h, const Vec3f& x) {
  const double a = double{h.normal.x} * x.x, b = double{h.normal.y} * x.y, c = double{h.normal.z} * x.z;
  return a + b + c + 0x1p-50 * (std::abs(a) + std::abs(b) + std::abs(c) + std::abs(h.offset)) <= h.offset;
}

void check_region(const TruncateCase& c, FirstProblem& problem) {
  problem.vector("a coordinate", c.current);
  problem.require(obeys_bound(c.current, c.previous, c.bound), "the current position lies outside of the ball");
  for (const HalfSpace& h : c.half_spaces) {
    problem.vector("a normal", h.normal);
    problem.require(std::isfinite(h.offset) && keeps_with_room(h, c.previous) && keeps_with_room(h, c.current),
                    "X_prev or the current position does not keep a half-space");
  }
  for (const float h : c.block) problem.number("an entry of H", h, -vast, vast);
  const auto& [xx, xy, xz, yy, yz, zz] = c.block;
  const double minor = double{xx} * yy - double{xy} * xy,
               determinant = zz * minor - double{yz} * (double{xx} * yz - double{xy} * xz) +
                             double{xz} * (double{xy} * yz - double{yy} * xz);
  problem.require(xx > 0 && minor > 0 && determinant > 0, "H is not positive definite");
}

Json region_to_json(const TruncateCase& c) {
  Json half_spaces = Json::array(), block = Json::array();
  for (const HalfSpace& h : c.half_spaces)
    half_spaces.push_back({{"normal", to_json(h.normal)}, {"offset", hexadecimal_of(h.offset)}});
  for (const float h : c.block) block.push_back(hexadecimal(h));
  return {{"half_spaces", half_spaces},
          {"current", to_json(c.current)},
          {"block", block},
          {"is_prescribed", c.is_prescribed}};
}

void read_region(const Json& data, TruncateCase& c) {
  for (const Json& h : data.at("half_spaces"))
    c.half_spaces.push_back({to_point(h.at("normal")), number_of_double(h.at("offset"))});
  c.current = to_point(data.at("current"));
  for (std::size_t k = 0; k < c.block.size(); ++k) c.block[k] = number(data.at("block").at(k));
  c.is_prescribed = data.at("is_prescribed").get<std::uint8_t>();
}

struct Truncate : BatchStage<Truncate, &Contestant::truncate, &Authority::truncate>, TakenWhole, InEveryRun {
  using Case = TruncateCase;
  static constexpr StageInfo info{.name = "truncate",
                                  .question = "a position kept within its bound, or its region",
                                  .unit = "vertex",
                                  .reference = "reference/geometry/truncate.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"position", "u (|x_prev| + b)", truncate_position_tolerance},
                                      MetricInfo{"region", "accepted error", 1}};
  static constexpr std::array parameters{ranges::bound};
  /// Sets the bound, and moves the vertex to X_prev, which is always within it.
  static std::string set(Case& c, std::span<const Override> values) {
    for (const Override& value : values) c.bound = value.value;
    c.current = c.previous;
    return "";
  }

  static std::span<const Generator> generators() { return truncate_generators(); }

  static void check(const Case& c, FirstProblem& problem) {
    problem.vector("a coordinate", c.previous);
    problem.vector("a coordinate", c.position);
    problem.number("a bound", c.bound, 0, std::numeric_limits<float>::max());
    if (!c.half_spaces.empty()) check_region(c, problem);
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
    Json json{{"previous", to_json(c.previous)}, {"position", to_json(c.position)}, {"bound", hexadecimal(c.bound)}};
    if (!c.half_spaces.empty()) json["region"] = region_to_json(c);
    return json;
  }
  static Case read(const Json& data) {
    Case c{to_point(data.at("previous")), to_point(data.at("position")), number(data.at("bound"))};
    if (data.contains("region")) read_region(data.at("region"), c);
    return c;
  }

  static Shape shape(const Case& c) {
    Shape shape;
    shape.dots.push_back(shape.add(c.previous));
    shape.add(c.position);
    shape.lines.push_back({0, 1});
    return shape;
  }
  static std::vector<Quantity> inputs(const Case& c) {
    std::vector<Quantity> all{points("previous", "m", std::array{c.previous}),
                              points("position", "m", std::array{c.position}), scalar("bound", "m", c.bound)};
    if (c.half_spaces.empty()) return all;
    std::vector<Vec3f> normals;
    std::vector<double> offsets;
    for (const HalfSpace& h : c.half_spaces) normals.push_back(h.normal), offsets.push_back(h.offset);
    return joined(std::move(all),
                  std::vector{points("normals", "1", normals), compare::numbers("offsets", "m", offsets),
                              points("current", "m", std::array{c.current}), compare::numbers("block", "N/m", c.block),
                              flag("is_prescribed", c.is_prescribed)});
  }

  static constexpr auto question = truncate_question;
  static constexpr auto judge = judge_truncate;
  static auto arrays(const Out& out) { return std::tie(out.position, out.cut); }

  template <class Answer>
  static std::vector<Quantity> outputs(const In&, const Answer& answer) {
    return {points("position", "m", std::array{answer.position.at(0)}), flag("cut", answer.cut.at(0))};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return truncate_forms(); }
};

}  // namespace

constinit const StageTraits stages::truncate = make_traits<Truncate>();

}  // namespace ogc::compare
