// Makes the traits of stage activation.
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
#include "compare/problem/names.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

CaseData activation_uniform(Random& random) {
  const float r = static_cast<float>(random.magnitude(-4, 1));
  return ActivationCase{up(static_cast<float>(random.unit() * 1.2 * r)), r,
                        static_cast<float>(random.magnitude(-1, 6))};
}

CaseData activation_bits(Random& random) {
  return ActivationCase{random.pattern(), random.pattern(), random.pattern()};
}

CaseData activation_lattice(Random& random) {
  const float d = std::ldexp(static_cast<float>(1 + random.below(64)), random.below(9) - 10);
  const float r = std::ldexp(static_cast<float>(1 + random.below(16)), random.below(5) - 6);
  return ActivationCase{d, r, static_cast<float>(1 + random.below(4))};
}

/// Approaches d = r, where the curvature jumps.
CaseData activation_radius(Random& random) {
  const float r = random.one_in(2) ? random.pattern() : 0.005f;
  return ActivationCase{beside(random, r), r, static_cast<float>(random.magnitude(-1, 6))};
}

/// Approaches d = τ = r/2, where the quadratic and the logarithmic piece of the activation meet.
CaseData activation_switch(Random& random) {
  const float r = random.one_in(2) ? random.pattern() : 0.005f;
  return ActivationCase{beside(random, r / 2), r, static_cast<float>(random.magnitude(-1, 6))};
}

/// Approaches d = 0, where the logarithm grows.
CaseData activation_touching(Random& random) {
  const float r = static_cast<float>(random.magnitude(-3, 0));
  return ActivationCase{static_cast<float>(r * std::pow(10.0, -1 - random.below(12))), r,
                        static_cast<float>(random.magnitude(-1, 6))};
}

ActivationCase with_any_activation(Random& random, const CaseData& data) {
  ActivationCase question = case_of<ActivationCase>(data);
  question.activation = random.pick(std::span<const ContactActivation>(choices<ContactActivation>));
  return question;
}

CaseData activation_variants(Random& random) { return with_any_activation(random, activation_uniform(random)); }

/// Makes cases with any activation. They approach d = r, d = τ = r/2 and d = 0, where activations change or terms
/// cancel.
CaseData activation_ladders(Random& random) {
  switch (random.below(8)) {
    case 0: return with_any_activation(random, activation_touching(random));
    case 1: return with_any_activation(random, activation_bits(random));
    case 2:
    case 3:
    case 4: return with_any_activation(random, activation_radius(random));
    default: return with_any_activation(random, activation_switch(random));
  }
}

constexpr std::array<Generator, 8> activation_table{{{"uniform", 20, true, activation_uniform},
                                                     {"bits", 20, false, activation_bits},
                                                     {"lattice", 20, false, activation_lattice},
                                                     {"ladder.radius", 50, false, activation_radius},
                                                     {"ladder.switch", 50, false, activation_switch},
                                                     {"ladder.touching", 10, false, activation_touching},
                                                     {"variants", 8, true, activation_variants},
                                                     {"ladder.variants", 40, false, activation_ladders}}};

/// Checks whether d is near r or near τ = r/2, where pieces of the activation meet.
bool near_join(double d, double r) { return std::min(std::abs(d - r), std::abs(d - r / 2)) <= near_factor * d; }

}  // namespace

void judge_activation(Cases cases, const ActivationIn& in, const ActivationTruth& truth, const ActivationOut& out,
                      Tally& tally) {
  tally.begin(cases[0].name);
  const std::size_t n = cases.size();
  if (out.energy.size() != n || out.slope.size() != n || out.curvature.size() != n) {
    tally.mismatch("an array of the answer does not have one entry for each case");
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    tally.begin(cases[i].name);
    tally.count(1, 1, 0, near_join(in.distance[i], in.contact_radius[i]));
    const auto one = [&](std::size_t metric, float value, double exact, double scale) {
      tally.error(metric, in_units(std::abs(value - exact), scale),
                  [&] { return text("%.9g, exact %.17g", value, exact); });
    };
    one(0, out.energy[i], truth.energy[i], truth.energy_scale[i]);
    one(1, out.slope[i], truth.slope[i], truth.slope_scale[i]);
    one(2, out.curvature[i], truth.curvature[i], truth.curvature_scale[i]);
  }
}

namespace {

/// Distances that programs use as absolute thresholds [m].
constexpr std::array<std::pair<const char*, float>, 7> gap_thresholds{{{"1e-2", 1e-2f},
                                                                       {"1e-3", 1e-3f},
                                                                       {"1e-4", 1e-4f},
                                                                       {"1e-5", 1e-5f},
                                                                       {"1e-6", 1e-6f},
                                                                       {"1e-7", 1e-7f},
                                                                       {"1e-8", 1e-8f}}};

/// Makes a form that changes the truth of each case by `change(in, i, truth)`.
template <class Change>
WrongForm activation_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::activation,
              [change](const ActivationIn& in, ActivationTruth& truth) {
                for (std::size_t i = 0; i < in.distance.size(); ++i) change(in, i, truth);
              });
}

