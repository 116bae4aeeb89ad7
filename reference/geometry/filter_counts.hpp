// How often double and interval arithmetic decide by themselves: every predicate that asks them first is counted,
// thread by thread, so that counting costs no more than an addition.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ogc::reference {

/// A predicate behind an interval filter: the signs of the margins (in the order of MarginKind), a distance rounded
/// down, and which of two distances is smaller.
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

/// "gap_plane".
std::string_view name(Filtered predicate);

/// How often one predicate was asked, and needed exact numbers.
struct FilterCount {
  std::uint64_t calls = 0;      ///< how often the predicate was asked
  std::uint64_t undecided = 0;  ///< of these, left to exact numbers
  friend bool operator==(const FilterCount&, const FilterCount&) = default;
};

/// The counts of all predicates.
struct FilterCounts {
  std::array<FilterCount, filtered_predicates> of{};  ///< in the order of Filtered

  const FilterCount& operator[](Filtered predicate) const { return of[static_cast<std::size_t>(predicate)]; }
  /// The sum over all predicates.
  FilterCount total() const;
  /// What was counted after `earlier`.
  FilterCounts since(const FilterCounts& earlier) const;
};

/// The counts of all threads since the program began. Complete for work that has been joined; a predicate that another
/// thread asks meanwhile may be missing.
FilterCounts filter_counts();

/// For the predicates themselves.
void count_filter(Filtered predicate, bool undecided);

}  // namespace ogc::reference
