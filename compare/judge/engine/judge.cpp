// Judges stages with several threads. Threads take batches in ascending order and merge results in the same order, so
// the number of threads affects neither cases nor sums.
//
// The number of batches that a mesh stage needs is unknown at the start. Merging stops when the wanted number of cases
// is reached; batches beyond it are discarded. To discard few, threads do not begin batches far ahead of the merged
// ones. Otherwise a contestant that answers one thread at a time would spend its time on unneeded batches while the
// next batch to merge waits.
#include "compare/judge/engine/judge.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <thread>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/cases/states.hpp"
#include "compare/judge/engine/asked.hpp"
#include "compare/judge/engine/narrow.hpp"

namespace ogc::compare {

namespace {

// Code that wraps a contestant stage by stage uses visit_stages, which must therefore visit every stage of the judge's
// list.
static_assert([] {
  std::size_t count = 0;
  visit_stages([&](const char*, auto) { ++count; });
  return count == stage_count;
}());

// Number of meshes in one batch. Generators of large meshes (Generator::least > 0) have batches of one mesh.
constexpr std::uint64_t mesh_batch = 4;

/// Runs one generator in batches of consecutive indices until it has counted `cases` cases.
class GeneratorRun {
 public:
  GeneratorRun(Stage stage, const Generator& generator, std::uint64_t cases, const Contestant& contestant,
               const Authority& authority, const JudgeOptions& options)
      : stage_(stage),
        generator_(generator),
        wanted_(cases),
        contestant_(contestant),
        authority_(authority),
        options_(options),
        merged_(stage) {
    if (!is_mesh_stage(stage)) batches_ = (cases + options.batch - 1) / options.batch;
  }

  Tally run(std::uint64_t cases_before, std::uint64_t mismatches_before) {
    cases_before_ = cases_before;
    mismatches_before_ = mismatches_before;
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < options_.threads; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(merged_);
  }

 private:
  std::vector<TestCase> batch(std::uint64_t number) const {
    const std::uint64_t size = !is_mesh_stage(stage_) ? options_.batch : generator_.least > 0 ? 1 : mesh_batch;
    const std::uint64_t first = number * size,
                        last = is_mesh_stage(stage_) ? first + size : std::min(first + size, wanted_);
    std::vector<TestCase> cases;
    cases.reserve(first < last ? last - first : 0);
    const std::string states = generator_.make ? "" : options_.states->folder();
    for (std::uint64_t i = first; i < last; ++i)
      cases.push_back(
          generate(generator_, {stage_, std::string(generator_.name), options_.seed, i, states, {}}, options_.states));
    return cases;
  }

  void work() {
    for (;;) {
      std::uint64_t number = 0;
      {
        std::unique_lock lock(mutex_);
        may_go_on_.wait(lock, [this] { return is_over() || next_ < merged_count_ + ahead(); });
        if (is_over()) return;
        number = next_++;
      }
      try {
        Tally tally(stage_);
        const std::vector<TestCase> cases = batch(number);
        ask_narrowing(stage_, cases, contestant_, authority_, contestant_turn_, failures_allowed, tally);
        tally.questions = cases.size();
        merge(number, std::move(tally));
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        stopped_ = true;
        may_go_on_.notify_all();
      }
    }
  }

  bool is_over() const { return stopped_ || next_ == batches_; }

  /// Returns how many batches beyond the merged ones may be begun: four per thread, except in mesh stages. A mesh stage
  /// begins as many as it still needs, estimated from the cases of the merged batches, but at most one per thread.
  std::uint64_t ahead() const {
    if (!is_mesh_stage(stage_)) return 4 * options_.threads;
    if (merged_count_ == 0) return options_.threads;
    const std::uint64_t cases = merged_.total().cases, missing = wanted_ > cases ? wanted_ - cases : 0;
    const std::uint64_t batches = cases == 0 ? options_.threads : (missing * merged_count_ + cases - 1) / cases;
    return std::clamp<std::uint64_t>(batches, 1, options_.threads);
  }