template <class Change>
WrongForm activation_asked(std::string name, std::string meaning, Change change) {
  return asked(std::move(name), std::move(meaning), &Authority::activation, [change](ActivationIn& in) {
    for (std::size_t i = 0; i < in.distance.size(); ++i)
      change(in.distance[i], in.contact_radius[i], in.stiffness[i], in.activation[i]);
  });
}

bool is_logarithmic(const ActivationIn& in, std::size_t i) {
  return in.activation[i] == ContactActivation::ogc && 2 * double{in.distance[i]} < in.contact_radius[i];
}

/// Makes the form that multiplies k', the factor of the logarithmic piece (d < r/2). The energies of both pieces remain
/// equal at d = r/2.
WrongForm logarithm_times(float factor, std::string name, std::string meaning) {
  return form(std::move(name), std::move(meaning), &Authority::activation,
              [factor](const std::function<ActivationTruth(const ActivationIn&)>& right, const ActivationIn& in) {
                ActivationTruth truth = right(in);
                ActivationIn at_switch = in;
                for (std::size_t i = 0; i < in.distance.size(); ++i) at_switch.distance[i] = in.contact_radius[i] / 2;
                const std::vector<double> constant = right(at_switch).energy;
                for (std::size_t i = 0; i < in.distance.size(); ++i) {
                  if (!is_logarithmic(in, i)) continue;
                  truth.energy[i] = constant[i] + factor * (truth.energy[i] - constant[i]);
                  for (auto* values : {&truth.slope, &truth.slope_scale, &truth.curvature, &truth.curvature_scale})
                    (*values)[i] *= factor;
                  truth.energy_scale[i] *= std::max(1.0f, factor);
                }
                return truth;
              });
}

void add_variants(std::vector<WrongForm>& forms) {
  const auto everywhere = [&](std::string name, std::string meaning, ContactActivation kind) {
    forms.push_back(activation_asked(name + "_for_every_activation", meaning + ", whichever activation is asked for",
                                     [kind](float, float, float, ContactActivation& which) { which = kind; }));
  };
  everywhere("ogc", "Eq. 18 with Eq. 19 corrected", ContactActivation::ogc);
  for (const auto& [kind, name, meaning] : other_activations) {
    forms.push_back(activation_asked(name, std::string(meaning) + ", where `ogc` is asked for",
                                     [to = kind](float, float, float, ContactActivation& which) {
                                       if (which == ContactActivation::ogc) which = to;
                                     }));
    everywhere(name, meaning, kind);
  }
}

void add_thresholds(std::vector<WrongForm>& forms) {
  for (const auto& [text, epsilon] : gap_thresholds) {
    forms.push_back(activation_asked("distance_floor_" + std::string(text),
                                     "distances below an absolute epsilon of " + std::string(text) + " m count as it",
                                     [e = epsilon](float& d, float, float, ContactActivation) { d = std::max(d, e); }));
    forms.push_back(activation_told("dead_below_" + std::string(text),
                                    "nothing acts below an absolute epsilon of " + std::string(text) + " m",
                                    [e = epsilon](const ActivationIn& in, std::size_t i, ActivationTruth& truth) {
                                      if (in.distance[i] < e) truth.energy[i] = truth.slope[i] = truth.curvature[i] = 0;
                                    }));
  }
}

std::vector<WrongForm> activation_forms() {
  std::vector<WrongForm> forms{
      activation_asked("twice_as_stiff", "2 k_c for k_c: energy, slope and curvature doubled",
                       [](float, float, float& k, ContactActivation) { k *= 2; }),
      activation_asked("half_as_stiff", "k_c/2 for k_c: energy, slope and curvature halved",
                       [](float, float, float& k, ContactActivation) { k /= 2; }),
      logarithm_times(0.5f, "half_logarithm", "half of k' below τ = r/2: slope and curvature halve as d crosses τ"),
      logarithm_times(2, "twice_logarithm", "twice k' below τ = r/2: slope and curvature double as d crosses τ"),
      activation_asked("squared_distance", "d² and r² for d and r",
                       [](float& d, float& r, float, ContactActivation) { d *= d, r *= r; }),
      activation_asked("squared_distance_alone", "d² for d", [](float& d, float, float, ContactActivation) { d *= d; }),
      activation_told(
          "flipped_sign", "the slope with the other sign: the force in place of g'",
          [](const ActivationIn&, std::size_t i, ActivationTruth& truth) { truth.slope[i] = -truth.slope[i]; }),
      activation_told("curvature_counted_twice", "g'' doubled, g' right: a Hessian counted twice",
                      [](const ActivationIn&, std::size_t i, ActivationTruth& truth) {
                        truth.curvature[i] *= 2, truth.curvature_scale[i] *= 2;
                      }),
      activation_told("curvature_missing", "g'' is 0",
                      [](const ActivationIn&, std::size_t i, ActivationTruth& truth) { truth.curvature[i] = 0; }),
      activation_told("constant_missing", "the energy below τ without the constant of Eq. 20: −k' ln d",
                      [](const ActivationIn& in, std::size_t i, ActivationTruth& truth) {
                        if (is_logarithmic(in, i))
                          truth.energy[i] = truth.slope[i] * in.distance[i] * std::log(double{in.distance[i]});
                      }),
      activation_told("closed_at_radius", "contact acts at d = r, too: the curvature there is k_c",
                      [](const ActivationIn& in, std::size_t i, ActivationTruth& truth) {
                        if (in.distance[i] == in.contact_radius[i])
                          truth.curvature[i] = truth.curvature_scale[i] = in.stiffness[i];
                      })};
  add_variants(forms);
  add_thresholds(forms);
  return forms;
}

