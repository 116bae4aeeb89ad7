// The reference as the judge's authority: exact where the answer is discrete, correctly bounded where it is not.
#pragma once

#include "compare/problem/contestant.hpp"
#include "reference/geometry/block_margins.hpp"
#include "reference/geometry/filter_counts.hpp"
#include "reference/geometry/gauss_map.hpp"
#include "reference/geometry/illustrations.hpp"
#include "reference/geometry/nearest.hpp"

namespace ogc::reference {

/// Every stage that the reference has.
compare::Authority authority();

/// Newton-OGC: no stages, but a simulation to `start` (method.md §7).
compare::Contestant newton();

}  // namespace ogc::reference
