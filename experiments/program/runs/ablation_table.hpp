// What the runs of an ablation come to: the metrics of each run, their medians and ranges a setting, and what may be
// said of two settings. A run is read from its folder alone, so that a grid that was cut off, or was computed by many
// jobs, is tabulated like one that was not.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::experiments {

/// A column of the table.
struct Metric {
  std::string_view name, unit;
};

/// All metrics, in the order of the table: times, counts, momentum, residuals, distance, energies, lag.
std::vector<Metric> ablation_metrics();

/// What one run came to.
struct RunRow {
  std::string status;           ///< the first word of run.json's
  std::int64_t steps = 0;       ///< rows of steps.csv
  std::vector<double> metrics;  ///< in the order of ablation_metrics; not-a-number where it was not measured
  /// as in run.json; `guarantee_kept`: "yes", "no" or "not checked"
  std::string guarantee_kept, audited_states, final_hash, device, folder;
};

/// Reads a run's folder. Throws compare::InputError that names the file.
RunRow read_run_row(const std::filesystem::path& folder);

/// Runs of one setting, of different seeds.
struct SettingRows {
  std::string name;  ///< "activation=ogc,membrane=…"
  std::vector<RunRow> rows;
};

/// Median and range of a metric over the finished runs of a setting.
struct MetricRange {
  std::size_t runs = 0;                          ///< finished runs
  double median = 0, smallest = 0, largest = 0;  ///< not-a-number unless every one of them measured it
};
/// The median of an even number of runs is the mean of the middle two.
MetricRange range_of(const SettingRows& setting, std::size_t metric);

/// What may be said of `one` against `other` in a metric: "is 1.8 times …, range 1.6 to 2.1" where every run of one is
/// above, or below, every run of the other; else that no difference is shown. The range is that of the ratios of any
/// two runs, or of their differences where a value is 0 or of another sign. One sentence, empty where one of the two
/// did not measure it.
std::string sentence(const Metric& metric, const SettingRows& one, const MetricRange& range_of_one,
                     const SettingRows& other, const MetricRange& range_of_other);

/// Every setting against the first, metric by metric, with how often such sentences come about by chance. Lines.
std::vector<std::string> findings(const std::vector<SettingRows>& settings);

/// The probability that the ranges of `n` and `m` values of one continuous distribution lie apart: 2 / C(n + m, n),
/// because all orders of the n + m values are equally likely, and in two of them one sort comes first.
double apart_by_chance(std::size_t n, std::size_t m);

}  // namespace ogc::experiments
