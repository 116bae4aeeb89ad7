// Finds which results of the audit of a text file may come from the rounding of the text instead of the simulation:
// intersections, or a distance below the last printed digit.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "compare/files/frames/printed_digits.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/oracle/smallest_distances.hpp"

namespace ogc::experiments {

/// √3: the largest change of the distance of two points, in units of the last printed digit. Rounding changes each
/// coordinate by at most half a unit.
inline constexpr double units_of_a_distance = 1.7320508075688773;

/// Holds the results of an audit that the rounding of a file's coordinates may have caused.
struct RoundingDoubt {
  compare::PrintedDigits printed;
  /// number of listed intersections; number of them that rounding may have caused
  std::size_t listed = 0, doubtful = 0;
  double smallest = 0;  ///< smallest distance [m]; it matters only if nothing intersects
};

/// Returns the results that rounding may have caused; empty if there are none.
std::optional<RoundingDoubt> rounding_doubt(const std::optional<compare::PrintedDigits>& printed,
                                            const compare::AuditResult& result,
                                            const compare::SmallestDistances& distances,
                                            const compare::Topology& topology,
                                            std::span<const compare::Vec3> positions);

/// Returns a sentence about the state `name`, with a remedy.
std::string describe(const RoundingDoubt& doubt, const std::string& name);
nlohmann::ordered_json to_json(const RoundingDoubt& doubt);

}  // namespace ogc::experiments
