// Forms of activation, bound, truncate and initial_guess.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/explain/form_tools.hpp"
#include "compare/judge/questions.hpp"
#include "compare/judge/units.hpp"

namespace ogc::compare {

namespace {

/// Thresholds that people write: 1e-2 … 1e-8, in metres.
constexpr std::array<std::pair<const char*, float>, 7> thresholds{{{"1e-2", 1e-2f},
                                                                   {"1e-3", 1e-3f},
                                                                   {"1e-4", 1e-4f},
                                                                   {"1e-5", 1e-5f},
                                                                   {"1e-6", 1e-6f},
                                                                   {"1e-7", 1e-7f},
                                                                   {"1e-8", 1e-8f}}};

/// The truth about each case is changed: `change(in, i, truth)`.
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

/// k' of the logarithmic stage multiplied; energies stay equal at τ.
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
  for (const auto& [text, epsilon] : thresholds) {
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

}  // namespace

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

namespace {

/// One of the three minima is not read.
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

}  // namespace

std::vector<WrongForm> bound_forms() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {
      unread("vertex_minima_missing", "the vertex's own distance, d_min_vertex, is not read", &BoundIn::d_min_vertex),
      unread("edge_minima_missing", "distances of the vertex's edges are not read", &BoundIn::d_min_edge),
      unread("triangle_minima_missing", "distances of the vertex's triangles are not read", &BoundIn::d_min_triangle),
      asked("relaxation_missing", "γ_p left out: the smallest distance itself", &Authority::bound,
            [](BoundIn& in) { in.bound_relaxation = 1; }),
      bound_told("half", "half of the bound", [](float b) { return b / 2; }),
      bound_told("twice", "twice the bound", [](float b) { return 2 * b; }),
      bound_told("rounded_to_nearest",
                 "the product rounded to nearest, not down: above the exact bound by the last bit",
                 [](float b) { return std::nextafter(b, infinity); })};
}

namespace {

/// Whether the stored position lies where the truth does, by the distance alone: the bound, which the judge checks
/// exactly, may be missed by a rounding.
bool lies_there(const Vec3f& stored, const Vec3& exact, const Vec3f& previous, double bound) {
  const double error = std::hypot(stored.x - exact.x, stored.y - exact.y, stored.z - exact.z);
  const double size = std::max({std::abs(previous.x), std::abs(previous.y), std::abs(previous.z)});
  return in_units(error, size + bound) <= truncate_position_tolerance;
}

/// `position(in, truth)`: where the form says that the vertex is stored; the flag is the truth's.
template <class Place>
WrongForm stored_at(std::string name, std::string meaning, Place place) {
  return {std::move(name), std::move(meaning), [place](const Evidence& evidence, const Authority& authority) {
            const TruncateIn in = truncate_question({&evidence.test, 1});
            const TruncateOut out = evidence.answered.truncate(in);
            const TruncateTruth truth = authority.truncate(in);
            if (out.position.size() != 1 || out.exceeded.size() != 1) return false;
            if (out.exceeded[0] != truth.exceeded[0] && !truth.grey[0]) return false;
            const Vec3 where = truth.exceeded[0]
                                   ? place(in.previous[0], in.position[0], double{in.bound[0]}, truth.position[0])
                                   : truth.position[0];
            return lies_there(out.position[0], where, in.previous[0], in.bound[0]);
          }};
}

Vec3 wide(const Vec3f& p) { return {p.x, p.y, p.z}; }

}  // namespace

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
      {"flag_inverted", "`exceeded` says the opposite", [](const Evidence& evidence, const Authority& authority) {
         const TruncateIn in = truncate_question({&evidence.test, 1});
         const TruncateOut out = evidence.answered.truncate(in);
         Evidence flipped = evidence;
         flipped.answered.truncate = [out](const TruncateIn&) {
           TruncateOut other = out;
           for (std::uint8_t& flag : other.exceeded) flag = !flag;
           return other;
         };
         return agrees(flipped, authority);
       }}};
}

namespace {

template <class Change>
WrongForm guess_asked(std::string name, std::string meaning, Change change) {
  return asked(std::move(name), std::move(meaning), &Authority::initial_guess, [change](InitialGuessIn& in) {
    for (InitialGuessCase& c : in.cases) change(c);
  });
}

Vec3f times(const Vec3f& v, float factor) { return {factor * v.x, factor * v.y, factor * v.z}; }

/// The case as if it were not held.
bool is_not_held(const Evidence& evidence, const Authority& authority) {
  Evidence free = evidence;
  std::get<InitialGuessCase>(free.test.data).held = 0;
  return agrees(free, authority);
}

}  // namespace

std::vector<WrongForm> initial_guess_forms() {
  return {
      guess_asked("acceleration_missing", "y without h² a_ext", [](InitialGuessCase& c) { c.acceleration = {}; }),
      guess_asked("half_acceleration", "h²/2 a_ext for h² a_ext",
                  [](InitialGuessCase& c) { c.acceleration = times(c.acceleration, 0.5f); }),
      guess_asked("acceleration_flipped", "a_ext with the other sign",
                  [](InitialGuessCase& c) { c.acceleration = times(c.acceleration, -1); }),
      guess_asked("velocity_missing", "y without h vᵗ", [](InitialGuessCase& c) { c.velocity = {}; }),
      guess_asked("from_previous", "y from X_prev in place of xᵗ", [](InitialGuessCase& c) { c.start = c.previous; }),
      {"held_ignored", "vertices that are held move like all others", is_not_held}};
}

}  // namespace ogc::compare
