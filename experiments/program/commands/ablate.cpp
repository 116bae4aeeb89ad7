// `ogc ablate`: runs a grid of settings, each point from several jittered starts if requested. Writes a folder for each
// run, a table of all runs, medians and ranges, and sentences that compare the settings.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include <nlohmann/json.hpp>

#include "compare/files/durable_file.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/interrupt.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/own_process.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/runs/ablation_grid.hpp"
#include "experiments/program/runs/ablation_table.hpp"
#include "experiments/program/runs/resume.hpp"
#include "experiments/program/version.hpp"

namespace ogc::experiments {

namespace {

constexpr std::int64_t most_repeats = 1000, most_jobs = 1024;
/// The value of --only if it is not given.
constexpr std::int64_t every_run = -1;

struct AblateOptions {
  std::shared_ptr<RunOptions> run = std::make_shared<RunOptions>();
  std::vector<std::string> vary, points;  ///< as typed
  std::int64_t repeat = 1;
  std::int64_t only = every_run;  ///< index of the only run to make
  std::int64_t jobs = 1;          ///< number of runs at the same time
  bool slurm = false;
};

/// Returns the options of one run at a point. The keys `solver` and `backend` are options; all other keys are settings.
/// `repeat`: number of the run at this point.
RunOptions options_at(const AblateOptions& ablation, const RunOptions& base, const std::vector<Axis>& axes,
                      const Point& point, std::int64_t repeat) {
  RunOptions options = base;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (point[i].empty()) continue;
    if (axes[i].key == "solver")
      options.solver = point[i];
    else if (axes[i].key == "backend")
      options.backend = point[i];
    else
      options.assignments.push_back(axes[i].key + "=" + point[i]);
  }
  options.jitter.seed = base.jitter.seed + static_cast<std::uint64_t>(repeat);
  options.out = base.out + "/" + name_of(axes, point);
  if (ablation.repeat > 1) options.out += ",seed=" + std::to_string(options.jitter.seed);
  return options;
}

void check_repeats(const AblateOptions& options) {
  const Jitter& jitter = options.run->jitter;
  if (options.repeat > 1 && jitter.largest == 0)
    throw compare::InputError("--repeat " + std::to_string(options.repeat) +
                              " without --jitter would compute the same bits so many times: add --jitter METRES, far "
                              "below contact_radius, for example --jitter 1e-6");
  if (jitter.seed > std::numeric_limits<std::uint64_t>::max() - static_cast<std::uint64_t>(options.repeat))
    throw compare::InputError("--seed " + std::to_string(jitter.seed) + " leaves no " + std::to_string(options.repeat) +
                              " seeds after it; give a smaller one");
}

/// Holds one run of the grid.
struct PlannedRun {
  std::size_t setting = 0;  ///< index of the run's point
  std::uint64_t seed = 0;
  RunOptions options;
};

/// Returns the runs ordered by seed, then by setting. A temporary slowdown of the machine then affects all settings,
/// and an interrupted grid has about as many runs of each setting.
std::vector<PlannedRun> planned_runs(const AblateOptions& options, const RunOptions& base,
                                     const std::vector<Axis>& axes, const std::vector<Point>& points) {
  std::vector<PlannedRun> runs;
  for (std::int64_t repeat = 0; repeat < options.repeat; ++repeat)
    for (std::size_t p = 0; p < points.size(); ++p) {
      RunOptions at = options_at(options, base, axes, points[p], repeat);
      const std::uint64_t seed = at.jitter.seed;
      runs.push_back({p, seed, std::move(at)});
    }
  return runs;
}

/// Returns the scene that this run stores in its folder.
compare::Scene stored_scene(const RunRequest& request) {
  compare::Scene scene = request.scene;
  compare::round_to_single(scene);
  clear_dust(scene);
  return scene;
}

/// Throws compare::InputError if a point's scene can't be run.
void check_scene(const RunRequest& request, const std::string& name) {
  const std::string problems = compare::describe(
      compare::validate(stored_scene(request), 10, compare::ElementNames(request.scene, request.sources)));
  if (!problems.empty()) throw compare::InputError("the point " + name + " can't be run:\n" + problems);
}

/// Throws compare::InputError if the folder holds a run of another experiment or program, because a continued grid must
/// not mix them.
void check_same_question(const compare::RunReader& run, const RunRequest& request) {
  const compare::Provenance& theirs = run.provenance();
  const BuildInfo build = build_info();
  const std::string folder = request.folder.string();
  const auto same = [&](const std::string& what, const std::string& there, const std::string& here) {
    if (there != here)
      throw compare::InputError(folder + ": holds a run with another " + what + " (" +
                                (there.empty() ? "none" : there) + ", asked for: " + (here.empty() ? "none" : here) +
                                "); an ablation goes on with its own runs alone: give another --out");
  };
  const auto yes = [](bool value) { return std::string(value ? "yes" : "no"); };
  const bool jittered = request.jitter.largest > 0;
  same("commit", theirs.commit, build.commit);
  same("compiler", theirs.compiler, build.compiler);
  same("state of the sources (uncommitted changes)", yes(theirs.dirty), yes(build.dirty));
  same("solver", theirs.solver, request.solver);
  same("backend", theirs.backend, request.backend);
  same("--scale", text_in(theirs, "scale"), request.scale);
  same("--audit", text_in(theirs, "audit"), name_of(request.audit));
  same("--audit-meetings", text_in(theirs, "meetings"), request.meetings ? text_of(*request.meetings) : "");
  same("--iterations", text_in(theirs, "iteration_rows"), yes(request.iterations));
  same("--residual", text_in(theirs, "residuals"), yes(request.residual));
  same("--ledger", yes(text_in(theirs, "ledger") == "yes"), yes(request.ledger));
  same("--repeats", text_in(theirs, "time_repeats"), request.repeats > 0 ? std::to_string(request.repeats) : "");
  same("--from-state", text_in(theirs, "from_state"), request.from_state ? request.from_state->string() : "");
  same("--jitter", text_in(theirs, "jitter"), jittered ? compare::shortest(request.jitter.largest) : "");
  same("--seed", text_in(theirs, "jitter_seed"), jittered ? std::to_string(request.jitter.seed) : "");
  if (run.scene() != stored_scene(request))
    throw compare::InputError(folder +
                              ": holds a run of another scene, or with other settings; an ablation goes on with its "
                              "own runs alone: give another --out");
}

/// Returns whether a run is complete. A failed computation is a result, too; run.json then has the hash of the last
/// good state.
bool is_over(const compare::Provenance& run) {
  return run.status == "finished" || (run.status.starts_with("failed") && !text_in(run, "final_hash").empty());
}

/// Returns whether the folder holds a run with a checkpoint. Without a checkpoint the run was killed before its first
/// step.
bool is_begun(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "run.json") && std::filesystem::exists(folder / "checkpoint.h5");
}