  void merge(std::uint64_t number, Tally tally) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(number, std::move(tally));
    for (auto it = waiting_.find(merged_count_); it != waiting_.end() && !stopped_; it = waiting_.find(merged_count_)) {
      merged_.add(it->second);
      waiting_.erase(it);
      ++merged_count_;
      // This also stops a generator whose meshes are all empty, which would never reach the wanted number of cases.
      stopped_ = merged_.total().cases >= wanted_ || merged_count_ > wanted_ || merged_.failures >= failures_allowed;
    }
    may_go_on_.notify_all();
    if (options_.progress)
      options_.progress(cases_before_ + merged_.total().cases, mismatches_before_ + merged_.mismatched);
  }

  Stage stage_;
  const Generator& generator_;
  std::uint64_t wanted_;
  std::uint64_t batches_ = std::numeric_limits<std::uint64_t>::max();  ///< unknown for a mesh stage
  const Contestant& contestant_;
  const Authority& authority_;
  const JudgeOptions& options_;
  std::uint64_t cases_before_ = 0, mismatches_before_ = 0;
  std::mutex mutex_, contestant_turn_;
  std::condition_variable may_go_on_;
  std::uint64_t next_ = 0, merged_count_ = 0;
  std::map<std::uint64_t, Tally> waiting_;
  Tally merged_;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

bool has_stage(const Contestant& contestant, Stage stage) {
  bool has = false;
  visit_stages([&](const char* name, auto member) { has = has || (stage_name(stage) == name && contestant.*member); });
  return has;
}

/// Returns the generators to run, with their shares.
std::vector<Generator> chosen(Stage stage, const Contestant& contestant, const JudgeOptions& options) {
  if (!options.generator.empty()) return {find_generator(stage, options.generator)};
  std::vector<Generator> rows(generators(stage).begin(), generators(stage).end());
  std::erase_if(rows,
                [&](const Generator& row) { return row.least > options.cases || !is_asked(contestant, stage, row); });
  if (options.states && options.states->missing(stage).empty())
    for (const std::string_view name : {"states", "mutated"}) rows.push_back(find_generator(stage, name));
  return rows;
}

}  // namespace

bool is_asked(const Contestant& contestant, Stage stage, const Generator& generator) {
  const bool is_step_with_planes = stage == Stage::step && generator.also_needs == Stage::plane,
             has_volumes = generator.also_needs == Stage::volume_depth,
             has_rods = generator.also_needs == Stage::orientation;
  return (!generator.also_needs || has_stage(contestant, *generator.also_needs)) &&
         (!is_step_with_planes || contestant.has_steps_with_planes) && (!has_volumes || contestant.has_volumes) &&
         (!has_rods || contestant.has_rods) && (!generator.has_cavities || contestant.has_cavities) &&
         (!generator.divides || contestant.divides_by_approach);
}

bool StageReport::passed() const {
  return !skipped && tally.mismatched == 0 && tally.total().cases > 0 && tally.grey_within_limit();
}

bool can_judge(Stage stage, const Contestant& contestant, const Authority& authority) {
  return traits_of(stage).can_judge(contestant, authority);
}

StageReport judge_stage(Stage stage, const Contestant& contestant, const Authority& authority,
                        const JudgeOptions& options) {
  StageReport report{Tally(stage)};
  if (!can_judge(stage, contestant, authority)) {
    report.skipped = true;
    return report;
  }
  if (options.states)
    if (const std::string why = options.states->missing(stage); !why.empty())
      report.note = "no states of " + options.states->folder() + ": " + why;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Generator> rows = chosen(stage, contestant, options);
  double shares = 0;
  for (const Generator& row : rows) shares += row.share;
  for (const Generator& row : rows) {
    const auto cases = static_cast<std::uint64_t>(std::ceil(static_cast<double>(options.cases) * row.share / shares));
    GeneratorRun run(stage, row, cases, contestant, authority, options);
    report.tally.add(run.run(report.tally.total().cases, report.tally.mismatched));
    if (report.tally.failures >= failures_allowed) break;
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::vector<StageReport> judge_cases(std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority) {
  std::vector<StageReport> reports;
  std::mutex turn;
  for (const Stage stage : all_stages) {
    std::vector<TestCase> mine;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(mine),
                 [&](const TestCase& test) { return test.name.stage == stage; });
    if (mine.empty()) continue;
    StageReport report{Tally(stage)};
    const auto start = std::chrono::steady_clock::now();
    report.skipped = !can_judge(stage, contestant, authority);
    if (!report.skipped) ask_narrowing(stage, mine, contestant, authority, turn, failures_allowed, report.tally);
    report.tally.questions = mine.size();
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace ogc::compare
