// Makes the traits of stage barrier. With D = squared distance, ξ = thickness, d̂ = activation distance, g = D − ξ² and
// H = d̂ (d̂ + 2ξ), ladders approach
// - g = H, above which energy, slope and curvature are 0,
// - g = 0, where the logarithm grows,
// - thicknesses ξ far above d̂.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/cases/placement.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

double support_of(const BarrierCase& c) {
  return double{c.activation_distance} * (double{c.activation_distance} + 2 * double{c.thickness});
}
double gap_of(const BarrierCase& c) { return double{c.squared_distance} - double{c.thickness} * c.thickness; }

bool tells_gap(const BarrierCase& c) {
  return gap_of(c) >= 0x1p-40 * support_of(c) && gap_of(c) >= 0x1p-18 * c.squared_distance;
}

/// Returns the case with legal lengths; raises the squared distance D to its least legal value.
BarrierCase legal(BarrierCase c) {
  c.activation_distance = std::clamp(c.activation_distance, ranges::least, ranges::most);
  if (c.thickness != 0)
    c.thickness = std::clamp(c.thickness, ranges::least, std::min(ranges::most, 0x1p10f * c.activation_distance));
  const double square = double{c.thickness} * c.thickness;
  const double least = std::max(square + 0x1p-40 * support_of(c), square * (1 + 0x1p-17));
  if (!(c.squared_distance >= least)) c.squared_distance = static_cast<float>(least * (1 + 0x1p-22));
  c.squared_distance = std::min(c.squared_distance, 0x1p42f);
  return c;
}

/// Returns a case with D − ξ² = `share` · H, where support_of returns H.
BarrierCase at_share(double share, float distance, float thickness) {
  BarrierCase c{0, distance, thickness};
  c = legal(c);
  c.squared_distance = static_cast<float>(double{c.thickness} * c.thickness + share * support_of(c));
  return legal(c);
}

float some_distance(Random& random) { return static_cast<float>(random.magnitude(-4, 1)); }
float some_thickness(Random& random, float distance) {
  return random.one_in(2) ? 0 : static_cast<float>(distance * random.magnitude(-2, 1));
}

CaseData uniform(Random& random) {
  const float distance = some_distance(random);
  return at_share(random.between(0, 1.2), distance, some_thickness(random, distance));
}

CaseData bits(Random& random) {
  const float distance = random.pattern(), thickness = random.one_in(2) ? 0 : random.pattern();
  const float other = random.pattern();
  return legal({random.one_in(2) ? other * other : other, distance, thickness});
}

CaseData lattice(Random& random) {
  const auto whole = [&](int most) { return static_cast<float>(1 + random.below(most)); };
  const float distance = whole(8) / 8, thickness = random.one_in(2) ? 0 : whole(8) / 8;
  return legal({whole(256) / 64, distance, thickness});
}

/// Approaches g = H.
CaseData support(Random& random) {
  const float distance = some_distance(random);
  BarrierCase c = at_share(1, distance, some_thickness(random, distance));
  c.squared_distance = random.one_in(2) ? beside(random, c.squared_distance)
                                        : static_cast<float>(c.squared_distance * (1 - std::abs(random.rung())));
  return legal(c);
}

/// Approaches g = 0.
CaseData touching(Random& random) {
  const float distance = some_distance(random);
  return at_share(std::pow(10.0, -1 - random.below(12)), distance, some_thickness(random, distance));
}

/// Makes cases with ξ ≫ d̂, in which D differs little from ξ².
CaseData thick(Random& random) {
  const float distance = some_distance(random);
  return at_share(random.between(0, 1.2), distance, static_cast<float>(distance * random.magnitude(1, 3)));
}

constexpr std::array<Generator, 6> barrier_table{{{"uniform", 20, true, uniform},
                                                  {"bits", 20, false, bits},
                                                  {"lattice", 20, false, lattice},
                                                  {"ladder.support", 60, false, support},
                                                  {"ladder.touching", 15, false, touching},
                                                  {"ladder.thickness", 20, false, thick}}};

template <class Change>
WrongForm told_case(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::barrier,
              [change](const BarrierIn& in, BarrierTruth& truth) {
                for (std::size_t i = 0; i < in.cases.size(); ++i)
                  if (gap_of(in.cases[i]) < support_of(in.cases[i])) change(in.cases[i], i, truth);
              });
}

template <class Change>
WrongForm asked_case(std::string name, std::string meaning, Change change) {
  return asked(std::move(name), std::move(meaning), &Authority::barrier, [change](BarrierIn& in) {
    for (BarrierCase& c : in.cases) {
      change(c);
      c = legal(c);
    }
  });
}

