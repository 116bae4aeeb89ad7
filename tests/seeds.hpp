// Seeds of random tests: one that never changes, so that a failure comes back, and one that is new each day, so that
// what is tried grows. A test says in its messages which one it took.
#pragma once

#include <chrono>
#include <cstdint>

namespace ogc::tests {

/// The day as yyyymmdd, in UTC: what `experiments/seeds` gives for a day.
inline std::uint64_t daily_seed() {
  const auto now = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day day(now);
  return 10000 * static_cast<std::uint64_t>(static_cast<int>(day.year())) +
         100 * static_cast<std::uint64_t>(static_cast<unsigned>(day.month())) + static_cast<unsigned>(day.day());
}

}  // namespace ogc::tests
