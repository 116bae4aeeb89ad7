#include "experiments/bench/results.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/files/json_reader.hpp"
#include "compare/problem/error.hpp"
#include "experiments/bench/rank_test.hpp"

namespace ogc::experiments {

namespace {

using Verdict = BenchChange::Verdict;

constexpr std::array<std::string_view, 4> verdict_names{"faster", "slower", "no change found", "too few samples"};

std::string verdict_name(Verdict verdict) { return std::string(verdict_names[static_cast<std::size_t>(verdict)]); }

/// Returns a benchmark's name without the components that describe how it was measured.
std::string plain_name(const std::string& name) {
  std::string plain;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find('/', begin + 1), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (!part.starts_with("/repeats:") && !part.starts_with("/min_time:") && part != "/manual_time" &&
        part != "/real_time")
      plain += part;
    begin = end;
  }
  return plain;
}

/// Replaces NaN by null, because JSON has no NaN. Google Benchmark prints NaN as the relative spread of times that are
/// all 0.
std::string without_nan(std::string text) {
  for (std::size_t at = 0; (at = text.find(": NaN", at)) != std::string::npos;) text.replace(at, 5, ": null");
  return text;
}

double nanoseconds_in(const std::string& unit) {
  return unit == "s" ? 1e9 : unit == "ms" ? 1e6 : unit == "us" ? 1e3 : 1;
}

Verdict verdict_of(const BenchChange& change, double correction) {
  if (change.probability < significance) return change.ratio > 1 ? Verdict::slower : Verdict::faster;
  const bool can_be = smallest_probability(change.samples_before, change.samples_after) * correction < significance;
  return can_be ? Verdict::none_found : Verdict::too_few;
}

}  // namespace

Json parse_results(const std::filesystem::path& file) {
  try {
    Json json = compare::parse_json(without_nan(compare::read_bytes(file)), file.string());
    if (json.at("benchmarks").is_array() && json.at("context").is_object()) return json;
  } catch (const compare::InputError& error) {
    throw compare::InputError(std::string(error.what()) +
                              ": not a result of `ogc bench --json FILE`; name another file");
  } catch (const Json::exception& error) {
    throw compare::InputError(file.string() + ": " + error.what() +
                              ": not a result of `ogc bench --json FILE`; name another file");
  }
  throw compare::InputError(file.string() + ": not a result of `ogc bench --json FILE`; name another file");
}

BenchResults read_results(const std::filesystem::path& file) {
  BenchResults results;
  const Json json = parse_results(file);
  std::map<std::string, std::map<int, std::vector<double>>> by_process;
  try {
    for (const Json& run : json.at("benchmarks")) {
      if (run.at("run_type") != "iteration" || run.contains("error_occurred")) continue;
      const int process = run.value("process", 0);
      results.processes = std::max(results.processes, process + 1);
      by_process[plain_name(run.at("run_name"))][process].push_back(run.at("real_time").get<double>() *
                                                                    nanoseconds_in(run.at("time_unit")));
    }
    for (const auto& [key, value] : json.at("context").items())
      if (value.is_string()) results.context[key] = value;
  } catch (const Json::exception& error) {
    throw compare::InputError(file.string() + ": " + error.what() + ": the file was changed by hand; measure again");
  }
  if (by_process.empty())
    throw compare::InputError(file.string() + ": holds no measurement; run `ogc bench --json FILE` again");
  for (const auto& [name, processes] : by_process)
    for (const auto& [process, times] : processes) {
      if (results.processes == 1)
        results.times[name] = times;
      else
        results.times[name].push_back(median(times));
    }
  return results;
}

bool BenchComparison::has_slower() const {
  return std::ranges::any_of(changes, [](const BenchChange& change) { return change.verdict == Verdict::slower; });
}

BenchComparison compare_results(const BenchResults& before, const BenchResults& after) {
  BenchComparison comparison;
  comparison.is_of_processes = before.processes > 1 && after.processes > 1;
  std::vector<double> probabilities;
  for (const auto& [name, times] : before.times) {
    const auto found = after.times.find(name);
    if (found == after.times.end()) {
      comparison.only_before.push_back(name);
      continue;
    }
    comparison.changes.push_back({name,
                                  times.size(),
                                  found->second.size(),
                                  median(times),
                                  median(found->second),
                                  typical_ratio(times, found->second),
                                  1,
                                  {}});
    probabilities.push_back(mann_whitney(times, found->second));
  }
  for (const auto& [name, times] : after.times)
    if (!before.times.contains(name)) comparison.only_after.push_back(name);
  const std::vector<double> corrected = holm(probabilities);
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    comparison.changes[i].probability = corrected[i];
    comparison.changes[i].verdict = verdict_of(comparison.changes[i], static_cast<double>(corrected.size()));
  }
  for (const std::string key : {"device_cpu", "device_cuda", "compiler", "cuda", "threads"}) {
    const auto first = before.context.find(key), second = after.context.find(key);
    const std::string was = first == before.context.end() ? "none" : first->second,
                      is = second == after.context.end() ? "none" : second->second;
    if (was != is) comparison.differing_context.push_back(key + ": " + was + ", then " + is);
  }
  return comparison;
}

std::string duration(double nanoseconds) {
  constexpr std::array<std::pair<double, const char*>, 4> units{{{1e9, " s"}, {1e6, " ms"}, {1e3, " us"}, {1, " ns"}}};
  for (const auto& [size, name] : units)
    if (nanoseconds >= size) return number(nanoseconds / size) + name;
  return number(nanoseconds) + " ns";
}

std::string describe(const BenchComparison& comparison) {
  std::string text;
  for (const std::string& line : comparison.differing_context)
    text += "measured under other conditions: " + line + "\n";
  std::vector<std::vector<std::string>> rows{{"benchmark", "before", "after", "after/before", "p", "n", "verdict"}};
  for (const BenchChange& change : comparison.changes)
    rows.push_back({change.name, duration(change.before_ns), duration(change.after_ns), number(change.ratio, 4),
                    number(change.probability, 2),
                    std::to_string(change.samples_before) + "+" + std::to_string(change.samples_after),
                    verdict_name(change.verdict)});
  text += table(rows, 1);
  for (const std::string& name : comparison.only_before) text += "only before: " + name + "\n";
  for (const std::string& name : comparison.only_after) text += "only after: " + name + "\n";
  if (!comparison.is_of_processes)
    text +=
        "Samples are repetitions inside one process: what differs from start to start (placement of memory) looks like "
        "a change. Measure with --processes 8.\n";
  return text +
         "before, after: medians of the samples, which are the processes' medians. after/before: median of all "
         "quotients. p: Mann-Whitney, two-sided, corrected by Holm for " +
         counted(comparison.changes.size(), "comparison") + ";\na change is one below " + number(significance) +
         ". Measure both files on one machine that does nothing else.\n";
}

Json to_json(const BenchComparison& comparison) {
  Json json{{"significance", significance}, {"test", "Mann-Whitney, two-sided, corrected by Holm"}};
  json["changes"] = Json::array();
  for (const BenchChange& change : comparison.changes)
    json["changes"].push_back({{"name", change.name},
                               {"before_ns", change.before_ns},
                               {"after_ns", change.after_ns},
                               {"ratio", change.ratio},
                               {"probability", change.probability},
                               {"samples", {change.samples_before, change.samples_after}},
                               {"verdict", verdict_name(change.verdict)}});
  json["samples_are_processes"] = comparison.is_of_processes;
  json["only_before"] = comparison.only_before;
  json["only_after"] = comparison.only_after;
  json["differing_context"] = comparison.differing_context;
  return json;
}

}  // namespace ogc::experiments
