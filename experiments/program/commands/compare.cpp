// `ogc compare`: judges stages of the fast path or of a plug-in against the reference: on generated cases, real states,
// single problems and saved failures.
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/corpus.hpp"
#include "compare/judge/report/page.hpp"
#include "compare/judge/report/report.hpp"
#include "compare/problem/error.hpp"
#include "experiments/plugins/contestant.hpp"
#include "experiments/plugins/report.hpp"
#include "experiments/plugins/table.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/failures.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/stage_list.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::InputError;
using compare::Stage;
using compare::StageReport;

// Largest number of mismatches printed for each generator, so that a generator that always fails does not hide the
// others.
constexpr std::size_t printed_mismatches = 3;
// Largest number of cases. At 10⁷ cases per second they would take more than a day.
constexpr std::uint64_t most_cases = 1'000'000'000'000;

struct CompareOptions {
  std::vector<std::string> stages;
  std::string backend = "cpu", generator, states, problem, batch, replay, report, plugin;
  std::uint64_t cases = 100000, seed = 1;
  unsigned time_limit = 10;
  bool list = false, markdown = false, determinism = false;
};

fast::Backend backend_of(const std::string& name) {
  if (name == "cpu") return fast::Backend::cpu;
  if (name == "cuda") return fast::Backend::cuda;
  throw InputError("--backend " + name + ": there is no such backend; known: cpu, cuda");
}

/// Holds the contestant under test: our backend, or a plug-in beside which our backend is timed.
struct Judged {
  compare::Contestant contestant;
  std::shared_ptr<PluginProcess> plugin;  ///< null without a plug-in
  std::shared_ptr<Times> times = std::make_shared<Times>();
  std::string backend;
};

Judged judged_of(const CompareOptions& options) {
  Judged judged{fast::contestant(backend_of(options.backend)), nullptr, std::make_shared<Times>(), options.backend};
  if (options.plugin.empty()) return judged;
  PluginOptions plugin;
  plugin.file = options.plugin;
  plugin.limit_seconds = options.time_limit;
  judged.plugin = std::make_shared<PluginProcess>(plugin);
  judged.contestant = timed_beside(plugin_contestant(judged.plugin), judged.contestant, judged.times);
  return judged;
}

/// Selects all stages of the plug-in if no stage is named. Throws InputError if the plug-in lacks a named stage, or has
/// none at all.
void choose_stages_of_plugin(CompareOptions& options, const Judged& judged) {
  if (judged.plugin->offered().empty())
    throw InputError(options.plugin +
                     ": it has no stage's function; write one, such as ogc_truncate (compare/plugin.h)");
  for (const std::string& name : options.stages)
    if (compare::find_stage(name) && !judged.plugin->has(name))
      throw InputError(options.plugin + ": " + judged.plugin->missing(name));
  if (!options.stages.empty()) return;
  for (const Stage stage : compare::all_stages)
    if (judged.plugin->has(compare::stage_name(stage))) options.stages.emplace_back(compare::stage_name(stage));
}

/// Returns the requested stages in the order of all_stages. If no stage is named, returns all stages that the
/// generators, the contestant and the reference have.
std::vector<Stage> stages_of(const CompareOptions& options) {
  std::vector<Stage> stages;
  for (const std::string& name : options.stages) {
    const auto stage = compare::find_stage(name);
    if (!stage) {
      std::string known;
      for (const Stage s : compare::all_stages)
        known += (known.empty() ? "" : ", ") + std::string(compare::stage_name(s));
      throw InputError("there is no stage '" + name + "'; known: " + known);
    }
    stages.push_back(*stage);
  }
  if (stages.empty()) stages.assign(compare::all_stages.begin(), compare::all_stages.end());
  for (const Stage stage : stages)
    if (!options.generator.empty()) compare::find_generator(stage, options.generator);
  return stages;
}

/// Throws InputError if the contestant or the reference lacks a named stage.
void check_stages(const CompareOptions& options, const Judged& judged, const compare::Authority& authority) {
  if (options.stages.empty()) return;
  for (const Stage stage : stages_of(options))
    if (!compare::can_judge(stage, judged.contestant, authority))
      throw InputError("the fast path does not have the stage " + std::string(compare::stage_name(stage)) +
                       "; a kernel of your own may: --plugin FILE (compare/plugin.h)");
}

/// Returns the cases that the command line names one by one: --problem, --batch, --replay.
std::vector<compare::TestCase> given_cases(const CompareOptions& options, OpenStates& states) {
  std::vector<compare::TestCase> cases;
  if (!options.replay.empty()) cases.push_back(compare::load_case(options.replay));
  std::vector<compare::CaseName> names;
  if (!options.batch.empty()) names = compare::load_batch(options.batch);
  if (!options.problem.empty()) names.push_back(compare::parse_problem(options.problem));
  for (const compare::CaseName& name : names) cases.push_back(compare::generate(name, states.of(name.states)));
  return cases;
}

