// Describes a region of space as a conjunction of conditions on margins. Tells exactly whether a point is in the
// region, and whether rounding could change this answer (grey).
#pragma once

#include "reference/geometry/margin.hpp"

namespace ogc::reference {

/// A condition margin > 0 (`positive`) or margin ≤ 0.
struct Condition {
  Margin margin;         ///< the margin whose sign decides
  bool positive = true;  ///< margin > 0; else margin ≤ 0
};

/// Returns whether the condition holds, exactly.
inline bool holds(const Condition& condition) { return (sign(condition.margin) > 0) == condition.positive; }

/// The result of a conjunction of conditions.
struct Membership {
  bool exact = true;     ///< all conditions hold
  bool possible = true;  ///< no condition fails outside the grey zone
  bool certain = true;   ///< all conditions hold, none of them in the grey zone
};

/// Adds one condition: whether it holds, and whether its margin is grey.
inline void require(Membership& membership, bool held, bool doubtful) {
  membership.exact = membership.exact && held;
  membership.possible = membership.possible && (held || doubtful);
  membership.certain = membership.certain && held && !doubtful;
}

/// Examines a condition's margin and adds the condition.
inline void require(Membership& membership, const Condition& condition) {
  const MarginAnswer margin = examine(condition.margin);
  require(membership, (margin.sign > 0) == condition.positive, margin.grey);
}

/// Decides whether the value of a conjunction is near a change: at least one condition is near its boundary, and all
/// conditions that fail are near their boundaries.
class Nearness {
 public:
  /// Adds a condition: whether it holds, and whether it is near its boundary.
  void add(bool held, bool near) {
    within_reach_ = within_reach_ && (held || near);
    near_ = near_ || near;
  }
  void add(const Condition& condition) {
    const MarginAnswer margin = examine(condition.margin);
    add((margin.sign > 0) == condition.positive, margin.near);
  }
  /// Returns whether no condition fails far from its boundary.
  bool within_reach() const { return within_reach_; }
  /// Returns whether some condition is near its boundary, and no condition fails far from its boundary.
  bool is_near() const { return within_reach_ && near_; }

 private:
  bool within_reach_ = true, near_ = false;
};

}  // namespace ogc::reference
