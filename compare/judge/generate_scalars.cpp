// Cases of activation and truncate.
#include <array>
#include <cmath>

#include "compare/judge/generators.hpp"
#include "compare/judge/placement.hpp"

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

/// d → r, where the curvature jumps.
CaseData activation_radius(Random& random) {
  const float r = random.one_in(2) ? random.pattern() : 0.005f;
  return ActivationCase{beside(random, r), r, static_cast<float>(random.magnitude(-1, 6))};
}

/// d → τ = r/2, where the stages join.
CaseData activation_switch(Random& random) {
  const float r = random.one_in(2) ? random.pattern() : 0.005f;
  return ActivationCase{beside(random, r / 2), r, static_cast<float>(random.magnitude(-1, 6))};
}

/// d → 0, where the logarithm grows.
CaseData activation_touching(Random& random) {
  const float r = static_cast<float>(random.magnitude(-3, 0));
  return ActivationCase{static_cast<float>(r * std::pow(10.0, -1 - random.below(12))), r,
                        static_cast<float>(random.magnitude(-1, 6))};
}

ActivationCase with_any_activation(Random& random, const CaseData& data) {
  ActivationCase question = std::get<ActivationCase>(data);
  question.activation = static_cast<ContactActivation>(random.below(static_cast<int>(activation_names().size())));
  return question;
}

CaseData activation_variants(Random& random) { return with_any_activation(random, activation_uniform(random)); }

/// Where the variants change over or cancel: r, τ (where a logarithm may, too), 0.
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
  const TruncateCase c = std::get<TruncateCase>(
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

constexpr std::array<Generator, 8> activation_table{{{"uniform", 20, true, activation_uniform},
                                                     {"bits", 20, false, activation_bits},
                                                     {"lattice", 20, false, activation_lattice},
                                                     {"ladder.radius", 50, false, activation_radius},
                                                     {"ladder.switch", 50, false, activation_switch},
                                                     {"ladder.touching", 10, false, activation_touching},
                                                     {"variants", 8, true, activation_variants},
                                                     {"ladder.variants", 40, false, activation_ladders}}};
constexpr std::array<Generator, 7> truncate_table{{{"uniform", 20, true, truncate_uniform},
                                                   {"bits", 20, false, truncate_bits},
                                                   {"dust", 8, false, truncate_uniform},
                                                   {"lattice", 20, false, truncate_lattice},
                                                   {"ladder.bound", 60, false, truncate_bound},
                                                   {"ladder.far", 10, false, truncate_far},
                                                   {"ladder.zero", 10, false, truncate_zero}}};

}  // namespace

std::span<const Generator> activation_generators() { return activation_table; }
std::span<const Generator> truncate_generators() { return truncate_table; }

}  // namespace ogc::compare