std::vector<WrongForm> barrier_forms() {
  return {told_case("flipped_sign", "the slope with the other sign: the force in place of db/dD",
                    [](const BarrierCase&, std::size_t i, BarrierTruth& truth) { truth.slope[i] = -truth.slope[i]; }),
          told_case("curvature_without_last_term", "d²b/dD² without (g − H)²/g²",
                    [](const BarrierCase& c, std::size_t i, BarrierTruth& truth) {
                      const double ratio = (support_of(c) - gap_of(c)) / gap_of(c);
                      truth.curvature[i] -= ratio * ratio;
                    }),
          told_case("slope_without_last_term", "db/dD without −(g − H)²/g",
                    [](const BarrierCase& c, std::size_t i, BarrierTruth& truth) {
                      const double depth = support_of(c) - gap_of(c);
                      truth.slope[i] += depth * depth / gap_of(c);
                    }),
          told_case("by_the_distance", "the slope by the distance, 2 d db/dD",
                    [](const BarrierCase& c, std::size_t i, BarrierTruth& truth) {
                      truth.slope[i] *= 2 * std::sqrt(double{c.squared_distance});
                    }),
          asked_case("thickness_ignored", "ξ = 0", [](BarrierCase& c) { c.thickness = 0; }),
          asked_case("support_without_thickness", "d̂² for the support, with a thickness, too",
                     [](BarrierCase& c) {
                       const float squared = c.thickness * c.thickness;
                       if (c.squared_distance > squared) c.squared_distance -= squared;
                       c.thickness = 0;
                     }),
          asked_case("distance_for_its_square", "d where D = d² is asked for",
                     [](BarrierCase& c) { c.squared_distance = std::sqrt(c.squared_distance); })};
}

struct Barrier : BatchStage<Barrier, &Contestant::barrier, &Authority::barrier>,
                 TakenWhole,
                 ParametersOfCase<Barrier>,
                 OfContacts {
  using Case = BarrierCase;
  static constexpr StageInfo info{.name = "barrier",
                                  .question = "IPC's barrier over the squared distance, slope, curvature",
                                  .unit = "distance",
                                  .reference = "reference/ipc/barrier.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = false,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"energy", "u scale", barrier_tolerance},
                                      MetricInfo{"slope", "u scale", barrier_tolerance},
                                      MetricInfo{"curvature", "u scale", barrier_tolerance}};
  static constexpr std::array parameters{ParameterInfo{"D", "squared distance [m²]", 0x1p-80f, 0x1p42f},
                                         ParameterInfo{"d_hat", "activation distance [m]", ranges::least, ranges::most},
                                         ParameterInfo{"xi", "thickness [m]", 0, ranges::most}};
  static float* parameter(Case& c, std::string_view name) {
    return name == "D" ? &c.squared_distance : name == "d_hat" ? &c.activation_distance : &c.thickness;
  }
  static std::string set(Case& c, std::span<const Override> values) {
    for (const Override& value : values) *parameter(c, value.name) = value.value;
    const bool is_thick = c.thickness == 0 ||
                          (c.thickness >= ranges::least && c.thickness <= 0x1p10f * c.activation_distance);
    return is_thick && tells_gap(c) ? "" : "D, d_hat and xi together leave no gap that the contract knows";
  }

  static std::span<const Generator> generators() { return barrier_table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.number("an activation distance", c.activation_distance, ranges::least, ranges::most);
    if (c.thickness != 0)
      problem.number("a thickness", c.thickness, ranges::least,
                     std::min(ranges::most, 0x1p10f * c.activation_distance));
    problem.number("a squared distance", c.squared_distance, 0, 0x1p42f);
    problem.require(tells_gap(c), "the squared distance leaves no gap that single precision tells from none");
  }
  static void mutate(Random& random, Case& c) {
    c.squared_distance = beside(random, random.one_in(2)
                                            ? c.squared_distance
                                            : static_cast<float>(support_of(c) + double{c.thickness} * c.thickness));
    c = legal(c);
  }
  static std::vector<float*> coordinates(Case&) { return {}; }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    const ActivationCase contact = states.contact_distance(states.contact_frame(index), random);
    return legal({contact.distance * contact.distance, contact.contact_radius, 0});
  }

  static Json write(const Case& c) {
    return {{"squared_distance", hexadecimal(c.squared_distance)},
            {"activation_distance", hexadecimal(c.activation_distance)},
            {"thickness", hexadecimal(c.thickness)}};
  }
  static Case read(const Json& data) {
    return {number(data.at("squared_distance")), number(data.at("activation_distance")), number(data.at("thickness"))};
  }

  static Shape shape(const Case&) { return {}; }
  static std::vector<Quantity> inputs(const Case& c) {
    return {scalar("squared_distance", "m²", c.squared_distance),
            scalar("activation_distance", "m", c.activation_distance), scalar("thickness", "m", c.thickness)};
  }

  static In question(Cases cases) { return case_question(cases, &In::cases); }
  static void judge(Cases cases, const In&, const Truth& truth, const Out& out, Tally& tally);
  static auto arrays(const Out& out) { return std::tie(out.energy, out.slope, out.curvature); }

  template <class Answer>
  static std::vector<Quantity> outputs(const In&, const Answer& answer) {
    return {scalar("energy", "m⁴", answer.energy.at(0)), scalar("slope", "m²", answer.slope.at(0)),
            scalar("curvature", "1", answer.curvature.at(0))};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return barrier_forms(); }
};

void Barrier::judge(Cases cases, const In&, const Truth& truth, const Out& out, Tally& tally) {
  tally.begin(cases[0].name);
  const std::size_t n = cases.size();
  if (out.energy.size() != n || out.slope.size() != n || out.curvature.size() != n) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, 0);
    const auto one = [&](std::size_t metric, float value, double exact, double scale) {
      tally.error(metric, in_units(std::abs(value - exact), scale),
                  [&] { return text("%.9g, exact %.17g", value, exact); });
    };
    one(0, out.energy[i], truth.energy[i], truth.energy_scale[i]);
    one(1, out.slope[i], truth.slope[i], truth.slope_scale[i]);
    one(2, out.curvature[i], truth.curvature[i], truth.curvature_scale[i]);
  }
}

}  // namespace

constinit const StageTraits stages::barrier = make_traits<Barrier>();

}  // namespace ogc::compare
