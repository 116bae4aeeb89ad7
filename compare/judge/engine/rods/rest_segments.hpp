// Judges the segments of rods for stage rest_state.
#pragma once

#include <functional>
#include <string>

#include "compare/judge/cases/random.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

/// Compares segments. Calls `error(what, segment, off, scale, value, exact)` for each number, and `wrong(what,
/// segment)` where a vertex, a body or a neighbour is not the right one.
struct SegmentVerdict {
  std::function<void(const char*, std::size_t, double, double, double, double)> error;
  std::function<void(const char*, std::size_t)> wrong;

  /// Compares both sides, which must have the same number of segments.
  void judge(const RestStateTruth& truth, const RestStateOut& out) const;
};

}  // namespace ogc::compare
