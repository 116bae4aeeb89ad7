#include "experiments/program/runs/ablation_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>

#include "compare/files/numbers.hpp"
#include "compare/record/manifest.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/bench/rank_test.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/resume.hpp"

namespace ogc::experiments {

namespace {

using compare::StepMetrics;
using Rows = std::vector<StepMetrics>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> values_of(const Rows& rows, const std::function<double(const StepMetrics&)>& value) {
  std::vector<double> values;
  for (const StepMetrics& row : rows) values.push_back(value(row));
  return values;
}

/// Returns the median. Like the functions below, returns not-a-number if one of the values is not-a-number.
double median_of(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isnan(value); }) ? nan : median(values);
}

double largest(const std::vector<double>& values) {
  double result = values.empty() ? nan : values.front();
  for (const double value : values)
    if (!(value <= result)) result = value;
  return result;
}

double smallest(const std::vector<double>& values) {
  double result = values.empty() ? nan : values.front();
  for (const double value : values)
    if (!(value >= result)) result = value;
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? nan : sum / static_cast<double>(values.size());
}

double last(const std::vector<double>& values) { return values.empty() ? nan : values.back(); }

double contacts(const StepMetrics& row) {
  return static_cast<double>(row.vertex_facet_contacts + row.edge_edge_contacts);
}

double energy(const StepMetrics& row) {
  return row.kinetic_energy + row.elastic_energy + row.contact_energy + row.gravity_energy;
}

/// Defines a metric of steps.csv: the value for each step, and how the values of all steps are combined.
struct StepMetric {
  Metric metric;
  double (*value)(const StepMetrics& row);
  double (*over_steps)(const std::vector<double>& values);
};

const std::array<StepMetric, 21>& step_metrics() {
  static const std::array<StepMetric, 21> metrics{{
      {{"median_step", "ms"}, [](const StepMetrics& r) { return r.wall_ms; }, median_of},
      {{"worst_step", "ms"}, [](const StepMetrics& r) { return r.wall_ms; }, largest},
      {{"iterations_a_step", "1"}, [](const StepMetrics& r) { return static_cast<double>(r.iterations); }, mean},
      {{"detections_a_step", "1"},
       [](const StepMetrics& r) { return static_cast<double>(r.discrete_detections); },
       mean},
      {{"continuous_detections_a_step", "1"},
       [](const StepMetrics& r) { return static_cast<double>(r.continuous_detections); },
       mean},
      {{"contacts_a_step", "1"}, contacts, mean},
      {{"most_contacts", "1"}, contacts, largest},
      {{"largest_share_cut", "1"}, [](const StepMetrics& r) { return r.share_cut; }, largest},
      {{"largest_momentum_lost_guess", "1"}, [](const StepMetrics& r) { return r.momentum_lost_guess; }, largest},
      {{"largest_momentum_lost_end", "1"}, [](const StepMetrics& r) { return r.momentum_lost_end; }, largest},
      {{"median_residual", "1"}, [](const StepMetrics& r) { return r.residual; }, median_of},
      {{"largest_residual", "1"}, [](const StepMetrics& r) { return r.residual; }, largest},
      {{"smallest_distance", "m"}, [](const StepMetrics& r) { return r.smallest_distance; }, smallest},
      {{"last_kinetic_energy", "J"}, [](const StepMetrics& r) { return r.kinetic_energy; }, last},
      {{"last_elastic_energy", "J"}, [](const StepMetrics& r) { return r.elastic_energy; }, last},
      {{"last_contact_energy", "J"}, [](const StepMetrics& r) { return r.contact_energy; }, last},
      {{"last_gravity_energy", "J"}, [](const StepMetrics& r) { return r.gravity_energy; }, last},
      {{"last_energy", "J"}, energy, last},
      {{"largest_lag", "m"}, [](const StepMetrics& r) { return r.largest_lag; }, largest},
      {{"last_mean_stretch", "1"}, [](const StepMetrics& r) { return r.mean_stretch; }, last},
      {{"largest_stretch", "1"}, [](const StepMetrics& r) { return r.largest_stretch; }, largest},
  }};
  return metrics;
}

/// Metrics of the residual at the end of each step, computed with the contacts of the step's last detection. They are
/// read from the last row of each step in iterations.csv.
constexpr std::array stale_residuals{Metric{"median_stale_residual", "1"}, Metric{"largest_stale_residual", "1"}};

/// Returns the values of `stale_residuals`; not-a-number if the run has no such rows.
std::array<double, stale_residuals.size()> stale_residuals_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / "iterations.csv");
  std::map<std::string, double> by_step;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::array<std::string, 4> cells;  // step, iteration, wall time, residual
    std::size_t begin = 0;
    for (std::string& cell : cells) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      cell = line.substr(begin, end - begin);
      begin = std::min(end + 1, line.size());
    }
    double residual = nan;
    if (compare::parse_number(cells[3], residual)) by_step[cells[0]] = residual;
  }
  std::vector<double> values;
  for (const auto& [step, value] : by_step) values.push_back(value);
  if (values.empty()) return {nan, nan};
  return {median_of(values), largest(values)};
}

std::string text(double value) { return number(value, 3); }

/// Returns a ratio as text, with more digits if it is near 1, so that it is not printed as 1.
std::string ratio(double value) { return number(value, std::abs(value - 1) < 0.01 ? 6 : 3); }

std::string with_unit(double value, const Metric& metric) {
  return text(value) + (metric.unit == "1" ? "" : " " + std::string(metric.unit));
}

bool is_constant(const MetricRange& range) { return range.smallest == range.largest; }

