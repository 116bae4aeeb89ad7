// `ogc minimise`: how far sweeps at their floor end from the reference's minimiser of the same energy.
#include <algorithm>
#include <memory>
#include <span>

#include <nlohmann/json.hpp>

#include "compare/files/durable_file.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/bench/options.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/to_minimiser.hpp"
#include "experiments/program/version.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

constexpr const char* footer =
    "From each state the fast path makes one step. What is in contact at its end is found exactly and fixed. From\n"
    "there the fast path sweeps, no bound in its way, until the force falls no further (by less than 1 % in 200\n"
    "sweeps). The reference minimises the same energy from there, by Newton's method in double until only\n"
    "rounding is left, with friction lagged to where the sweeps ended. What both disagree by is the fast path's\n"
    "rounding, or a fault of one.\n\n"
    "residual is Eq. 29's, of the energy with these contacts. rounding is what storing one coordinate may move\n"
    "it.\n"
    "Let λ be smallest_eigenvalue_between, the least of the Hessian's at both states and halfway, each confirmed\n"
    "by a Cholesky factorisation. No vertex is farther away than bound_by_gradient, ‖∇E‖/λ, and bound_by_energy,\n"
    "√(2 energy_above/λ), if the Hessian is nowhere between the two states smaller than λ: that is assumed,\n"
    "looked at in three places, and proved in none between. A bound says how far a state of that gradient or\n"
    "energy can be; a wrong force makes both larger, and shows in residual and in distances far above rounding. λ\n"
    "= 0 and bounds of inf: the energy is not convex there, the states may be different minima, and nothing is\n"
    "promised.\n"
    "largest_distance_own_friction is the distance to the state whose friction is lagged to itself.\n"
    "Exit status 1: Newton's method found no minimiser, or a vertex is farther away than a bound.\n\n"
    "Examples:\n"
    "  ogc run twist --scale small --steps 300 --audit off --out runs/twist\n"
    "  ogc minimise runs/twist/frames/frame_000300.h5\n"
    "  ogc minimise runs/twist/frames/*.h5 --backend cuda --csv minimiser.csv";

struct Options {
  std::vector<std::string> frames;
  std::string backend = "cpu", csv;
  std::int64_t sweeps = 5000;
  int threads = 0;
};

/// A cell under its column's name and unit, "1" for counts and ratios.
struct Cell {
  std::string name, unit;
  Json value;
};

std::vector<Cell> cells_of(const ToMinimiser& row, const std::string& backend) {
  const BuildInfo build = build_info();
  return {{"scene", "", row.scene},
          {"step", "1", row.step},
          {"backend", "", backend},
          {"vertices", "1", row.vertices},
          {"free_vertices", "1", row.free_vertices},
          {"vertex_facet_contacts", "1", row.vertex_facet_contacts},
          {"edge_edge_contacts", "1", row.edge_edge_contacts},
          {"sweeps", "1", row.sweeps},
          {"reached_floor", "", row.reached_floor ? "yes" : "no"},
          {"residual_before", "1", row.residual_before},
          {"residual", "1", row.residual},
          {"gradient", "N", row.gradient},
          {"energy_above", "J", row.energy_above},
          {"newton_iterations", "1", row.newton_iterations},
          {"newton_residual", "1", row.newton_residual},
          {"newton_converged", "", row.newton_converged ? "yes" : "no"},
          {"largest_distance", "m", row.largest_distance},
          {"rms_distance", "m", row.rms_distance},
          {"largest_distance_own_friction", "m", row.largest_distance_own_friction},
          {"rounding", "m", row.rounding},
          {"smallest_eigenvalue", "N/m", row.smallest_eigenvalue},
          {"smallest_eigenvalue_between", "N/m", row.smallest_eigenvalue_between},
          {"bound_by_gradient", "m", row.bound_by_gradient},
          {"bound_by_energy", "m", row.bound_by_energy},
          {"device", "", row.device},
          {"commit", "", build.commit.substr(0, 10) + (build.dirty ? " (dirty)" : "")}};
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? compare::shortest(value.get<double>()) : value.dump();
}

/// A device's name may hold a comma.
std::string csv_cell(const std::string& text) { return text.find(',') == std::string::npos ? text : '"' + text + '"'; }