/// Returns whether the folder holds only files that precede a run's first checkpoint, so that it may be removed.
bool is_cut_beginning(const std::filesystem::path& folder) {
  constexpr std::array<std::string_view, 6> names{"frames",    "scene",          "run.json",
                                                  "steps.csv", "iterations.csv", "trajectory.vtkhdf"};
  if (!std::filesystem::is_directory(folder)) return false;
  return std::ranges::all_of(std::filesystem::directory_iterator(folder), [&](const auto& entry) {
    const std::string name = entry.path().filename();
    return name.ends_with(".partial") || name.ends_with(".growing") || std::ranges::find(names, name) != names.end();
  });
}

/// Returns whether the folder holds a complete run.
bool is_done(const std::filesystem::path& folder) {
  return is_begun(folder) && is_over(compare::read_manifest(folder).provenance);
}

enum class Made { found, made, interrupted };

/// Makes the run, continues it if it was interrupted, or reads its result if it is complete.
Made make(const PlannedRun& planned, const std::string& progress, CommandContext& context) {
  RunRequest request = request_of(planned.options, context);
  const std::filesystem::path folder = request.folder;
  if (is_begun(folder)) {
    const compare::RunReader there(folder);
    check_same_question(there, request);
    if (is_over(there.provenance())) {
      log_line(progress + ": is done");
      return Made::found;
    }
  } else if (is_cut_beginning(folder)) {
    log_line(progress + ": was cut off before its first step, and begins again");
    std::filesystem::remove_all(folder);
  }
  log_line(progress);
  ResumedRun run = is_begun(folder) ? resumed_run(folder) : ResumedRun{planned.options, std::move(request)};
  run.request.checkpoint_seconds = planned.options.checkpoint_seconds;
  compare::Contestant contestant = contestant_of(run.options, run.request.meetings);
  const RunSummary summary = RunSession(std::move(run.request), std::move(contestant)).run();
  if (!summary.failure.empty()) log_line("ogc: " + summary.failure);
  return summary.was_interrupted ? Made::interrupted : Made::made;
}

