// How far a quaternion is from what the stage orientation accepts: for that stage, and for sweeps that set many.
#pragma once

#include <vector>

#include "compare/stages/orientation.hpp"

namespace ogc::compare {

/// Errors of one answer against one minimiser, each in its unit (compare/stages/orientation.hpp).
struct OrientationErrors {
  double orientation = 0, residual = 0, energy = 0;
  /// The largest of them over its tolerance, to each of which `more` units are added; 1: just accepted.
  double share(double more = 0) const;
};

/// Of a stored quaternion.
OrientationErrors orientation_errors(const Quaternion& stored, const OrientationAnswer& exact);

/// The answer that the quaternion is nearest to.
const OrientationAnswer& nearest_answer(const Quaternion& stored, const std::vector<OrientationAnswer>& accepted);

/// | ‖q‖ − 1 | in units of u.
double length_error(const Quaternion& q);

/// Whether every number of it is finite.
bool is_finite(const Quaternion& q);

}  // namespace ogc::compare
