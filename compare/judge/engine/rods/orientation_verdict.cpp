#include "compare/judge/engine/rods/orientation_verdict.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/cases/rods/quaternions.hpp"
#include "compare/judge/engine/units.hpp"

namespace ogc::compare {

namespace {

using namespace rod_cases;

double inner(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

}  // namespace

double OrientationErrors::share(double more) const {
  return std::max({orientation / (orientation_tolerance + more), residual / (orientation_residual_tolerance + more),
                   energy / (orientation_energy_tolerance + more)});
}

OrientationErrors orientation_errors(const Quaternion& stored, const OrientationAnswer& exact) {
  Four q = wide(stored), apart, pull = exact.vector;
  for (std::size_t k = 0; k < 4; ++k) apart[k] = q[k] - exact.orientation[k];
  const double length = std::sqrt(inner(q, q));
  for (double& x : q) x /= length;
  double quadratic = 0;
  for (std::size_t row = 0; row < 4; ++row) {
    const double turned = inner(exact.matrix[row], q);
    pull[row] += turned;
    quadratic += 0.5 * q[row] * turned;
  }
  const double multiplier = inner(pull, q), energy = -quadratic - inner(exact.vector, q);
  for (std::size_t k = 0; k < 4; ++k) pull[k] -= multiplier * q[k];
  const double off = std::sqrt(inner(apart, apart));
  return {std::isinf(exact.scale) ? 0 : in_units(off, exact.scale),
          in_units(std::sqrt(inner(pull, pull)), exact.energy_scale),
          in_units(std::max(0.0, energy - exact.energy), exact.energy_scale)};
}

const OrientationAnswer& nearest_answer(const Quaternion& stored, const std::vector<OrientationAnswer>& accepted) {
  return *std::ranges::min_element(accepted, {},
                                   [&](const OrientationAnswer& a) { return orientation_errors(stored, a).share(); });
}

double length_error(const Quaternion& q) {
  const Four length = wide(q);
  return in_units(std::abs(std::sqrt(inner(length, length)) - 1), 1);
}

bool is_finite(const Quaternion& q) {
  return std::ranges::all_of(q, [](float x) { return std::isfinite(x); });
}

}  // namespace ogc::compare
