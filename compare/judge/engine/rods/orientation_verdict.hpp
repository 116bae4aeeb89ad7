// Measures how far a quaternion is from the answers that stage orientation accepts, for this stage and for sweeps.
#pragma once

#include <vector>

#include "compare/stages/orientation.hpp"

namespace ogc::compare {

/// Errors of an answer relative to one minimiser, each in its unit (compare/stages/orientation.hpp).
struct OrientationErrors {
  double orientation = 0, residual = 0, energy = 0;
  /// Returns the largest error / (tolerance + `more`) of the three errors. Values up to 1 are accepted.
  double share(double more = 0) const;
};

/// Returns the errors of a stored quaternion.
OrientationErrors orientation_errors(const Quaternion& stored, const OrientationAnswer& exact);

/// Returns the accepted answer that is nearest to the quaternion.
const OrientationAnswer& nearest_answer(const Quaternion& stored, const std::vector<OrientationAnswer>& accepted);

/// Returns | ‖q‖ − 1 | in units of 2⁻²⁴, the unit roundoff.
double length_error(const Quaternion& q);

/// Checks whether all numbers of the quaternion are finite.
bool is_finite(const Quaternion& q);

}  // namespace ogc::compare