std::string in_brackets(const Metric& metric) {
  return std::string(metric.name) + " [" + std::string(metric.unit) + "]";
}

/// Returns the table of runs with its head only; each run adds a row.
std::vector<std::vector<std::string>> run_rows(const std::vector<Axis>& axes, bool has_seeds) {
  std::vector<std::string> names;
  for (const Axis& axis : axes) names.push_back(axis.key);
  if (has_seeds) names.emplace_back("seed");
  for (const char* name : {"status", "steps [1]"}) names.emplace_back(name);
  for (const Metric& metric : ablation_metrics()) names.push_back(in_brackets(metric));
  for (const char* name : {"audited_states [1]", "guarantee_kept", "final_hash", "device", "folder"})
    names.emplace_back(name);
  return {names};
}

std::vector<std::string> row_of(const Point& point, const std::string& seed, const RunRow& run) {
  std::vector<std::string> row = point;
  if (!seed.empty()) row.push_back(seed);
  row.push_back(run.status);
  row.push_back(std::to_string(run.steps));
  for (const double value : run.metrics) row.push_back(compare::shortest(value));
  for (const std::string& text : {run.audited_states, run.guarantee_kept, run.final_hash}) row.push_back(text);
  for (const std::string& text : {run.device, run.folder}) row.push_back('"' + text + '"');
  return row;
}

/// Returns a table with one row for each setting and each metric that every finished run measured. `digits`:
/// significant digits of numbers; 0: all.
std::vector<std::vector<std::string>> median_rows(const std::vector<Axis>& axes, const std::vector<Point>& points,
                                                  const std::vector<SettingRows>& settings, int digits) {
  std::vector<std::string> names{"metric"};
  for (const Axis& axis : axes) names.push_back(axis.key);
  for (const char* name : {"unit", "runs", "finished", "median", "smallest", "largest"}) names.emplace_back(name);
  std::vector<std::vector<std::string>> rows{names};
  const std::vector<Metric> metrics = ablation_metrics();
  for (std::size_t m = 0; m < metrics.size(); ++m)
    for (std::size_t s = 0; s < settings.size(); ++s) {
      const MetricRange range = range_of(settings[s], m);
      if (std::isnan(range.median)) continue;
      std::vector<std::string> row{std::string(metrics[m].name)};
      row.insert(row.end(), points[s].begin(), points[s].end());
      for (const std::string& text :
           {std::string(metrics[m].unit), std::to_string(settings[s].rows.size()), std::to_string(range.runs)})
        row.push_back(text);
      for (const double value : {range.median, range.smallest, range.largest})
        row.push_back(digits > 0 ? number(value, digits) : compare::shortest(value));
      rows.push_back(std::move(row));
    }
  return rows;
}

std::string csv(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text.append(i == 0 ? "" : ",").append(row[i]);
    text += '\n';
  }
  return text;
}

/// Holds the contents of ablation.csv, ablation_medians.csv and ablation_findings.txt so far.
struct Results {
  std::vector<std::vector<std::string>> runs;
  std::vector<SettingRows> settings;  ///< settings with at least one run
  std::vector<Point> points;          ///< points of these settings
  std::vector<std::string> sentences;
};

