// Stage truncate: Eq. 27.
#pragma once

#include "compare/stages/truncate.hpp"

namespace ogc::reference {

/// Cut exactly where ‖x − x_prev‖ > b_v or a half-space is violated. Without half-spaces a cut position is x_prev +
/// (x − x_prev) b_v / ‖x − x_prev‖; with them as TruncateOut says.
compare::TruncateTruth truncate(const compare::TruncateIn& in);

/// The nearest single-precision position, stepped towards X_prev until it obeys the bound.
compare::Vec3f stored_within(const compare::Vec3& position, const compare::Vec3f& previous, float bound);

/// The same in the region of case i: stepped back from half-spaces, too. Where that does not help, where the vertex is.
compare::Vec3f stored_in_region(const compare::Vec3& position, const compare::TruncateIn& in, std::size_t i);

}  // namespace ogc::reference
