// Stage truncate where half-spaces hold a vertex beside its ball (method.md §5.6).
#pragma once

#include "compare/stages/truncate.hpp"
#include "reference/geometry/margin.hpp"

namespace ogc::reference {

/// As TruncateTruth of one case.
struct RegionTruth {
  bool cut = false, grey = false, near = false;
  compare::Vec3 position;
  double accepted = 0;  ///< [m]
};

/// Of case i, which has half-spaces; `ball`: d² − b² of its proposal and X_prev.
RegionTruth truncate_region(const compare::TruncateIn& in, std::size_t i, const MarginAnswer& ball);

}  // namespace ogc::reference