/// Returns the results of the finished runs. `done` has the rows of the first runs of `planned`.
Results results_of(const std::vector<Axis>& axes, const std::vector<Point>& points,
                   const std::vector<PlannedRun>& planned, const std::vector<RunRow>& done, bool has_seeds) {
  Results results;
  results.runs = run_rows(axes, has_seeds);
  std::vector<SettingRows> settings;
  for (const Point& point : points) settings.push_back({name_of(axes, point), {}});
  for (std::size_t i = 0; i < done.size(); ++i) {
    const RunRow& row = done[i];
    const std::string seed = has_seeds ? std::to_string(planned[i].seed) : "";
    results.runs.push_back(row_of(points[planned[i].setting], seed, row));
    settings[planned[i].setting].rows.push_back(row);
  }
  for (std::size_t s = 0; s < settings.size(); ++s)
    if (!settings[s].rows.empty()) {
      results.points.push_back(points[s]);
      results.settings.push_back(std::move(settings[s]));
    }
  if (!results.settings.empty()) results.sentences = findings(results.settings);
  return results;
}

std::string lines(const std::vector<std::string>& texts) {
  std::string text;
  for (const std::string& line : texts) text += line + "\n";
  return text;
}

void write_results(const std::filesystem::path& folder, const std::vector<Axis>& axes, const Results& results) {
  compare::write_durably(folder / "ablation.csv", csv(results.runs));
  compare::write_durably(folder / "ablation_medians.csv", csv(median_rows(axes, results.points, results.settings, 0)));
  compare::write_durably(folder / "ablation_findings.txt", lines(results.sentences));
}

Json objects(const std::vector<std::vector<std::string>>& rows) {
  Json list = Json::array();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    Json object;
    for (std::size_t k = 0; k < rows[i].size(); ++k) object[rows[0][k]] = rows[i][k];
    list.push_back(object);
  }
  return list;
}

void print_results(const std::string& folder, const std::vector<Axis>& axes, const Results& results, bool as_json) {
  if (as_json)
    return print_result(Json{{"folder", folder},
                             {"runs", objects(results.runs)},
                             {"medians", objects(median_rows(axes, results.points, results.settings, 0))},
                             {"findings", results.sentences}});
  print_result(table(median_rows(axes, results.points, results.settings, 4), axes.size() + 2) + "\n" +
               lines(results.sentences) + "\n" + folder +
               "/ablation.csv, a row a run; ablation_medians.csv; ablation_findings.txt\n"
               "The figure: .venv/bin/python -m plots.ablation " +
               folder + "\n");
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Returns the words of the command as given, without the options in `left_out`.
std::vector<std::string> words_again(const CLI::App& command, const std::vector<std::string>& left_out) {
  std::vector<std::string> words{"ablate"};
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || std::ranges::find(left_out, option->get_name()) != left_out.end()) continue;
    for (const std::string& value : option->results()) {
      if (!option->get_positional()) words.push_back(option->get_name());
      if (!option->get_positional() && option->get_expected_max() == 0) break;
      words.push_back(value);
    }
  }
  return words;
}

/// Returns the words of words_again as a command line for a shell.
std::string command_again(const CLI::App& command, const std::vector<std::string>& left_out) {
  std::string text = quoted(std::filesystem::read_symlink("/proc/self/exe").string());
  for (const std::string& word : words_again(command, left_out))
    text += " " + (word.find_first_not_of("-abcdefghijklmnopqrstuvwxyz") == word.npos ? word : quoted(word));
  return text;
}

std::string counted_run(const std::string& name, std::size_t i, std::size_t count) {
  return name + " (" + std::to_string(i + 1) + " of " + std::to_string(count) + ")";
}

/// Makes the missing runs of the grid in `folder`, each in a separate process. If such a process fails, this process
/// continues its run when it tabulates the grid. The run may then fail again.
void make_side_by_side(const AblateOptions& options, const std::vector<PlannedRun>& planned, const CLI::App& command,
                       const std::string& folder) {
  std::vector<OwnCommand> commands;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const std::string& out = planned[i].options.out;
    if (is_done(out)) continue;
    std::vector<std::string> words = words_again(command, {"--jobs", "--json", "--only", "--out", "--slurm"});
    words.insert(words.end(), {"--out", folder, "--only", std::to_string(i)});
    commands.push_back({counted_run(out.substr(folder.size() + 1), i, planned.size()), std::move(words), out + ".log"});
  }
  std::filesystem::create_directories(folder);
  run_side_by_side(commands, static_cast<int>(options.jobs));
}

