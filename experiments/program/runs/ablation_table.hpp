// Tabulates the runs of an ablation: the metrics of each run, their medians and ranges for each setting, and sentences
// that compare two settings. Each run is read from its folder alone, so that an interrupted grid, or one computed by
// several jobs, needs no special code.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ogc::experiments {

/// Holds name and unit of a metric.
struct Metric {
  std::string_view name, unit;
};

/// Returns all metrics in the order of the table: times, counts, momentum, residuals, distance, energies, lag, stretch.
std::vector<Metric> ablation_metrics();

/// Holds the results of one run.
struct RunRow {
  std::string status;           ///< run.json's status up to the first colon
  std::int64_t steps = 0;       ///< number of rows of steps.csv
  std::vector<double> metrics;  ///< in the order of ablation_metrics; not-a-number if not measured
  /// values of run.json; `guarantee_kept` is "not checked" if run.json has none
  std::string guarantee_kept, audited_states, final_hash, device, folder;
};

/// Reads a run's folder. Throws compare::InputError that names the file.
RunRow read_run_row(const std::filesystem::path& folder);

/// Holds the runs of one setting with different seeds.
struct SettingRows {
  std::string name;  ///< "contact_activation=ogc,membrane=…"
  std::vector<RunRow> rows;
};

/// Holds median and range of one metric over the finished runs of a setting.
struct MetricRange {
  std::size_t runs = 0;
  double median = 0, smallest = 0, largest = 0;  ///< not-a-number unless all of these runs measured it
};
/// Returns the range of a metric. The median of an even number of runs is the mean of the middle two.
MetricRange range_of(const SettingRows& setting, std::size_t metric);

/// Returns one sentence that compares the settings `one` and `other` in a metric, or an empty text if one of them did
/// not measure it. If every run of `one` lies above, or below, every run of `other`, the sentence gives the ratio: "is
/// 1.8 times …, range 1.6 to 2.1". Otherwise it states that no difference is shown. The range covers the ratios of all
/// pairs of runs, or their differences if a value is not positive.
std::string sentence(const Metric& metric, const SettingRows& one, const MetricRange& range_of_one,
                     const SettingRows& other, const MetricRange& range_of_other);

/// Returns lines that compare every setting with the first one, metric by metric, and a line that states how often such
/// differences arise by chance.
std::vector<std::string> findings(const std::vector<SettingRows>& settings);

/// Returns the probability that the ranges of `n` and `m` values of one continuous distribution do not overlap: 2 / C(n
/// + m, n). All orders of the n + m values are equally likely; in two of them all values of one group precede the other
/// group.
double apart_by_chance(std::size_t n, std::size_t m);

}  // namespace ogc::experiments