std::string interval(const MetricRange& range, const Metric& metric) {
  if (is_constant(range)) return with_unit(range.smallest, metric);
  return text(range.smallest) + " to " + with_unit(range.largest, metric);
}

std::string audit_line(const SettingRows& setting) {
  std::size_t finished = 0, kept = 0, checked = 0;
  for (const RunRow& row : setting.rows) {
    finished += row.status == "finished";
    kept += row.guarantee_kept == "yes";
    checked += row.guarantee_kept != "not checked";
  }
  const std::string all = " of " + std::to_string(setting.rows.size());
  return "audit: " + setting.name + ": " + std::to_string(finished) + all + " runs finished, " + std::to_string(kept) +
         " of the " + std::to_string(checked) + " audited ones kept the guarantee";
}

}  // namespace

std::vector<Metric> ablation_metrics() {
  std::vector<Metric> metrics;
  for (const StepMetric& each : step_metrics()) {
    metrics.push_back(each.metric);
    if (each.metric.name == "largest_residual")
      metrics.insert(metrics.end(), stale_residuals.begin(), stale_residuals.end());
  }
  return metrics;
}

RunRow read_run_row(const std::filesystem::path& folder) {
  const compare::Provenance run = compare::read_manifest(folder).provenance;
  const Rows rows = compare::read_steps(folder).rows;
  RunRow row;
  row.status = run.status.substr(0, run.status.find(':'));
  row.steps = static_cast<std::int64_t>(rows.size());
  for (const StepMetric& each : step_metrics()) {
    row.metrics.push_back(each.over_steps(values_of(rows, each.value)));
    if (each.metric.name == "largest_residual")
      for (const double value : stale_residuals_of(folder)) row.metrics.push_back(value);
  }
  row.guarantee_kept = text_in(run, "guarantee_kept", "not checked");
  row.audited_states = text_in(run, "audited_states", "0");
  row.final_hash = text_in(run, "final_hash", "");
  row.device = run.device;
  row.folder = folder.string();
  return row;
}

MetricRange range_of(const SettingRows& setting, std::size_t metric) {
  std::vector<double> values;
  for (const RunRow& row : setting.rows)
    if (row.status == "finished") values.push_back(row.metrics[metric]);
  if (values.empty() || !std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    return {values.size(), nan, nan, nan};
  return {values.size(), median(values), smallest(values), largest(values)};
}

std::string sentence(const Metric& metric, const SettingRows& one, const MetricRange& a, const SettingRows& other,
                     const MetricRange& b) {
  if (std::isnan(a.median) || std::isnan(b.median)) return "";
  const std::string begin = std::string(metric.name) + ": " + one.name;
  if (is_constant(a) && is_constant(b) && a.smallest == b.smallest)
    return begin + " and " + other.name + " are equal: " + with_unit(a.median, metric) + " in every run";
  if (a.smallest <= b.largest && b.smallest <= a.largest)
    return begin + " and " + other.name + ": no difference is shown, their ranges overlap (" + interval(a, metric) +
           " and " + interval(b, metric) + ")";
  const std::string medians = " (medians " + with_unit(a.median, metric) + " and " + with_unit(b.median, metric) + ")";
  if (a.smallest > 0 && b.smallest > 0)
    return begin + " is " + ratio(a.median / b.median) + " times " + other.name + ", range " +
           ratio(a.smallest / b.largest) + " to " + ratio(a.largest / b.smallest) + medians;
  const bool is_more = a.median > b.median;
  const double nearest = is_more ? a.smallest - b.largest : b.smallest - a.largest,
               farthest = is_more ? a.largest - b.smallest : b.largest - a.smallest;
  return begin + " is " + with_unit(std::abs(a.median - b.median), metric) + (is_more ? " more" : " less") + " than " +
         other.name + ", range " + text(nearest) + " to " + with_unit(farthest, metric) + medians;
}

double apart_by_chance(std::size_t n, std::size_t m) {
  double orders = 1;
  for (std::size_t i = 1; i <= n; ++i) orders *= static_cast<double>(m + i) / static_cast<double>(i);
  return std::min(1.0, 2 / orders);
}

std::vector<std::string> findings(const std::vector<SettingRows>& settings) {
  std::vector<std::string> lines;
  for (const SettingRows& setting : settings) lines.push_back(audit_line(setting));
  const std::vector<Metric> metrics = ablation_metrics();
  double by_chance = 0;
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const MetricRange first = range_of(settings.front(), m);
    for (std::size_t s = 1; s < settings.size(); ++s) {
      const MetricRange range = range_of(settings[s], m);
      const std::string line = sentence(metrics[m], settings[s], range, settings.front(), first);
      if (line.empty()) continue;
      if (range.runs < 2 || first.runs < 2) continue;  // one run has no range
      lines.push_back(line);
      by_chance += apart_by_chance(range.runs, first.runs);
    }
  }
  if (lines.size() == settings.size()) {
    if (settings.size() > 1)
      lines.emplace_back("one run a setting shows no difference: add --repeat 10 --jitter 1e-6 for ranges");
    return lines;
  }
  lines.push_back("by chance alone " + text(by_chance) + " of these sentences would call equal settings different");
  std::vector<std::string> devices;
  for (const SettingRows& setting : settings)
    for (const RunRow& row : setting.rows)
      if (std::ranges::find(devices, row.device) == devices.end()) devices.push_back(row.device);
  if (devices.size() > 1)
    lines.push_back("times were measured on " + std::to_string(devices.size()) +
                    " devices and can't be compared: see the column device of ablation.csv");
  return lines;
}

}  // namespace ogc::experiments