std::string csv_of(std::span<const std::vector<Cell>> rows) {
  std::string text;
  for (const Cell& cell : rows.front())
    text += (text.empty() ? "" : ",") + cell.name + (cell.unit.empty() ? "" : " [" + cell.unit + "]");
  text += '\n';
  for (const std::vector<Cell>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : ",") + csv_cell(text_of(row[i].value));
    text += '\n';
  }
  return text;
}

/// A column a state: there are more numbers than a line has room for.
std::string described(std::span<const std::vector<Cell>> rows) {
  std::vector<std::vector<std::string>> lines;
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    const Cell& head = rows.front()[i];
    lines.push_back({head.name, head.unit == "1" ? "" : head.unit});
    for (const std::vector<Cell>& row : rows) {
      const Json& value = row[i].value;
      lines.back().push_back(value.is_number_float() ? number(value.get<double>()) : text_of(value));
    }
  }
  return table(lines, 2);
}

Json json_of(std::span<const std::vector<Cell>> rows) {
  Json all = Json::array();
  for (const std::vector<Cell>& row : rows) {
    Json one = Json::object();
    for (const Cell& cell : row) one[cell.name] = cell.value;
    all.push_back(std::move(one));
  }
  return all;
}

/// A distance beyond its bound refutes the program.
bool within_bounds(const ToMinimiser& row) {
  return row.newton_converged && !(row.largest_distance > std::min(row.bound_by_gradient, row.bound_by_energy));
}

/// Logs why a number of the row is not what its column promises.
void say_doubts(const std::string& frame, const ToMinimiser& row) {
  const std::string sweeps = std::to_string(row.sweeps);
  if (!row.reached_floor)
    log_line("ogc: " + frame + ": the force still falls after " + sweeps + " sweeps; give more --sweeps");
  if (row.smallest_eigenvalue_between == 0)
    log_line("ogc: " + frame + ": the energy is not convex between the two states, so there is no bound");
  if (!row.newton_converged) log_line("ogc: " + frame + ": Newton's method found no minimiser");
}

ToMinimiser at_frame(const std::string& frame, const compare::Contestant& contestant, std::int64_t sweeps) {
  BenchScene from = scene_at_frame(frame);
  round_to_single(from.scene);
  return distance_to_minimiser(contestant, from.scene, *from.start, sweeps);
}

int minimise(const Options& options, const CommandContext& context) {
  const auto limit = limited_threads(options.threads);
  const fast::Backend backend = options.backend == "cuda" ? fast::Backend::cuda : fast::Backend::cpu;
  const compare::Contestant contestant = fast::contestant(backend);
  std::vector<std::vector<Cell>> rows;
  int status = exit_success;
  for (const std::string& frame : options.frames) {
    const ToMinimiser row = at_frame(frame, contestant, options.sweeps);
    say_doubts(frame, row);
    if (!within_bounds(row)) status = exit_check_failed;
    rows.push_back(cells_of(row, options.backend));
    // After each state, so that an interrupted call leaves what it has.
    if (!options.csv.empty()) compare::write_durably(options.csv, csv_of(rows));
  }
  if (context.json)
    print_result(json_of(rows));
  else
    print_result(described(rows));
  return status;
}

}  // namespace

void add_minimise_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("minimise",
                                         "How far sweeps at their floor end from the minimiser of the same energy");
  command->add_option("FRAME", options->frames, "Frames of runs (RUN/frames/…), each the state before a step")
      ->required()
      ->take_all();
  command->add_option("--backend", options->backend, "Where the fast path computes")
      ->check(CLI::IsMember({"cpu", "cuda"}))
      ->capture_default_str();
  command->add_option("--sweeps", options->sweeps, "At most so many")
      ->check(whole_number(1, most_counted))
      ->capture_default_str();
  command->add_option("--csv", options->csv, "Write the table to this file, a row a state, written after each");
  add_threads_option(*command, options->threads);
  command->add_flag("--json", context.json, "Print the numbers as a JSON array on standard output, an object a state");
  command->footer(footer);
  command->callback([options, &context] { context.status = minimise(*options, context); });
}

}  // namespace ogc::experiments
