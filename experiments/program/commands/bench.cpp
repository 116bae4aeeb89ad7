// `ogc bench`: runs Google Benchmark over stages, steps and parts of steps, writes its JSON, and compares two such
// files by rank.
#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "experiments/bench/processes.hpp"
#include "experiments/bench/rank_test.hpp"
#include "experiments/bench/results.hpp"
#include "experiments/bench/scene_benchmarks.hpp"
#include "experiments/bench/stage_benchmarks.hpp"
#include "experiments/bench/worlds_benchmarks.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/version.hpp"
#include "experiments/scenes/registry.hpp"

namespace ogc::experiments {

namespace {

/// Largest number of samples.
constexpr std::uint64_t most_repetitions = 1'000'000;

struct CommandOptions {
  BenchOptions bench;
  std::string filter = ".", backend = "all", json, against, results;
  bool list = false;
  int threads = 0, processes = 8;
};

/// Returns why a run of a benchmark gave no time, or nothing if it did. Google Benchmark names it otherwise since 1.8.
template <typename Run>
std::optional<std::string> failure_of(const Run& run) {
  if constexpr (requires { run.error_occurred; }) {
    return run.error_occurred ? std::optional(run.error_message) : std::nullopt;
  } else {
    return run.skipped ? std::optional(run.skip_message) : std::nullopt;
  }
}

/// Prints one line (median, spread, counters) after the last repetition of a benchmark.
class LineReporter : public benchmark::BenchmarkReporter {
 public:
  explicit LineReporter(std::size_t count) : progress_(0, static_cast<std::int64_t>(count), "benchmark") {}
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<double> times;
    const Run* last = nullptr;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      if (const auto failure = failure_of(run)) {
        failed.push_back(run.benchmark_name() + ": " + *failure);
        continue;
      }
      times.push_back(run.GetAdjustedRealTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit));
      last = &run;
    }
    if (last == nullptr) return;
    std::ranges::sort(times);
    std::string counters;
    for (const auto& [name, counter] : last->counters) counters += "  " + name + " " + number(counter.value);
    progress_.show(++done_, "");
    progress_.end();
    print_result(table({{last->run_name.function_name, duration(median(times)),
                         duration(times.front()) + " to " + duration(times.back()),
                         std::to_string(times.size()) + " repetitions" + counters}},
                       4));
  }

  std::vector<std::string> failed;

 private:
  Progress progress_;
  std::int64_t done_ = 0;
};

/// Counts the benchmarks of a filter, and prints nothing.
std::size_t count_benchmarks(const std::string& filter) {
  std::string program = "ogc", list = "--benchmark_list_tests=true", run = "--benchmark_list_tests=false";
  const auto set = [&](std::string& flag) {
    std::array<char*, 3> words{program.data(), flag.data(), nullptr};
    int count = 2;
    benchmark::Initialize(&count, words.data());
  };
  set(list);
  std::ostringstream nowhere;
  benchmark::ConsoleReporter reporter;
  reporter.SetOutputStream(&nowhere);
  reporter.SetErrorStream(&nowhere);
  const std::size_t count = benchmark::RunSpecifiedBenchmarks(&reporter, nullptr, filter);
  set(run);
  return count;
}

std::vector<fast::Backend> backends_of(const std::string& name) {
  if (name == "cpu") return {fast::Backend::cpu};
  const fast::BackendInfo device = fast::backend_info(fast::Backend::cuda);
  if (name == "cuda" && !device.usable) throw compare::ResourceError("backend cuda: " + device.description);
  if (name == "cuda") return {fast::Backend::cuda};
  return device.usable ? std::vector{fast::Backend::cpu, fast::Backend::cuda} : std::vector{fast::Backend::cpu};
}

void say_context(const CommandOptions& options) {
  const BuildInfo build = build_info();
  benchmark::AddCustomContext("commit", build.commit + (build.dirty ? ", dirty" : ""));
  benchmark::AddCustomContext("compiler", build.compiler);
  benchmark::AddCustomContext("cuda", build.cuda);
  benchmark::AddCustomContext("device_cpu", fast::backend_info(fast::Backend::cpu).description);
  benchmark::AddCustomContext("device_cuda", fast::backend_info(fast::Backend::cuda).description);
  benchmark::AddCustomContext(
      "threads", std::to_string(options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency()));
}

/// Passes the options to Google Benchmark in the form of a command line.
void initialize(const CommandOptions& options) {
  std::vector<std::string> words{"ogc"};
  if (!options.json.empty())
    words.insert(words.end(), {"--benchmark_out=" + options.json, "--benchmark_out_format=json"});
  if (options.list) words.emplace_back("--benchmark_list_tests=true");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
}

void run_benchmarks(const CommandOptions& options) {
  register_stage_benchmarks(options.bench);
  register_scene_benchmarks(options.bench);
  register_worlds_benchmarks(options.bench);
  LineReporter reporter(options.list ? 0 : count_benchmarks(options.filter));
  initialize(options);
  say_context(options);
  const std::size_t found = benchmark::RunSpecifiedBenchmarks(&reporter, nullptr, options.filter);
  if (found == 0)
    throw compare::InputError("--filter " + options.filter + " fits no benchmark; `ogc bench --list` prints all names");
  if (!reporter.failed.empty()) throw std::runtime_error(reporter.failed.front());
}

