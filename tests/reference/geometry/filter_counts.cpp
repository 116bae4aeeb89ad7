// Tests filter counts: each predicate is counted once, on every thread; it counts as undecided only if it needed exact
// numbers.
#include "reference/geometry/filter_counts.hpp"

#include <set>
#include <thread>
#include <vector>

#include "reference/geometry/margin.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using compare::Vec3f;
using reference::Filtered;

namespace {

/// Returns a margin of 2⁸⁰ + 1 − 2⁸⁰, in which double loses the 1.
reference::Margin drowned() { return reference::along({0, 0, 0}, {0x1p40f, 1, -0x1p40f}, {0x1p40f, 1, 0x1p40f}); }

}  // namespace

TEST_CASE("filter_counts: a sign of a few digits is decided by intervals, one that a double drowns by exact numbers",
          "[unit]") {
  const auto before = reference::filter_counts();
  CHECK(reference::sign(reference::along({0, 0, 0}, {1, 0, 0}, {2, 0, 0})) == 1);
  CHECK(reference::sign(reference::along({0, 0, 0}, {1, 0, 0}, {0, 2, 0})) == 0);
  CHECK(reference::filter_counts().since(before)[Filtered::along] == reference::FilterCount{2, 0});
  CHECK(reference::sign(drowned()) == 1);
  const auto counts = reference::filter_counts().since(before);
  CHECK(counts[Filtered::along] == reference::FilterCount{3, 1});
  CHECK(counts.total() == reference::FilterCount{3, 1});
}

TEST_CASE("filter_counts: threads that have ended and threads that run are all counted", "[unit]") {
  const auto before = reference::filter_counts();
  constexpr std::uint64_t threads = 4, questions = 1000;
  std::vector<std::thread> running;
  for (std::uint64_t k = 0; k < threads; ++k) {
    running.emplace_back([] {
      for (std::uint64_t i = 0; i < questions; ++i) reference::sign(drowned());
    });
  }
  for (std::thread& thread : running) thread.join();
  reference::sign(drowned());
  CHECK(reference::filter_counts().since(before)[Filtered::along] ==
        reference::FilterCount{threads * questions + 1, threads * questions + 1});
}

TEST_CASE("filter_counts: distances are counted where they are rounded and where they are compared", "[unit]") {
  const auto before = reference::filter_counts();
  const auto gap = reference::gap_points({0, 0, 0}, {3, 4, 0});
  CHECK(reference::distance_below(gap) == 5);  // the root's interval reaches below 5, but 25 − 5² has no rounding
  CHECK(reference::distance_below(reference::gap_line({0, 0, 0}, {0x1p30f, 1, 0}, {0x1p30f, 2, 0})) < 1);
  CHECK(reference::compare_distances(gap, reference::gap_points({1, 0, 0}, {7, 0, 0})) == -1);
  const auto counts = reference::filter_counts().since(before);
  CHECK(counts[Filtered::distance_below] == reference::FilterCount{2, 1});
  CHECK(counts[Filtered::nearer] == reference::FilterCount{1, 0});
}

TEST_CASE("filter_counts: every predicate has a name of its own", "[unit]") {
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < reference::filtered_predicates; ++k)
    names.insert(reference::name(static_cast<Filtered>(k)));
  CHECK(names.size() == reference::filtered_predicates);
  CHECK(names.count("") == 0);
  CHECK(reference::name(Filtered::gap_lines) == "gap_lines");
}
