#include "experiments/bench/rank_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ogc::experiments {

namespace {

constexpr std::size_t largest_exact = 50;

/// Returns the number of pairs (b, a) with a > b; a tie counts one half.
double u_statistic(std::span<const double> before, std::span<const double> after) {
  double u = 0;
  for (const double b : before)
    for (const double a : after) u += a > b ? 1 : a == b ? 0.5 : 0;
  return u;
}

/// Returns Σ (t³ − t) over groups of t equal values.
double tie_sum(std::span<const double> before, std::span<const double> after) {
  std::vector<double> all(before.begin(), before.end());
  all.insert(all.end(), after.begin(), after.end());
  std::ranges::sort(all);
  double sum = 0;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end] == all[begin]) ++end;
    const auto t = static_cast<double>(end - begin);
    sum += t * t * t - t;
  }
  return sum;
}

/// Returns the share of all orders of n + m values for which U ≤ `u`. Let f(n, m, u) be the number of orders with U =
/// u. It obeys f(n, m, u) = f(n − 1, m, u − m) + f(n, m − 1, u). In the first term the largest value belongs to the
/// first set and exceeds all m values of the second set. In the second term it belongs to the second set. The code
/// computes shares, not numbers, so that nothing overflows.
double share_up_to(std::size_t n, std::size_t m, std::size_t u) {
  const std::size_t most = n * m;
  // by_second[j][u]: share of the orders of i values of the first set and j values of the second for which U = u
  std::vector<std::vector<double>> by_second(m + 1, std::vector<double>(most + 1, 0));
  for (auto& shares : by_second) shares[0] = 1;
  for (std::size_t i = 1; i <= n; ++i) {
    for (std::size_t j = 1; j <= m; ++j) {
      const auto first = static_cast<double>(i) / static_cast<double>(i + j),
                 second = static_cast<double>(j) / static_cast<double>(i + j);
      std::vector<double> shares(most + 1, 0);
      for (std::size_t k = 0; k <= i * j; ++k)
        shares[k] = second * by_second[j - 1][k] + (k >= j ? first * by_second[j][k - j] : 0);
      by_second[j] = std::move(shares);
    }
  }
  return std::accumulate(by_second[m].begin(), by_second[m].begin() + static_cast<std::ptrdiff_t>(u) + 1, 0.0);
}

double normal_probability(double distance, double n, double m, double ties) {
  const double all = n + m, variance = n * m / 12 * (all + 1 - ties / (all * (all - 1)));
  if (!(variance > 0)) return 1;
  return std::erfc(std::max(0.0, distance - 0.5) / std::sqrt(2 * variance));
}

}  // namespace

double mann_whitney(std::span<const double> before, std::span<const double> after) {
  const std::size_t n = before.size(), m = after.size();
  if (n == 0 || m == 0) return 1;
  const double u = u_statistic(before, after), middle = 0.5 * static_cast<double>(n * m), ties = tie_sum(before, after);
  if (ties > 0 || std::max(n, m) > largest_exact)
    return normal_probability(std::abs(u - middle), static_cast<double>(n), static_cast<double>(m), ties);
  return std::min(1.0, 2 * share_up_to(n, m, static_cast<std::size_t>(std::min(u, 2 * middle - u))));
}

double smallest_probability(std::size_t before, std::size_t after) {
  double orders = 1;
  for (std::size_t k = 1; k <= after; ++k) orders = orders * static_cast<double>(before + k) / static_cast<double>(k);
  return std::min(1.0, 2 / orders);
}

std::vector<double> holm(std::span<const double> probabilities) {
  std::vector<std::size_t> order(probabilities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return probabilities[i]; });
  std::vector<double> corrected(probabilities.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    largest = std::max(largest, probabilities[order[rank]] * static_cast<double>(order.size() - rank));
    corrected[order[rank]] = std::min(1.0, largest);
  }
  return corrected;
}

double typical_ratio(std::span<const double> before, std::span<const double> after) {
  std::vector<double> ratios;
  for (const double b : before)
    for (const double a : after) ratios.push_back(a / b);
  return median(std::move(ratios));
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace ogc::experiments