/// Returns the options of a measurement as words of the command line for a separate process.
std::vector<std::string> words_of(const CommandOptions& options) {
  std::vector<std::string> words{"bench",
                                 "--processes",
                                 "1",
                                 "--filter",
                                 options.filter,
                                 "--backend",
                                 options.backend,
                                 "--scale",
                                 options.bench.scale,
                                 "--steps",
                                 std::to_string(options.bench.steps),
                                 "--repetitions",
                                 std::to_string(options.bench.repetitions)};
  if (options.bench.worlds > 0) words.insert(words.end(), {"--worlds", std::to_string(options.bench.worlds)});
  for (const std::string& state : options.bench.states) words.insert(words.end(), {"--from-state", state});
  if (options.threads > 0) words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  return words;
}

void measure(const CommandOptions& options) {
  if (options.list || options.json.empty() || options.processes == 1) return run_benchmarks(options);
  bench_in_processes(words_of(options), options.processes, options.json);
  std::vector<std::vector<std::string>> rows{{"benchmark", "median", "least", "most"}};
  for (auto& [name, times] : read_results(options.json).times) {
    const auto [least, most] = std::ranges::minmax(times);
    rows.push_back({name, duration(median(times)), duration(least), duration(most)});
  }
  if (options.against.empty()) print_result(table(rows, 1));
}

int bench(CommandOptions options, const CommandContext& context) {
  const auto limit = limited_threads(options.threads);
  parse_scale(options.bench.scale);
  std::optional<BenchResults> before;
  if (!options.against.empty()) before = read_results(options.against);
  if (options.results.empty()) {
    if (before && options.json.empty())
      throw compare::InputError(
          "--against compares two files: name the new one with --json FILE, or a finished one with --results FILE");
    options.bench.backends = backends_of(options.backend);
    measure(options);
    if (options.list || !before) return exit_success;
    options.results = options.json;
  }
  if (!before) throw compare::InputError("--results FILE needs --against FILE to compare with");
  const BenchComparison comparison = compare_results(*before, read_results(options.results));
  if (comparison.changes.empty())
    throw compare::InputError(options.against + " and " + options.results + " have no benchmark in common");
  if (context.json)
    print_result(to_json(comparison));
  else
    print_result(describe(comparison));
  return comparison.has_slower() ? exit_check_failed : exit_success;
}

}  // namespace

void add_bench_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "bench", "Time stages, steps of scenes and their parts; compare two results by a rank test");
  command
      ->add_option("--filter", options->filter,
                   "Only benchmarks whose name matches this regular expression are measured")
      ->capture_default_str();
  command->add_option("--backend", options->backend, "Stages and vbd run on this backend, or on all that are here")
      ->check(CLI::IsMember({"cpu", "cuda", "all"}))
      ->capture_default_str();
  command->add_option("--scale", options->bench.scale, "Scenes have this size: smoke, small or paper")
      ->capture_default_str();
  command
      ->add_option("--from-state", options->bench.states,
                   "Steps begin at this frame of a run (RUN/frames/…) in place of the scenes' starts; repeatable")
      ->take_all()
      ->type_size(1)
      ->expected(1);
  command
      ->add_option("--worlds", options->bench.worlds,
                   "Also measures so many worlds side by side: worlds/N/small_cloth, worlds/N/SCENE/SCALE")
      ->check(whole_number(1, most_worlds));
  command->add_option("--steps", options->bench.steps, "A repetition measures a window of so many steps")
      ->check(whole_number(1, most_counted))
      ->capture_default_str();
  command->add_option("--repetitions", options->bench.repetitions, "A process repeats each benchmark so often")
      ->check(whole_number(1, most_repetitions))
      ->capture_default_str();
  command
      ->add_option("--processes", options->processes,
                   "With --json: so many processes measure, one after the other; each is one sample of a comparison")
      ->check(whole_number(1, most_repetitions))
      ->capture_default_str();
  add_threads_option(*command, options->threads);
  command->add_flag("--list", options->list, "Print the names and stop");
  command->add_option("--json", options->json,
                      "This file gets the result in the format of Google Benchmark, with every repetition, counters, "
                      "machine and commit");
  command->add_option(
      "--against", options->against,
      "The result is compared with this earlier file; exit status 1 says that something is slower beyond noise");
  command->add_option("--results", options->results,
                      "With --against: this finished file is compared, and nothing is measured");
  command->add_flag("--json-changes", context.json, "Print the comparison as JSON on standard output");
  command->footer(
      "Examples:\n"
      "  ogc bench --filter 'step/twist' --scale smoke\n"
      "  ogc bench --filter 'stage/.*/cpu' --json before.json\n"
      "  ogc bench --filter 'stage/.*/cpu' --json after.json --against before.json\n"
      "  ogc bench --worlds 1024 --filter small_cloth --backend cuda\n"
      "  ogc bench --from-state runs/twist/frames/frame_001200.h5 --steps 64 --backend cuda\n\n"
      "Names: stage/STAGE/BACKEND (a batch of the judge's cases, on a device with its transfers), "
      "step/SCENE/SCALE/BACKEND (resident, as in steps.csv),\n"
      "part/PART/SCENE/SCALE/BACKEND (as run --profile). Counters of steps and of part/sweep: flop and bytes a step as "
      "counted from the source (fast/work.cpp),\n"
      "floor_ms and share_of_floor on machines whose limits are known (experiments/bench/floor.hpp): a share of 1\n"
      "would be the least time in which this design can do that work, with its idle lanes, sectors of memory and "
      "launches.\n"
      "Noise is judged between processes, because repetitions of one share what its start decided: two-sided "
      "Mann-Whitney on the processes' medians, corrected by\n"
      "Holm over all benchmarks compared, significant below 0.01; percentages decide nothing. With N benchmarks "
      "compared, 8 processes on either side can show a\n"
      "change where N is at most 64. A machine that is busy in one of two measurements has changed, and the test will "
      "say so.");
  command->callback([options, &context] { context.status = bench(*options, context); });
}

}  // namespace ogc::experiments
