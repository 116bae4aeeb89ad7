// Finds the meetings between two audited states: pairs of primitives that touch while every vertex moves straight from
// one state to the next (compare/meetings.md).
#pragma once

#include <string>
#include <vector>

#include "compare/oracle/meetings.hpp"
#include "experiments/program/audits/audit_source.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// Holds the meetings (pairs that touch) of the straight motions from one state to the next.
struct Way {
  std::string from, to;  ///< names of the states
  compare::MeetingsResult found;
  Json json;         ///< the same result for --json
  std::string text;  ///< the listed meetings in words, one line each
};

/// Checks the straight motions between consecutive states.
class WaysBetween {
 public:
  /// `limit`: number of meetings listed for each motion. The source must outlive this object.
  WaysBetween(const AuditSource& source, std::size_t limit) : source_(source), limit_(limit) {}
  /// Checks the motion from the previous state to this one. Before the first motion, logs the estimated time for all of
  /// them. Throws compare::InputError if the two states have different triangles.
  void look_at(const AuditedState& state);
  /// Returns the motions checked so far.
  const std::vector<Way>& ways() const { return ways_; }
  /// Returns the number of meetings in all motions.
  std::size_t meetings() const;
  /// Returns a summary: "5 straight ways between them, 12 meetings on 1 of them, the first from frame 3 to frame 4".
  std::string headline() const;

 private:
  void announce(const AuditedState& from, const AuditedState& to) const;
  const AuditSource& source_;
  std::size_t limit_;
  AuditedState before_;
  std::vector<Way> ways_;
};

}  // namespace ogc::experiments