std::vector<StageReport> judge_generated(const CompareOptions& options, OpenStates& states,
                                         const compare::Contestant& contestant, const compare::Authority& authority) {
  std::vector<StageReport> reports;
  for (const Stage stage : stages_of(options)) {
    const std::string name(compare::stage_name(stage));
    Progress progress(0, static_cast<std::int64_t>(options.cases), name + " case");
    compare::JudgeOptions judge;
    judge.cases = options.cases;
    judge.seed = options.seed;
    judge.generator = options.generator;
    judge.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
    judge.states = states.of(options.states);
    judge.progress = [&](std::uint64_t done, std::uint64_t mismatches) {
      progress.show(static_cast<std::int64_t>(std::min(done, options.cases)),
                    std::to_string(mismatches) + " mismatches");
    };
    reports.push_back(compare::judge_stage(stage, contestant, authority, judge));
    progress.end();
  }
  return reports;
}

void write_report(const std::filesystem::path& folder, const std::vector<StageReport>& reports,
                  const std::string& judged) {
  std::string lines;
  for (const StageReport& report : reports) lines += compare::report_json(report).dump() + "\n";
  compare::write_bytes(folder / "report.jsonl", lines);
  compare::write_bytes(folder / "report.txt", compare::report_table(reports));
  compare::write_bytes(folder / "report.html", compare::report_page(reports, judged + " against the reference"));
}

int list_stages(const CompareOptions& options, const CommandContext& context) {
  if (context.json)
    print_result(Json{{"stages", stage_list_json()}, {"plugin", plugin_table()}});
  else
    print_result(options.markdown ? stage_list_markdown() : stage_list_text());
  return exit_success;
}

/// Checks whether bits are repeatable, not whether they are right (--determinism).
int judge_bits(const CompareOptions& options, const CommandContext& context) {
  const auto reports = determinism_of(backend_of(options.backend), stages_of(options), options.cases, options.seed);
  if (context.json)
    print_result(Json{{"backend", options.backend}, {"stages", determinism_json(reports)}});
  else
    print_result(compare::determinism_table(reports));
  return std::all_of(reports.begin(), reports.end(), [](const auto& report) { return report.changed.empty(); })
             ? exit_success
             : exit_check_failed;
}

void print_reports(const std::vector<StageReport>& reports, const std::optional<PluginSeen>& plugin,
                   const std::vector<std::string>& saved, const std::vector<compare::Explanation>& explanations,
                   const CommandContext& context) {
  if (context.json) {
    Json all = Json::array(), explained = Json::array();
    for (const StageReport& report : reports) all.push_back(compare::report_json(report));
    for (const compare::Explanation& explanation : explanations)
      explained.push_back(compare::explanation_json(explanation));
    Json result{{"stages", all}, {"explained", explained}, {"saved", saved}};
    if (plugin) result["plugin"] = plugin_json(*plugin, reports);
    print_result(result);
    return;
  }
  std::string text = compare::report_table(reports);
  if (plugin) text += "\n" + plugin_text(*plugin, reports);
  for (const StageReport& report : reports)
    if (report.tally.mismatched > 0) text += "\n" + compare::report_mismatches(report, printed_mismatches);
  for (const compare::Explanation& explanation : explanations) text += "\n" + compare::explanation_text(explanation);
  if (!saved.empty())
    text += "\n" + counted(saved.size(), "failing case") + " saved; replay one with: ogc compare --replay " +
            saved.front() + "\n";
  print_result(text);
}

