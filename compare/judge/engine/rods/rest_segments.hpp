// What stage rest_state is asked about rods: the verdict on segments, and scenes that have some.
#pragma once

#include <functional>
#include <string>

#include "compare/judge/cases/random.hpp"
#include "compare/stages/rest_state.hpp"

namespace ogc::compare {

/// Compares numbers of segments: `error(what, segment, off, scale, value, exact)` for each, `wrong(what, segment)` for
/// a name of a vertex, a body or a neighbour that is another one.
struct SegmentVerdict {
  std::function<void(const char*, std::size_t, double, double, double, double)> error;
  std::function<void(const char*, std::size_t)> wrong;

  /// Both have the same number of segments.
  void judge(const RestStateTruth& truth, const RestStateOut& out) const;
};

}  // namespace ogc::compare
