// Counts how often double and interval arithmetic decide a predicate without exact numbers. Each thread has its own
// counters, so one count costs one addition.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ogc::reference {

/// The predicates with an interval filter: the signs of the margins (in the order of MarginKind), a distance rounded
/// down, and the comparison of two distances.
enum class Filtered : std::uint8_t {
  along,
  side,
  turn,
  parallel,
  gap_points,
  gap_line,
  gap_plane,
  gap_lines,
  distance_below,
  nearer
};
inline constexpr std::size_t filtered_predicates = 10;  ///< enumerators of Filtered

/// Returns a name such as "gap_plane".
std::string_view name(Filtered predicate);

/// Counts the evaluations of one predicate.
struct FilterCount {
  std::uint64_t calls = 0;      ///< evaluations of the predicate
  std::uint64_t undecided = 0;  ///< evaluations that needed exact numbers
  friend bool operator==(const FilterCount&, const FilterCount&) = default;
};

/// The counts of all predicates.
struct FilterCounts {
  std::array<FilterCount, filtered_predicates> of{};  ///< in the order of Filtered

  const FilterCount& operator[](Filtered predicate) const { return of[static_cast<std::size_t>(predicate)]; }
  /// Returns the sum over all predicates.
  FilterCount total() const;
  /// Returns these counts minus `earlier`.
  FilterCounts since(const FilterCounts& earlier) const;
};

/// Returns the counts of all threads since the program began. May miss evaluations that run during the call.
FilterCounts filter_counts();

/// Counts one evaluation; called by the predicates.
void count_filter(Filtered predicate, bool undecided);

}  // namespace ogc::reference
