#include "compare/judge/engine/tally.hpp"
#include "compare/stages/bound.hpp"

#include <limits>

#include "compare/contestant.hpp"

#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("quantiles of a histogram are right within one per cent", "[unit]") {
  Histogram errors;
  for (int i = 1; i <= 1000; ++i) errors.add(i * 0.01);
  REQUIRE(errors.quantile(0.5) == Approx(5).epsilon(0.01));
  REQUIRE(errors.quantile(0.999) == Approx(9.99).epsilon(0.01));
  REQUIRE(errors.maximum() == 10);
  REQUIRE(Histogram{}.quantile(0.5) == 0);
}

TEST_CASE("an error beyond the tolerance is a mismatch, and so is one that is no number", "[unit]") {
  Tally tally(Stage::bound);
  tally.begin({Stage::bound, "few", 1, 2, "", {}});
  tally.error(0, bound_below_tolerance, [] { return ""; });
  REQUIRE(tally.mismatched == 0);
  tally.error(0, bound_below_tolerance * 1.01, [] { return "here"; });
  REQUIRE(tally.mismatched == 1);
  REQUIRE(tally.mismatches[0].name.index == 2);
  tally.error(0, std::numeric_limits<double>::quiet_NaN(), [] { return ""; });
  REQUIRE(tally.mismatched == 2);
}

TEST_CASE("tallies add up, and the worst case is the first of the largest", "[unit]") {
  Tally a(Stage::bound), b(Stage::bound);
  a.begin({Stage::bound, "few", 1, 1, "", {}});
  a.count(10, 10, 0);
  a.error(0, 1, [] { return ""; });
  b.begin({Stage::bound, "soup", 1, 2, "", {}});
  b.count(5, 5, 1);
  b.error(0, 2, [] { return ""; });
  b.begin({Stage::bound, "soup", 1, 3, "", {}});
  b.error(0, 2, [] { return ""; });
  a.add(b);
  REQUIRE(a.total().cases == 15);
  REQUIRE(a.total().grey == 1);
  REQUIRE(a.metrics[0].worst.index == 2);
}

TEST_CASE("grey decisions of the generic generators are limited, those of the ladders are not", "[unit]") {
  Tally tally(Stage::truncate);
  tally.begin({Stage::truncate, "ladder.bound", 1, 1, "", {}});
  tally.count(1000000, 1000000, 900000);
  REQUIRE(tally.grey_within_limit());
  tally.begin({Stage::truncate, "uniform", 1, 1, "", {}});
  tally.count(1000000, 1000000, 10);
  REQUIRE(tally.grey_within_limit());
  tally.count(0, 0, 40);
  REQUIRE_FALSE(tally.grey_within_limit());
  REQUIRE(tally.grey_share() == Approx(5e-5));
}

TEST_CASE("a generator that fails everywhere hides no other", "[unit]") {
  Tally a(Stage::bound);
  for (const char* generator : {"soup", "few"}) {
    Tally b(Stage::bound);
    b.begin({Stage::bound, generator, 1, 1, ""});
    for (std::uint64_t i = 0; i < 3 * Tally::listed; ++i) b.mismatch("wrong");
    a.add(b);
    a.add(b);
  }
  REQUIRE(a.mismatched == 12 * Tally::listed);
  REQUIRE(a.mismatches.size() == 2 * Tally::listed);
}

TEST_CASE("a tolerance that no error comes within a factor of 50 of is loose, and one that errors come near is not",
          "[unit]") {
  const MetricInfo info{"bound", "u b", 4};
  MetricTally metric;
  REQUIRE_FALSE(metric.is_loose(info));  // nothing was measured
  metric.errors.add(0);
  REQUIRE(metric.is_loose(info));
  metric.errors.add(0.079);
  REQUIRE(metric.is_loose(info));
  metric.errors.add(0.081);
  REQUIRE_FALSE(metric.is_loose(info));
  REQUIRE(metric.room(info) == Approx(4 / 0.081));
}

TEST_CASE("octaves hold every value once, ascending and without gaps", "[property]") {
  Histogram errors;
  for (const double value : {0.0, 1e-9, 0.4, 0.5, 0.9, 1.0, 9.0}) errors.add(value);
  const auto octaves = errors.octaves(-4);
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < octaves.size(); ++i) {
    REQUIRE(octaves[i].exponent == -4 + static_cast<int>(i));
    total += octaves[i].count;
  }
  REQUIRE(total == 7);
  REQUIRE(octaves.front().count == 2);
  REQUIRE(octaves.back().exponent == 3);
  REQUIRE(octaves[3].count == 2);  // [0.5, 1)
}

TEST_CASE("cases near a boundary are counted and shared out over all cases", "[unit]") {
  Tally tally(Stage::truncate);
  tally.begin({Stage::truncate, "uniform", 1, 1, "", {}});
  tally.count(30, 30, 0);
  tally.begin({Stage::truncate, "ladder.bound", 1, 1, "", {}});
  tally.count(10, 10, 1, 8);
  REQUIRE(tally.total().near == 8);
  REQUIRE(tally.near_share() == Approx(0.2));
}
