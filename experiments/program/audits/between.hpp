// What lies between two audited states: which faces meet while every vertex moves straight from the one to the other
// (compare/meetings.md).
#pragma once

#include <string>
#include <vector>

#include "compare/oracle/meetings.hpp"
#include "experiments/program/audits/audit_source.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// The straight way from a state to the next.
struct Way {
  std::string from, to;           ///< names of the states
  compare::MeetingsResult found;  ///< what meets on it
  Json json;                      ///< the same for --json
  std::string text;               ///< the listed meetings in words, a line each
};

/// Asks the ways between states as they come, in their order.
class WaysBetween {
 public:
  /// `limit`: meetings that are listed of a way. The source must outlive it.
  WaysBetween(const AuditSource& source, std::size_t limit) : source_(source), limit_(limit) {}
  /// The way from the state before to this one; of the first way it logs what all of them will take. Throws
  /// compare::InputError where the two have other triangles.
  void look_at(const AuditedState& state);
  /// Those that were asked.
  const std::vector<Way>& ways() const { return ways_; }
  /// On all of them.
  std::size_t meetings() const;
  /// "5 straight ways between them, 12 meetings on 1 of them, the first from frame 3 to frame 4".
  std::string headline() const;

 private:
  void announce(const AuditedState& from, const AuditedState& to) const;
  const AuditSource& source_;
  std::size_t limit_;
  AuditedState before_;
  std::vector<Way> ways_;
};

}  // namespace ogc::experiments