int run_compare(CompareOptions options, const CommandContext& context) {
  if (options.list) return list_stages(options, context);
  if (!options.report.empty())
    // The folder is created first, so that a wrong path is reported before the cases are judged.
    std::filesystem::create_directories(options.report);
  if (options.determinism) return judge_bits(options, context);
  const Judged judged = judged_of(options);
  if (judged.plugin) choose_stages_of_plugin(options, judged);
  const compare::Authority authority = reference::authority();
  if (!judged.plugin) check_stages(options, judged, authority);
  OpenStates states(authority);
  const bool is_given = !options.problem.empty() || !options.batch.empty() || !options.replay.empty();
  const std::vector<compare::TestCase> given = given_cases(options, states);
  if (is_given && given.empty())
    throw InputError(options.batch + ": holds no problem; write one problem string a line");
  std::vector<StageReport> reports = is_given ? compare::judge_cases(given, judged.contestant, authority)
                                              : judge_generated(options, states, judged.contestant, authority);
  if (judged.plugin)  // the judge's times include the transfer of the question and our backend's answer
    for (StageReport& report : reports)
      report.tally.contestant_seconds = judged.plugin->seconds(compare::stage_name(report.tally.stage));
  std::optional<PluginSeen> plugin;
  if (judged.plugin) plugin = PluginSeen{judged.plugin->name(), judged.backend, *judged.times, judged.plugin->notes()};
  const std::filesystem::path folder = options.report.empty() ? "ogc-compare" : options.report;
  std::vector<std::string> saved;
  Failures failures(judged.contestant, authority, states, given);
  failures.explain_given(reports);
  if (options.replay.empty()) saved = failures.save(reports, folder / "failures");
  failures.diagnose(reports, options.seed);
  if (!options.report.empty()) write_report(folder, reports, judged.plugin ? judged.plugin->name() : options.backend);
  print_reports(reports, plugin, saved, failures.explanations(), context);
  bool any = false, passed = true;
  for (const StageReport& report : reports) {
    any |= !report.skipped;
    passed &= report.skipped ? options.stages.empty() : report.passed();
  }
  return any && passed ? exit_success : exit_check_failed;
}

std::string all_stage_names() {
  std::string names;
  for (const Stage stage : compare::all_stages)
    names += (names.empty() ? "" : ", ") + std::string(compare::stage_name(stage));
  return names;
}

}  // namespace

void add_compare_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "Differential test of the fast stages against the exact reference");
  command->add_option("STAGE", options->stages,
                      all_stage_names() + "; without a name, all stages that both sides have");
  command->add_option("--backend", options->backend, "The judged kernels run on cpu or cuda")->capture_default_str();
  command
      ->add_option(
          "--cases", options->cases,
          "A stage gets so many cases; of a mesh each vertex or edge is a case, of a step each vertex at an event")
      ->capture_default_str()
      ->check(whole_number(1, most_cases));
  command->add_option("--seed", options->seed, "Generators draw their cases by this seed")
      ->capture_default_str()
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command->add_option("--generator", options->generator,
                      "Only this generator makes cases: uniform, ladder.parallel, … (a wrong name lists them)");
  command->add_option("--states", options->states, "Frames of this run folder become cases, too");
  auto* problem = command->add_option("--problem", options->problem,
                                      "This one case is asked and told whole, with its inputs by name and unit and "
                                      "both answers; messages print its problem string");
  auto* batch = command->add_option("--batch", options->batch,
                                    "This file has one problem string a line, each of which is asked");
  auto* replay = command->add_option("--replay", options->replay,
                                     "This saved case is asked again, shrunk as it was saved and with every bit");
  problem->excludes(replay);
  batch->excludes(replay);
  command->add_option("--plugin", options->plugin,
                      "This shared library (compare/plugin.h) or Python file has your kernels, which are judged in "
                      "place of ours and timed beside them");
  command
      ->add_option("--time-limit", options->time_limit,
                   "A call of a plug-in may take so many seconds, and a tenth of that once a call hung")
      ->capture_default_str()
      ->check(whole_number(1, 3600));
  command->add_option("--report", options->report,
                      "report.html, report.jsonl, report.txt and failures/ go into this folder (without it failures go "
                      "to ogc-compare/failures)");
  command->add_flag("--determinism", options->determinism,
                    "The backend alone is asked whether it gives the same bits again, shuffled, in small batches and "
                    "with other numbers of threads; digests of two machines or builds may be compared");
  auto* list = command->add_flag(
      "--list", options->list,
      "Print all stages with their questions, generators and parameters; with --json also the "
      "structures of compare/plugin.h");
  command->add_flag("--markdown", options->markdown, "With --list: print the table of compare/README.md")->needs(list);
  command->add_flag("--json", context.json, "Print the result as JSON on standard output");
  command->footer(
      "Discrete answers must be equal outside the grey zone, bounds never too large, errors within the tolerances of "
      "compare/stages.\n"
      "Exit status 1: a mismatch, too many grey decisions, or a plug-in that crashes, hangs or writes out of range.\n"
      "The first failing case of each stage is told whole, and where the failures are a mistake that is known by name, "
      "it is named:\n"
      "\"your answer equals `half_logarithm`\".\n\n"
      "Examples:\n"
      "  ogc compare --cases 1000000\n"
      "  ogc compare closest_face truncate --backend cuda --report reports/cuda\n"
      "  ogc compare truncate --plugin ./mine.so\n"
      "  ogc compare truncate --plugin mine.py\n"
      "  ogc compare --problem \"stage=detect_edge_edge gen=few seed=7 index=12 r=2e-3 r_q=4e-3\"\n"
      "  ogc compare --determinism --backend cuda --json");
  command->callback([options, &context] { context.status = run_compare(*options, context); });
}

}  // namespace ogc::experiments
