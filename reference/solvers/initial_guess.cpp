#include "reference/solvers/initial_guess.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/solvers/rods/rod_system.hpp"

namespace ogc::reference {
namespace {

/// The target of one coordinate, and the sum of the moduli of its terms.
struct Coordinate {
  long double target, scale;
};

Coordinate coordinate(long double x, long double v, long double a, long double h) {
  const long double flown = h * v, accelerated = h * h * a;
  return {x + flown + accelerated, std::abs(x) + std::abs(flown) + std::abs(accelerated)};
}

/// Adds the truth about one rotation, computed in double. Its error of 2⁻⁵² is divided by the cosine of half the angle.
/// This is precise enough, because every answer is accepted if the cosine is below 3 · 2⁻²⁰.
void add_turn(const compare::TurnCase& c, compare::InitialGuessTruth& truth) {
  const Triple<double> from{c.before.x, c.before.y, c.before.z}, to{c.now.x, c.now.y, c.now.z};
  FourOf<double> q{c.orientation[0], c.orientation[1], c.orientation[2], c.orientation[3]};
  const double a = std::hypot(from[0], from[1], from[2]), b = std::hypot(to[0], to[1], to[2]);
  double scale = 1;
  if (a > 0 && b > 0) {
    const Triple<double> middle = (1 / a) * from + (1 / b) * to;
    scale = 2 / std::hypot(middle[0], middle[1], middle[2]);
    q = turned_along(from, to, q);
  }
  const bool is_open = !(scale * compare::initial_guess_turn_tolerance * compare::unit_roundoff <= 0.5);
  truth.orientation.push_back(q);
  truth.orientation_scale.push_back(is_open ? std::numeric_limits<double>::infinity() : scale);
}

}  // namespace

compare::InitialGuessTruth initial_guess(const compare::InitialGuessIn& in) {
  compare::InitialGuessTruth truth;
  for (const compare::InitialGuessCase& c : in.cases) {
    const Coordinate x = coordinate(c.start.x, c.velocity.x, c.acceleration.x, c.time_step);
    const Coordinate y = coordinate(c.start.y, c.velocity.y, c.acceleration.y, c.time_step);
    const Coordinate z = coordinate(c.start.z, c.velocity.z, c.acceleration.z, c.time_step);
    truth.target.push_back(
        {static_cast<double>(x.target), static_cast<double>(y.target), static_cast<double>(z.target)});
    truth.target_scale.push_back(static_cast<double>(std::max({x.scale, y.scale, z.scale})));
  }
  for (const compare::TurnCase& c : in.turns) add_turn(c, truth);
  return truth;
}

}  // namespace ogc::reference