/// Writes an array job for Slurm with one run for each task. `command`: the command line of this grid.
void write_slurm(const std::string& out, std::size_t count, const std::string& command) {
  const std::filesystem::path folder = std::filesystem::absolute(out);
  std::filesystem::create_directories(folder);
  const std::string script = (folder / "slurm_array.sh").string();
  compare::write_durably(script,
                         "#!/bin/bash\n"
                         "# A task a run of an ablation. A task whose time is up stops at a checkpoint; sent "
                         "again it goes on there.\n"
                         "#SBATCH --job-name=ogc-ablate\n"
                         "#SBATCH --array=0-" +
                             std::to_string(count - 1) +
                             "\n"
                             "#SBATCH --cpus-per-task=16\n"
                             "#SBATCH --signal=TERM@60\n"
                             "#SBATCH --output=\"" +
                             (folder / "slurm-%a.txt").string() +
                             "\"\n"
                             "cd " +
                             quoted(std::filesystem::current_path().string()) +
                             " || exit 2\n"
                             "srun " +
                             command + " --only \"$SLURM_ARRAY_TASK_ID\"\n");
  print_result(counted(count, "run") + ". Send them (options of sbatch: --partition, --time, --gpus …):\n  sbatch " +
               quoted(script) + "\nWhen they are done, or some of them, the same command without --slurm makes what " +
               "is missing, and the tables:\n  " + command + "\n");
}

/// Runs the grid. Writes the tables after each run, so that an interrupted grid keeps its results.
void ablate(const AblateOptions& options, const CLI::App& command, CommandContext& context) {
  check_repeats(options);
  if (options.vary.empty() && options.points.empty())
    throw compare::InputError(
        "ablate needs what to vary, --vary key=a,b or --point key=a,other=b; see ogc ablate --help");
  const AblationGrid grid = ablation_grid(options.points, options.vary);
  RunOptions base = *options.run;
  const bool is_named = !base.out.empty();
  if (!is_named) base.out = "runs/ablate-" + base.scene.substr(base.scene.rfind('/') + 1) + "-" + utc_stamp();
  const auto& [axes, points] = grid;
  const std::vector<PlannedRun> planned = planned_runs(options, base, axes, points);
  // All points are checked before the first run, because a wrong value late in the grid must not waste the earlier
  // runs.
  for (std::size_t p = 0; p < points.size(); ++p)
    check_scene(request_of(planned[p].options, context), name_of(axes, points[p]));
  if ((options.slurm || options.only != every_run) && !is_named)
    throw compare::InputError("--slurm and --only need --out: all jobs work in one folder");
  if (options.only >= static_cast<std::int64_t>(planned.size()))
    throw compare::InputError("--only " + std::to_string(options.only) + ": the grid has " +
                              counted(planned.size(), "run") + ", from 0 to " + std::to_string(planned.size() - 1));
  if (options.slurm)
    return write_slurm(base.out, planned.size(), command_again(command, {"--jobs", "--slurm", "--only"}));
  catch_interrupts();
  if (options.jobs > 1 && options.only == every_run) make_side_by_side(options, planned, command, base.out);
  const bool has_seeds = options.repeat > 1;
  std::vector<RunRow> rows;
  const auto tabulated = [&] {
    Results results = results_of(axes, points, planned, rows, has_seeds);
    write_results(base.out, axes, results);
    return results;
  };
  const auto missing = std::ranges::count_if(planned, [](const PlannedRun& run) { return !is_done(run.options.out); });
  Progress progress(0, missing, "run");
  std::int64_t made_runs = 0;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    if (options.only != every_run && options.only != static_cast<std::int64_t>(i)) continue;
    if (missing > 1 && options.only == every_run && !is_done(planned[i].options.out)) {
      progress.show(made_runs++, "");  // each run has a bar of its own
      progress.end();
    }
    const std::string name = planned[i].options.out.substr(base.out.size() + 1);
    const bool is_stopped = interrupted() && !is_done(planned[i].options.out);
    const Made made = is_stopped ? Made::interrupted : make(planned[i], counted_run(name, i, planned.size()), context);
    if (made == Made::interrupted) {
      context.status = exit_interrupted;
      log_line("interrupted; the same command with --out " + base.out + " goes on");
      break;
    }
    rows.push_back(read_run_row(planned[i].options.out));
    if (rows.back().status != "finished") context.status = exit_check_failed;
    if (options.only != every_run) return;
    if (made == Made::made) tabulated();
  }
  if (!rows.empty()) print_results(base.out, axes, tabulated(), context.json);
}

}  // namespace

