// What an audit of a text file can't know: whether an intersection, or a distance that is smaller than the last digit,
// is the simulation's own or the printer's.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "compare/files/frames/printed_digits.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/oracle/smallest_distances.hpp"

namespace ogc::experiments {

/// Two points whose coordinates are each off by at most half a unit are off by √3 units from each other.
inline constexpr double units_of_a_distance = 1.7320508075688773;

/// What the digits of a file leave open.
struct RoundingDoubt {
  compare::PrintedDigits printed;
  std::size_t listed = 0, doubtful = 0;  ///< intersections that are listed, and those of them that rounding can make
  double smallest = 0;                   ///< the smallest distance of a state without intersections [m]
};

/// Nothing where the file's digits decide all that was found.
std::optional<RoundingDoubt> rounding_doubt(const std::optional<compare::PrintedDigits>& printed,
                                            const compare::AuditResult& result,
                                            const compare::SmallestDistances& distances,
                                            const compare::Topology& topology,
                                            std::span<const compare::Vec3> positions);

/// A sentence about the state of this name, and what to do.
std::string describe(const RoundingDoubt& doubt, const std::string& name);
nlohmann::ordered_json to_json(const RoundingDoubt& doubt);

}  // namespace ogc::experiments
