// Reads Google Benchmark's result files (JSON) and compares two of them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// Holds the times of one result file.
struct BenchResults {
  /// times by benchmark [ns]: the median of each process; for a single process, the time of each repetition
  std::map<std::string, std::vector<double>> times;
  int processes = 1;
  std::map<std::string, std::string> context;  ///< "device_cpu", "commit", …
};

/// Reads a result file. Throws compare::InputError that names the file if it is missing, is no JSON, or is no result of
/// a benchmark.
BenchResults read_results(const std::filesystem::path& file);
/// Returns the file's JSON unchanged. Throws compare::InputError like read_results.
Json parse_results(const std::filesystem::path& file);

/// Holds the change of one benchmark that both files have.
struct BenchChange {
  std::string name;                                   ///< name of the benchmark
  std::size_t samples_before = 0, samples_after = 0;  ///< number of times in each file
  double before_ns = 0, after_ns = 0;                 ///< medians
  double ratio = 1;                                   ///< after / before (typical_ratio)
  double probability = 1;  ///< p of Mann–Whitney, corrected by Holm over all compared benchmarks
  enum class Verdict { faster, slower, none_found, too_few } verdict = Verdict::none_found;  ///< see compare_results
};

/// Holds the comparison of two result files.
struct BenchComparison {
  std::vector<BenchChange> changes;                  ///< one change for each benchmark that both files have
  std::vector<std::string> only_before, only_after;  ///< benchmarks that only one file has
  std::vector<std::string> differing_context;        ///< "device_cpu: 2 threads, then 16 threads"
  /// false: a file has only one process, so that BenchChange::probability does not cover differences between processes
  bool is_of_processes = true;
  /// Returns whether any benchmark has become slower.
  bool has_slower() const;
};

/// A benchmark counts as changed if its BenchChange::probability is below this.
inline constexpr double significance = 0.01;

/// Compares two result files by the rank test (experiments/bench/rank_test.hpp). Verdict::too_few: the files have so
/// few times that no order of the times could be significant.
BenchComparison compare_results(const BenchResults& before, const BenchResults& after);

/// Returns the comparison as text for people.
std::string describe(const BenchComparison& comparison);
/// Returns the comparison as JSON for programs.
Json to_json(const BenchComparison& comparison);

/// Returns "1.23 ms": a duration in a unit that fits.
std::string duration(double nanoseconds);

}  // namespace ogc::experiments
