#pragma once

#include "compare/stages/rod.hpp"

namespace ogc::reference {

struct RestBuilder;

/// Returns the answer to one case.
compare::ForceAnswer rod(const compare::RodCase& question);

/// Stage rod: computes all cases.
compare::ForceTruth rod(const compare::RodIn& in);

/// Adds the rest data of segments (solvers/kinds/rest_state.cpp).
void add_segments_at_rest(RestBuilder& to);

}  // namespace ogc::reference
