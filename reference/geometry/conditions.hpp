// A region of space is a conjunction of conditions on margins. The exact answer asks whether all hold; the grey zone asks which could hold after
// rounding.
#pragma once

#include "reference/geometry/margin.hpp"

namespace ogc::reference {

/// margin > 0 (`positive`) or margin ≤ 0.
struct Condition {
  Margin margin;
  bool positive = true;
};

inline bool holds(const Condition& condition) { return (sign(condition.margin) > 0) == condition.positive; }

/// What a conjunction of conditions amounts to.
struct Membership {
  bool exact = true;     ///< all hold
  bool possible = true;  ///< no condition fails outside the grey zone
  bool certain = true;   ///< all hold, none of them in the grey zone
};

/// Adds one condition to a conjunction. Once `possible` is false the rest cannot matter.
inline void require(Membership& membership, const Condition& condition) {
  const bool held = holds(condition), doubtful = grey(condition.margin);
  membership.exact = membership.exact && held;
  membership.possible = membership.possible && (held || doubtful);
  membership.certain = membership.certain && held && !doubtful;
}

}  // namespace ogc::reference
