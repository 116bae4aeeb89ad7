#include "experiments/program/runs/laws.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "compare/problem/names.hpp"

namespace ogc::experiments {
namespace {

/// names of verdicts, indexed by compare::Verdict
constexpr std::array<std::string_view, 3> verdict_names{"holds", "limit", "broken"};
std::string name_of(compare::Verdict verdict) { return std::string(verdict_names[static_cast<std::size_t>(verdict)]); }

std::string verdict_of(const LawRow& row) { return row.was_asked ? name_of(row.verdict) : "not asked"; }

std::string solver_of(const LawRow& row) {
  return std::string(solver_names()[static_cast<std::size_t>(row.asked.solver)]);
}

std::string backend_of(const LawRow& row) { return row.asked.on_device ? "cuda" : "cpu"; }

/// Returns the name of the bounds; "ccd" for IPC, which bounds its steps by continuous detection.
std::string bounds_of(const LawRow& row) {
  if (row.asked.solver == Solver::ipc) return "ccd";
  return std::string(name_of(row.asked.bounds));
}

compare::Answerer answerer_of(Solver solver) {
  return {.is_solved = solver != Solver::vbd, .has_contact_energy = solver != Solver::ipc};
}

compare::LawState state_of(const compare::Snapshot& snapshot) {
  const bool is_exact = !snapshot.exact_positions.empty();
  return {is_exact ? snapshot.exact_positions : compare::to_double(snapshot.positions),
          is_exact ? snapshot.exact_velocities : compare::to_double(snapshot.velocities)};
}

/// Returns the reason why a run ended before its last step.
std::string failure_of(const compare::StepMetrics& row) {
  std::string text = "step " + std::to_string(row.step);
  if ((row.status & compare::step_not_converged) != 0) text += " did not converge";
  if ((row.status & compare::step_indefinite) != 0) text += " found no way down";
  if ((row.status & compare::step_not_finite) != 0) text += " left numbers that are not finite";
  if ((row.status & compare::step_bound_violated) != 0) text += " left a bound";
  if ((row.status & compare::step_met) != 0) text += " let faces meet";
  return text;
}

constexpr std::uint32_t ends_run = compare::step_not_finite | compare::step_bound_violated |
                                   compare::step_not_converged | compare::step_indefinite | compare::step_met;

/// Adapts the law's scene to the solver. IPC's barriers get the activation distance r, like contacts, so that a body on
/// a floor starts at its equilibrium.
void prepare(compare::Scene& scene, const LawAsked& asked) {
  scene.settings.bounds = asked.bounds;
  if (asked.solver == Solver::ipc) compare::set_setting(scene.settings, "ipc_distance", scene.settings.contact_radius);
}

/// Runs the scene. Throws std::runtime_error if a step fails.
compare::Trajectory moved(compare::Scene scene, const LawAsked& asked) {
  prepare(scene, asked);
  const auto simulation = contestant_of(asked.solver, asked.on_device).start(scene, {});
  compare::Trajectory run{.scene = scene, .by = answerer_of(asked.solver), .states = {}, .rows = {}};
  run.states.push_back({scene.mesh.positions, scene.velocities});
  for (std::int64_t n = 0; n < scene.settings.steps; ++n) {
    for (compare::StepMetrics& row : simulation->advance(1)) {
      if ((row.status & ends_run) != 0) throw std::runtime_error(failure_of(row));
      run.rows.push_back(std::move(row));
    }
    run.states.push_back(state_of(simulation->snapshot()));
  }
  return run;
}

void answer(LawRow& row, compare::LawSize size) {
  std::vector<compare::Trajectory> runs;
  for (compare::Scene& scene : row.law->scenes(size)) runs.push_back(moved(std::move(scene), row.asked));
  row.readings = row.law->read(runs);
  row.verdict = compare::verdict(row.readings);
  const compare::Reading* worst = compare::worst(row.readings);
  if (worst != nullptr && row.verdict == compare::Verdict::limit) row.why = worst->why;
}

std::vector<std::string> line_of(const LawRow& row) {
  std::vector<std::string> line{std::string(row.law->name), solver_of(row), backend_of(row), bounds_of(row),
                                verdict_of(row)};
  const compare::Reading* worst = compare::worst(row.readings);
  if (worst == nullptr) {
    line.insert(line.end(), {row.why, "", "", ""});
    return line;
  }
  const std::string sign = worst->side == compare::Side::at_most ? "≤ " : "";
  line.insert(line.end(), {worst->what + (worst->unit == "1" ? "" : " [" + worst->unit + "]"),
                           number(worst->measured, 5), sign + number(worst->answer, 5), number(worst->tolerance, 2)});
  return line;
}

Json reading_json(const compare::Reading& reading) {
  return {{"what", reading.what},           {"unit", reading.unit},
          {"measured", reading.measured},   {"answer", reading.answer},
          {"tolerance", reading.tolerance}, {"side", reading.side == compare::Side::both ? "both" : "at most"},
          {"limit", reading.limit},         {"verdict", name_of(compare::verdict(reading))}};
}

}  // namespace

LawRow ask(const compare::Law& law, compare::LawSize size, const LawAsked& asked) {
  LawRow row{.law = &law, .asked = asked, .why = {}, .readings = {}};
  if (law.needs_springs && !answerer_of(asked.solver).has_contact_energy) {
    row.was_asked = false;
    row.why = "its contacts are barriers, no springs of method.md §4.2";
    return row;
  }
  const auto start = std::chrono::steady_clock::now();
  try {
    answer(row, size);
  } catch (const compare::ResourceError&) {
    throw;
  } catch (const std::runtime_error& failed) {
    row.verdict = compare::Verdict::broken;
    row.why = failed.what();
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

bool any_broken(const std::vector<LawRow>& rows) {
  return std::ranges::any_of(
      rows, [](const LawRow& row) { return row.was_asked && row.verdict == compare::Verdict::broken; });
}

std::string describe(const std::vector<LawRow>& rows) {
  std::vector<std::vector<std::string>> lines{
      {"law", "solver", "on", "bounds", "verdict", "worst reading", "measured", "law says", "within"}};
  std::array<std::size_t, 3> counts{};
  std::size_t not_asked = 0;
  std::string limits;
  for (const LawRow& row : rows) {
    lines.push_back(line_of(row));
    row.was_asked ? ++counts[static_cast<std::size_t>(row.verdict)] : ++not_asked;
    if (row.was_asked && row.verdict == compare::Verdict::limit)
      limits += "limit of " + std::string(row.law->name) + " (" + solver_of(row) + "): " + row.why + "\n";
  }
  return table(lines, 6) + "\n" + limits + std::to_string(counts[0]) + " hold, " + counted(counts[1], "limit") + ", " +
         std::to_string(counts[2]) + " broken, " + std::to_string(not_asked) + " not asked\n";
}

Json law_json(const std::vector<LawRow>& rows, compare::LawSize size) {
  Json all = Json::array();
  for (const LawRow& row : rows) {
    Json readings = Json::array();
    for (const compare::Reading& reading : row.readings) readings.push_back(reading_json(reading));
    all.push_back({{"law", row.law->name},
                   {"group", row.law->group},
                   {"solver", solver_of(row)},
                   {"backend", backend_of(row)},
                   {"bounds", bounds_of(row)},
                   {"verdict", verdict_of(row)},
                   {"why", row.why},
                   {"seconds", row.seconds},
                   {"readings", readings}});
  }
  return {{"format", "ogc laws 1"},
          {"size", size == compare::LawSize::least ? "least" : "whole"},
          {"broken", any_broken(rows)},
          {"rows", all}};
}

std::string list_laws() {
  std::vector<std::vector<std::string>> lines{{"law", "group", "what it proves", "answer"}};
  for (const compare::Law& law : compare::laws())
    lines.push_back({std::string(law.name), std::string(law.group), std::string(law.meaning), std::string(law.answer)});
  return table(lines, 4);
}

}  // namespace ogc::experiments
