// Stage truncate: Eq. 27.
#pragma once

#include "compare/stages/truncate.hpp"

namespace ogc::reference {

/// Decides exactly which positions are cut: ‖x − x_prev‖ > b_v, or x is outside a half-space. Without half-spaces, a
/// cut position becomes x_prev + (x − x_prev) b_v / ‖x − x_prev‖; with half-spaces, TruncateOut defines the result.
compare::TruncateTruth truncate(const compare::TruncateIn& in);

/// Rounds a position to single precision, then moves it towards X_prev until it obeys the bound.
compare::Vec3f stored_within(const compare::Vec3& position, const compare::Vec3f& previous, float bound);

/// Rounds a position to single precision. Then moves it back until it keeps the bound and the half-spaces of case i. If
/// that fails, returns the vertex's current position.
compare::Vec3f stored_in_region(const compare::Vec3& position, const compare::TruncateIn& in, std::size_t i);

}  // namespace ogc::reference
