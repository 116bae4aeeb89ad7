#include "reference/solvers/initial_guess.hpp"

#include <algorithm>
#include <cmath>

namespace ogc::reference {
namespace {

/// Where one coordinate goes, and the sum of the moduli of the terms.
struct Coordinate {
  long double target, scale;
};

Coordinate coordinate(long double x, long double v, long double a, long double h) {
  const long double flown = h * v, accelerated = h * h * a;
  return {x + flown + accelerated, std::abs(x) + std::abs(flown) + std::abs(accelerated)};
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
  return truth;
}

}  // namespace ogc::reference