void add_ablate_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<AblateOptions>();
  CLI::App* command = app.add_subcommand(
      "ablate", "Run a scene over a grid of settings, if asked from several jittered starts, and compare");
  add_run_options(*command, options->run);
  command
      ->add_option(
          "--vary", options->vary,
          "key=a,b,c: a setting, solver or backend takes these values; repeatable, and all combinations are run")
      ->take_all()
      ->type_size(1)
      ->expected(1);
  command
      ->add_option("--point", options->points,
                   "key=a,other=b: settings change together at this point; `default` is the scene's own; repeatable, "
                   "and each point is combined with all of --vary")
      ->take_all()
      ->type_size(1)
      ->expected(1);
  command
      ->add_option("--repeat", options->repeat,
                   "Each point is run so often, from starts that --jitter moves by seeds SEED, SEED + 1, …")
      ->check(whole_number(1, most_repeats))
      ->capture_default_str();
  command->add_flag("--slurm", options->slurm,
                    "Nothing is run; OUT/slurm_array.sh gets an array job with a task a run");
  command
      ->add_option("--only", options->only,
                   "Only the run of this number is made, from 0 on, and no table: a task of the array job does so")
      ->check(whole_number(0, most_counted));
  command
      ->add_option(
          "--jobs", options->jobs,
          "So many runs go on at a time, each in a process of its own; their times compare settings and say no more")
      ->check(whole_number(1, most_jobs))
      ->capture_default_str();
  command->add_flag("--json", context.json, "Print runs, medians and findings as JSON on standard output");
  command->footer(
      settings_help() +
      "\nExamples:\n"
      "  ogc ablate cloth_on_sphere --scale smoke --solver newton --vary contact_activation=ogc,ipc_log,cubic\n"
      "  ogc ablate twist --vary iterations=5,10,20 --vary detection_fraction=0,0.01,0.1 --out grid\n"
      "  ogc ablate twist --scale smoke --point default --point iterations=20,time_step=0.00167,steps=1440 --repeat 10 "
      "--jitter 1e-6\n"
      "  ogc ablate my_scene.json --vary contact_activation=ogc,cubic --repeat 10 --jitter 1e-6 --out mine\n"
      "  ogc ablate my_scene.json --vary contact_activation=ogc,cubic --repeat 10 --jitter 1e-6 --out mine --jobs 8\n"
      "  ogc ablate my_scene.json --vary contact_activation=ogc,cubic --repeat 10 --jitter 1e-6 --out mine --slurm\n\n"
      "A run is one draw: where contact is chaotic, the last bit of the start decides how it goes on. --repeat 10 "
      "runs\n"
      "each point from ten starts, each coordinate moved by at most --jitter, and compares ranges. The first point\n"
      "is what the others are held against. \"x is 1.8 times y, range 1.6 to 2.1\" is said only where "
      "every\n"
      "run of x lies above every run of y: 1.8 is the ratio of the medians, 1.6 and 2.1 are the least and the largest\n"
      "ratio of any two runs. Where the ranges overlap, no difference is shown, which is not: there is none. Two "
      "equal\n"
      "settings would lie apart by chance once in C(2N, N) / 2 times: 1 of 92378 with ten runs, 1 of 10 with three.\n"
      "The last line of the findings says how many sentences chance alone would give. Times are of this machine and\n"
      "its load; all settings take turns, seed by seed.\n\n"
      "The folder given by --out holds one run folder for each run, named key=value,…,seed=N; ablation.csv, a row a\n"
      "run; ablation_medians.csv, a row a metric and setting; ablation_findings.txt. Called again with the same --out\n"
      "it keeps what is done, goes on with the run that was cut off, to the bits of one that was not, and takes more\n"
      "values or a larger --repeat. A folder with a run of another program, scene or option is refused. A point that\n"
      "fails is a row like the others, and has no part in medians; exit status 1 says that there was one.");
  command->callback([options, command, &context] { ablate(*options, *command, context); });
}

}  // namespace ogc::experiments
