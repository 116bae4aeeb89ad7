// A region of space is a conjunction of conditions on margins. The exact answer asks whether all hold; the grey zone
// asks which could hold after rounding.
#pragma once

#include "reference/geometry/margin.hpp"

namespace ogc::reference {

/// margin > 0 (`positive`) or margin ≤ 0.
struct Condition {
  Margin margin;         ///< whose sign decides
  bool positive = true;  ///< margin > 0; else margin ≤ 0
};

/// Exact.
inline bool holds(const Condition& condition) { return (sign(condition.margin) > 0) == condition.positive; }

/// What a conjunction of conditions amounts to.
struct Membership {
  bool exact = true;     ///< all hold
  bool possible = true;  ///< no condition fails outside the grey zone
  bool certain = true;   ///< all hold, none of them in the grey zone
};

/// Adds one condition, by whether it holds and whether its margin is grey, to a conjunction. Once `possible` is false
/// the rest cannot matter.
inline void require(Membership& membership, bool held, bool doubtful) {
  membership.exact = membership.exact && held;
  membership.possible = membership.possible && (held || doubtful);
  membership.certain = membership.certain && held && !doubtful;
}

/// Adds a condition to those that the region asks for.
inline void require(Membership& membership, const Condition& condition) {
  const MarginAnswer margin = examine(condition.margin);
  require(membership, (margin.sign > 0) == condition.positive, margin.grey);
}

/// Whether a conjunction lies next to where it ends or begins: no condition fails but near its boundary, and some
/// condition is near.
class Nearness {
 public:
  /// One condition more: whether it holds, and whether it is next to its boundary.
  void add(bool held, bool near) {
    within_reach_ = within_reach_ && (held || near);
    near_ = near_ || near;
  }
  void add(const Condition& condition) {
    const MarginAnswer margin = examine(condition.margin);
    add((margin.sign > 0) == condition.positive, margin.near);
  }
  /// Whether no condition fails far from its boundary.
  bool within_reach() const { return within_reach_; }
  /// Whether a boundary is near, and the rest within reach.
  bool is_near() const { return within_reach_ && near_; }

 private:
  bool within_reach_ = true, near_ = false;
};

}  // namespace ogc::reference
