// Cases of initial_guess. Where a bound is to be just reached or just missed, it is set from y in double, which is
// within a few u of every answer's own y.
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/generators.hpp"
#include "compare/judge/placement.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

Vec3 wide(const Vec3f& a) { return {a.x, a.y, a.z}; }
double length(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// ‖y − x_prev‖ [m].
double move_of(const InitialGuessCase& c) {
  const double h = c.time_step;
  const Vec3 y = sum(wide(c.start), sum(scaled(wide(c.velocity), h), scaled(wide(c.acceleration), h * h)));
  return length(sum(y, scaled(wide(c.previous), -1)));
}

/// A vertex of a scene of everyday size: cloth at up to `speed` m/s.
InitialGuessCase falling(Random& random, double speed) {
  InitialGuessCase c;
  c.start = single(in_box(random, -1, 1));
  c.velocity = single(scaled(in_box(random, -1, 1), speed));
  c.acceleration = random.one_in(4) ? single(scaled(in_box(random, -1, 1), 20)) : Vec3f{0, -9.81f, 0};
  c.time_step = static_cast<float>(random.magnitude(-4, -1));
  // Of a later round: the vertex has gone a part of its way.
  const double part = random.one_in(2) ? 0 : random.unit();
  c.previous = single(sum(wide(c.start), scaled(wide(c.velocity), part * c.time_step)));
  c.held = random.one_in(6);
  return c;
}

float times(double length, double factor) { return static_cast<float>(length * factor); }

CaseData uniform(Random& random) {
  InitialGuessCase c = falling(random, 5);
  c.bound = times(move_of(c), random.between(0.05, 2));
  return c;
}

CaseData bits(Random& random) {
  const auto vector = [&] {
    return Vec3f{static_cast<float>(random.sign()) * random.pattern(),
                 static_cast<float>(random.sign()) * random.pattern(),
                 static_cast<float>(random.sign()) * random.pattern()};
  };
  InitialGuessCase c{
      vector(), vector(), vector(), 0, vector(), random.pattern(), static_cast<std::uint8_t>(random.one_in(6))};
  c.time_step = static_cast<float>(std::ldexp(random.between(0.5, 1), -random.below(20)));
  return c;
}

/// Without a rounding: powers of two and small integers, moves of rational length.
CaseData lattice(Random& random) {
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
  c.held = random.one_in(8);
  return c;
}

/// ‖y − x_prev‖ → b_v.
CaseData bound(Random& random) {
  InitialGuessCase c = falling(random, random.magnitude(-2, 2));
  c.bound = times(move_of(c), 1 + random.rung());
  return c;
}

/// Likewise, on the lower rungs.
CaseData boundary(Random& random) {
  random.be_fine();
  return bound(random);
}

/// Fast movers with small bounds: 10² … 10⁶ bounds a step.
CaseData fast(Random& random) {
  InitialGuessCase c = falling(random, random.magnitude(0, 5));
  c.bound = times(move_of(c), random.magnitude(-6, -2));
  return c;
}

/// Far from the origin: the move tends to the spacing of the coordinates.
CaseData far(Random& random) {
  InitialGuessCase c = falling(random, random.magnitude(-3, 0));
  const Vec3 shift = scaled(in_box(random, -1, 1), random.magnitude(0, 6));
  c.start = single(sum(wide(c.start), shift));
  c.previous = single(sum(wide(c.previous), shift));
  c.bound = times(move_of(c), random.magnitude(-1, 0.5));
  return c;
}

/// At rest or almost: no velocity, no acceleration, no bound, or a rung of one.
CaseData still(Random& random) {
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

constexpr std::array<Generator, 9> table{{{"uniform", 25, true, uniform},
                                          {"bits", 15, false, bits},
                                          {"dust", 8, false, uniform},
                                          {"lattice", 20, false, lattice},
                                          {"ladder.bound", 15, false, bound},
                                          {"ladder.fast", 10, false, fast},
                                          {"ladder.far", 10, false, far},
                                          {"ladder.still", 5, false, still},
                                          {"ladder.boundary", 190, false, boundary}}};

}  // namespace

std::span<const Generator> initial_guess_generators() { return table; }

}  // namespace ogc::compare