struct Activation : BatchStage<Activation, &Contestant::activation, &Authority::activation>,
                    TakenWhole,
                    ParametersOfCase<Activation>,
                    OfContacts {
  using Case = ActivationCase;
  static constexpr StageInfo info{.name = "activation",
                                  .question = "contact energy over distance, slope, curvature",
                                  .unit = "distance",
                                  .reference = "reference/energies/activation.cpp",
                                  .kind = CaseKind::single,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"energy", "u scale", activation_tolerance},
                                      MetricInfo{"slope", "u scale", activation_tolerance},
                                      MetricInfo{"curvature", "u scale", activation_tolerance}};
  static constexpr std::array parameters{
      ParameterInfo{"d", "distance [m]", std::numeric_limits<float>::min(), ranges::most}, ranges::contact_radius,
      ranges::contact_stiffness};
  static float* parameter(Case& c, std::string_view name) {
    return name == "d" ? &c.distance : name == "r" ? &c.contact_radius : &c.stiffness;
  }

  static std::span<const Generator> generators() { return activation_table; }

  static void check(const Case& c, FirstProblem& problem) {
    problem.number("a contact radius", c.contact_radius, least_length, most_length);
    problem.number("a distance", c.distance, std::min(least_length, 0x1p-40f * c.contact_radius), most_length);
    problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
  }
  static void mutate(Random& random, Case& c) {
    const std::array<float, 3> distances{c.distance, c.contact_radius, c.contact_radius / 2};
    c.distance = std::max(0x1p-20f, beside(random, random.pick(std::span<const float>(distances))));
  }
  static std::vector<float*> coordinates(Case&) { return {}; }
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.contact_distance(states.contact_frame(index), random);
  }

  static Json write(const Case& c) {
    return {{"distance", hexadecimal(c.distance)},
            {"contact_radius", hexadecimal(c.contact_radius)},
            {"stiffness", hexadecimal(c.stiffness)},
            {"activation", choice_names<ContactActivation>[static_cast<std::size_t>(c.activation)]}};
  }
  static Case read(const Json& data) {
    const auto name = data.at("activation").get<std::string>();
    const auto found = std::find(choice_names<ContactActivation>.begin(), choice_names<ContactActivation>.end(), name);
    if (found == choice_names<ContactActivation>.end())
      throw InputError(unknown_name("activation", name, choice_names<ContactActivation>));
    return {number(data.at("distance")), number(data.at("contact_radius")), number(data.at("stiffness")),
            static_cast<ContactActivation>(found - choice_names<ContactActivation>.begin())};
  }

  static Shape shape(const Case&) { return {}; }
  static std::vector<Quantity> inputs(const Case& c) {
    return {scalar("distance", "m", c.distance), scalar("contact_radius", "m", c.contact_radius),
            scalar("stiffness", "N/m", c.stiffness),
            word("activation", std::string(choice_names<ContactActivation>[static_cast<std::size_t>(c.activation)]))};
  }

  static In question(Cases cases) {
    In in;
    for (const TestCase& test : cases) {
      const auto& c = case_of<Case>(test.data);
      in.distance.push_back(c.distance);
      in.contact_radius.push_back(c.contact_radius);
      in.stiffness.push_back(c.stiffness);
      in.activation.push_back(c.activation);
    }
    return in;
  }
  static constexpr auto judge = judge_activation;
  static auto arrays(const Out& out) { return std::tie(out.energy, out.slope, out.curvature); }

  template <class Answer>
  static std::vector<Quantity> outputs(const In&, const Answer& answer) {
    return {scalar("energy", "J", answer.energy.at(0)), scalar("slope", "N", answer.slope.at(0)),
            scalar("curvature", "N/m", answer.curvature.at(0))};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence>) { return activation_forms(); }
};

}  // namespace

constinit const StageTraits stages::activation = make_traits<Activation>();

}  // namespace ogc::compare
