#include "experiments/bench/rank_test.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/catch.hpp"

using namespace ogc::experiments;

namespace {

double pairs_won(const std::vector<double>& before, const std::vector<double>& after) {
  double won = 0;
  for (const double b : before)
    for (const double a : after) won += a > b;
  return won;
}

/// Returns the exact result of mann_whitney. Enumerates all choices of the values that belong to the first set.
double by_enumeration(const std::vector<double>& before, const std::vector<double>& after) {
  const double middle = 0.5 * static_cast<double>(before.size() * after.size()),
               distance = std::abs(pairs_won(before, after) - middle);
  std::vector<int> of_first(before.size() + after.size(), 0);
  std::fill(of_first.end() - static_cast<std::ptrdiff_t>(before.size()), of_first.end(), 1);
  double all = 0, extreme = 0;
  do {
    std::vector<double> first, second;
    for (std::size_t i = 0; i < of_first.size(); ++i) (of_first[i] ? first : second).push_back(static_cast<double>(i));
    ++all;
    extreme += std::abs(pairs_won(first, second) - middle) >= distance;
  } while (std::next_permutation(of_first.begin(), of_first.end()));
  return extreme / all;
}

std::vector<double> normal(std::mt19937& random, std::size_t count, double mean) {
  std::normal_distribution<double> distribution(mean, 1);
  std::vector<double> values(count);
  for (double& value : values) value = distribution(random);
  return values;
}

}  // namespace

TEST_CASE("the exact probability of Mann and Whitney is the share of orders at least as extreme", "[property]") {
  std::mt19937 random(3);
  for (const auto& [n, m] : {std::pair<std::size_t, std::size_t>{1, 1}, {3, 4}, {5, 2}, {6, 6}, {7, 4}})
    for (int trial = 0; trial < 5; ++trial) {
      const std::vector<double> before = normal(random, n, 0), after = normal(random, m, 0.7 * trial);
      CHECK(mann_whitney(before, after) == Approx(by_enumeration(before, after)));
    }
}

// The test counts false alarms at the level 2 %. For 4000 trials their share has a standard deviation of 0.22 %, so a
// correct test stays below 2 % + 4 · 0.22 % = 2.9 %. The limit of 3.5 % also allows for the test's discrete
// probabilities and for the normal approximation.
TEST_CASE("equal distributions are told apart no more often than the level says, with and without ties", "[property]") {
  std::mt19937 random(7);
  for (const auto& [count, round] : {std::pair<std::size_t, bool>{8, false}, {60, false}, {20, true}}) {
    int alarms = 0;
    for (int trial = 0; trial < 4000; ++trial) {
      std::vector<double> before = normal(random, count, 5), after = normal(random, count, 5);
      if (round)
        for (auto* set : {&before, &after})
          for (double& value : *set) value = std::round(2 * value);
      alarms += mann_whitney(before, after) < 0.02;
    }
    CHECK(alarms < 0.035 * 4000);
    CHECK(alarms > 0);
  }
}

TEST_CASE("sets that do not overlap have the smallest probability that their sizes allow", "[unit]") {
  const std::vector<double> before{1, 2, 3, 4}, after{5, 6, 7, 8};
  CHECK(mann_whitney(before, after) == Approx(2.0 / 70));
  CHECK(mann_whitney(after, before) == Approx(2.0 / 70));
  CHECK(smallest_probability(4, 4) == Approx(2.0 / 70));
  CHECK(smallest_probability(1, 1) == 1);
  CHECK(mann_whitney({}, after) == 1);
  const std::vector<double> same(5, 2.0);
  CHECK(mann_whitney(same, same) == 1);
}

TEST_CASE("Holm multiplies the smallest probability by all, the next by one less, and keeps the order", "[unit]") {
  const std::vector<double> probabilities{0.04, 0.01, 0.03, 0.9};
  CHECK(holm(probabilities) == std::vector<double>{0.09, 0.04, 0.09, 0.9});
  CHECK(holm({}).empty());
}

TEST_CASE("the typical ratio is that of scaled sets, whatever a single outlier is", "[unit]") {
  const std::vector<double> before{1, 2, 4}, after{3, 6, 12}, outlier{3, 6, 1e9};
  CHECK(typical_ratio(before, after) == 3);
  CHECK(typical_ratio(before, outlier) == 3);
  CHECK(median({4, 1, 3, 2}) == 2.5);
}
