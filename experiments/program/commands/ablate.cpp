// `ogc ablate`: a grid of runs that differ in some settings, one run folder for each point, and one table over all of
// them.
#include <fstream>

#include <nlohmann/json.hpp>

#include "compare/files/durable_file.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/interrupt.hpp"
#include "experiments/program/runs/run_options.hpp"

namespace ogc::experiments {

namespace {

struct AblateOptions {
  std::shared_ptr<RunOptions> run = std::make_shared<RunOptions>();
  std::vector<std::string> vary;
};

/// One axis of the grid.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

Axis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  Axis axis{text.substr(0, equals), {}};
  for (std::size_t begin = equals + 1; equals != std::string::npos && begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    axis.values.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  if (axis.key.empty() || axis.values.empty() || std::ranges::find(axis.values, "") != axis.values.end())
    throw compare::InputError("--vary " + text + ": give key=a,b,c, for example --vary activation=ogc,ipc_log");
  return axis;
}

/// A point of the grid: a value for each axis. The last axis runs fastest.
using Point = std::vector<std::string>;

std::vector<Point> grid(const std::vector<Axis>& axes) {
  std::vector<Point> points{{}};
  for (const Axis& axis : axes) {
    std::vector<Point> longer;
    for (const Point& point : points)
      for (const std::string& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    points = std::move(longer);
  }
  return points;
}

std::string name_of(const std::vector<Axis>& axes, const Point& point) {
  std::string name;
  for (std::size_t i = 0; i < axes.size(); ++i)
    name.append(name.empty() ? "" : ",").append(axes[i].key).append("=").append(point[i]);
  return name;
}

/// `solver` and `backend` are options of a run, everything else is a setting.
RunOptions options_at(const RunOptions& base, const std::vector<Axis>& axes, const Point& point) {
  RunOptions options = base;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].key == "solver")
      options.solver = point[i];
    else if (axes[i].key == "backend")
      options.backend = point[i];
    else
      options.assignments.push_back(axes[i].key + "=" + point[i]);
  }
  options.out = base.out + "/" + name_of(axes, point);
  return options;
}

std::string per_step(std::int64_t count, std::int64_t steps) {
  return steps > 0 ? compare::shortest(static_cast<double>(count) / static_cast<double>(steps)) : "nan";
}

/// Not-a-number where a solver does not know its residual.
double largest_residual(const std::string& folder) {
  double largest = 0;
  for (const compare::StepMetrics& row : compare::read_steps(folder).rows)
    if (!(row.residual <= largest)) largest = row.residual;
  return largest;
}

std::vector<std::string> columns(const std::vector<Axis>& axes) {
  std::vector<std::string> names;
  for (const Axis& axis : axes) names.push_back(axis.key);
  for (const char* name :
       {"status", "steps [1]", "median_step [ms]", "worst_step [ms]", "iterations_a_step [1]", "detections_a_step [1]",
        "most_contacts [1]", "largest_residual [1]", "smallest_distance [m]", "guarantee_kept", "final_hash", "folder"})
    names.emplace_back(name);
  return names;
}

std::vector<std::string> row_of(const Point& point, const RunSummary& summary) {
  const std::int64_t steps = summary.last_step - summary.first_step;
  std::vector<std::string> row = point;
  // A status may hold a comma or a line end; its first word does not.
  row.push_back(summary.status.substr(0, summary.status.find(':')));
  row.push_back(std::to_string(steps));
  for (const double ms : {summary.median_ms, summary.worst_ms}) row.push_back(compare::shortest(ms));
  row.push_back(per_step(summary.iterations, steps));
  row.push_back(per_step(summary.discrete_detections, steps));
  row.push_back(std::to_string(summary.most_contacts));
  row.push_back(compare::shortest(largest_residual(summary.folder)));
  row.push_back(compare::shortest(summary.smallest_distance));
  row.push_back(!summary.guarantee_kept ? "not checked" : *summary.guarantee_kept ? "yes" : "no");
  row.push_back(summary.final_hash);
  row.push_back('"' + summary.folder + '"');
  return row;
}

std::string csv(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text.append(i == 0 ? "" : ",").append(row[i]);
    text += '\n';
  }
  return text;
}

/// The table is written after each point, so that an interrupted grid leaves what it has.
void ablate(const AblateOptions& options, CommandContext& context) {
  std::vector<Axis> axes;
  for (const std::string& text : options.vary) axes.push_back(parse_axis(text));
  RunOptions base = *options.run;
  if (base.out.empty()) base.out = "runs/ablate-" + base.scene.substr(base.scene.rfind('/') + 1) + "-" + utc_stamp();
  const std::vector<Point> points = grid(axes);
  // All points are asked for before the first runs: a wrong value late in the grid must not cost the runs before it.
  for (const Point& point : points) request_of(options_at(base, axes, point), context);
  catch_interrupts();
  std::vector<std::vector<std::string>> rows{columns(axes)};
  Json json = Json::array();
  for (const Point& point : points) {
    const RunOptions at = options_at(base, axes, point);
    log_line(name_of(axes, point) + " (" + std::to_string(rows.size()) + " of " + std::to_string(points.size()) + ")");
    const RunSummary summary = RunSession(request_of(at, context), contestant_of(at)).run();
    rows.push_back(row_of(point, summary));
    json.push_back(to_json(summary));
    compare::write_durably(std::filesystem::path(base.out) / "ablation.csv", csv(rows));
    if (!summary.failure.empty()) {
      context.status = exit_check_failed;
      log_line("ogc: " + summary.failure);
    }
    if (summary.was_interrupted) context.status = exit_interrupted;
    if (summary.was_interrupted) break;
  }
  if (context.json) return print_result(json);
  for (auto& row : rows) row.resize(row.size() - 2);
  print_result(table(rows, axes.size()) + "\n" + base.out + "/ablation.csv\n");
}

}  // namespace

void add_ablate_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<AblateOptions>();
  CLI::App* command = app.add_subcommand(
      "ablate", "Run a scene over a grid of settings, one run folder for each point, and tabulate");
  add_run_options(*command, options->run);
  command
      ->add_option("--vary", options->vary,
                   "key=a,b,c: a setting, or solver, or backend; repeatable, all combinations are run")
      ->take_all()
      ->type_size(1)
      ->expected(1)
      ->required();
  command->add_flag("--json", context.json, "Print the summaries as JSON on standard output");
  command->footer(settings_help() +
                  "\nExamples:\n"
                  "  ogc ablate cloth_on_sphere --scale smoke --solver newton --vary activation=ogc,ipc_log,cubic\n"
                  "  ogc ablate twist --vary iterations=5,10,20 --vary redetect_fraction=0,0.01,0.1 --out grid\n\n"
                  "The folder given by --out holds one run folder for each point, named key=value,…, and ablation.csv. "
                  "A point that fails is a row like the others;\n"
                  "exit status 1 says that there was one.");
  command->callback([options, &context] { ablate(*options, context); });
}

}  // namespace ogc::experiments
