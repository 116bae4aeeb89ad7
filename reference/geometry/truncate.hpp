// Stage truncate: Eq. 27.
#pragma once

#include "compare/stages/truncate.hpp"

namespace ogc::reference {

/// Cut exactly where ‖x − x_prev‖ > b_v or a half-space is violated. Without half-spaces a cut position is x_prev +
/// (x − x_prev) b_v / ‖x − x_prev‖; with them that of truncate_region.
compare::TruncateTruth truncate(const compare::TruncateIn& in);

/// The nearest single-precision position, stepped towards X_prev until it obeys the bound.
compare::Vec3f stored_within(const compare::Vec3& position, const compare::Vec3f& previous, float bound);

}  // namespace ogc::reference
