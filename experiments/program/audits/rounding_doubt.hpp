// Finds what an audit of a text file can't decide: whether an intersection, or a distance below the last digit, comes
// from the simulation or from the printed digits.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "compare/files/frames/printed_digits.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/oracle/smallest_distances.hpp"

namespace ogc::experiments {

/// √3: the distance of two points can change by this many units if each of their coordinates is off by at most half a
/// unit.
inline constexpr double units_of_a_distance = 1.7320508075688773;

/// Holds what the digits of a file leave undecided.
struct RoundingDoubt {
  compare::PrintedDigits printed;
  std::size_t listed = 0, doubtful = 0;  ///< listed intersections, and those that rounding may have made
  double smallest = 0;                   ///< smallest distance, which matters if nothing intersects [m]
};

/// Returns nothing if the file's digits decide all that was found.
std::optional<RoundingDoubt> rounding_doubt(const std::optional<compare::PrintedDigits>& printed,
                                            const compare::AuditResult& result,
                                            const compare::SmallestDistances& distances,
                                            const compare::Topology& topology,
                                            std::span<const compare::Vec3> positions);

/// Returns a sentence about the state of this name, with a remedy.
std::string describe(const RoundingDoubt& doubt, const std::string& name);
nlohmann::ordered_json to_json(const RoundingDoubt& doubt);

}  // namespace ogc::experiments
