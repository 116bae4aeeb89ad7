// Result files of Google Benchmark (its own JSON), and what changed from one to another.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// The times of one result file.
struct BenchResults {
  /// by name [ns]: each process' median; of a single process each repetition
  std::map<std::string, std::vector<double>> times;
  int processes = 1;
  std::map<std::string, std::string> context;  ///< "device_cpu", "commit", …
};

/// Throws compare::InputError that names the file: missing, no JSON, no result of a benchmark.
BenchResults read_results(const std::filesystem::path& file);
/// Its JSON as it stands. Throws likewise.
Json parse_results(const std::filesystem::path& file);

/// What became of one benchmark that both files have.
struct BenchChange {
  std::string name;                                   ///< of the benchmark
  std::size_t samples_before = 0, samples_after = 0;  ///< times in each file
  double before_ns = 0, after_ns = 0;                 ///< medians
  double ratio = 1;                                   ///< after / before (typical_ratio)
  double probability = 1;  ///< of Mann–Whitney, corrected by Holm over all benchmarks of the comparison
  enum class Verdict { faster, slower, none_found, too_few } verdict = Verdict::none_found;  ///< see compare_results
};

/// Two result files, held against each other.
struct BenchComparison {
  std::vector<BenchChange> changes;                  ///< by name
  std::vector<std::string> only_before, only_after;  ///< benchmarks that one file alone has
  std::vector<std::string> differing_context;        ///< "device_cpu: 2 threads, then 16 threads"
  /// false: one of the files is of a single process, and p knows nothing of what differs between starts
  bool is_of_processes = true;
  /// Whether any benchmark has become slower.
  bool has_slower() const;
};

/// A benchmark changed where its corrected probability is below this.
inline constexpr double significance = 0.01;

/// How noise is judged: experiments/bench/rank_test.hpp. `too_few`: no order of so many repetitions could be
/// significant.
BenchComparison compare_results(const BenchResults& before, const BenchResults& after);

/// For people.
std::string describe(const BenchComparison& comparison);
/// For programs.
Json to_json(const BenchComparison& comparison);

/// "1.23 ms": with a unit that fits.
std::string duration(double nanoseconds);

}  // namespace ogc::experiments
