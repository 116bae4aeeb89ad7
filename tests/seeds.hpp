// Provides the seeds of random tests. A fixed seed makes failures reproducible; a daily seed covers more cases over
// time.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>

namespace ogc::tests {

/// Returns the UTC date as yyyymmdd and prints it beside the name of the test.
inline std::uint64_t daily_seed(const char* what) {
  const auto now = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day day(now);
  const std::uint64_t seed = 10000 * static_cast<std::uint64_t>(static_cast<int>(day.year())) +
                             100 * static_cast<unsigned>(day.month()) + static_cast<unsigned>(day.day());
  std::printf("%s: the seed of the day is %llu\n", what, static_cast<unsigned long long>(seed));
  return seed;
}

}  // namespace ogc::tests
