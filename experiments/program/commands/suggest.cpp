// `ogc suggest`: suggests settings for a mesh and gives the reason for each.
#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "compare/problem/text.hpp"
#include "compare/problem/validate_mesh.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/mesh_input.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/mesh_scene.hpp"
#include "experiments/program/runs/suggestion.hpp"
#include "experiments/scenes/materials.hpp"

namespace ogc::experiments {

namespace {

struct SuggestOptions {
  std::string mesh;
  compare::MeshOptions reading;
  std::optional<double> fall;
};

/// Holds one suggested number and the setting's name for --set.
struct Row {
  std::string setting, unit;
  SuggestedNumber suggested;
};

std::vector<Row> rows_of(const Suggestion& found) {
  // r_q is set by its cap, a multiple of r.
  const SuggestedNumber cap{found.query_radius.value / found.contact_radius.value,
                            "r_q up to " + number(found.query_radius.value) + " m, " + found.query_radius.reason};
  return {{"contact_radius", "m", found.contact_radius},
          {"detection_radius_cap", "r", cap},
          {"contact_stiffness", "N/m", found.contact_stiffness},
          {"time_step", "s", found.time_step},
          {"iterations", "1", found.iterations}};
}

/// Quotes a text as one word for a shell.
std::string quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '/' || c == '.' || c == '_' || c == '-';
  };
  if (std::ranges::all_of(word, is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Returns the command that runs the mesh with these settings. The ground lies so deep that the mesh falls by the
/// requested height.
std::string command_line(const std::string& mesh, double ground, const std::vector<Row>& rows) {
  std::string text = "ogc run " + quoted(mesh) + " --ground " + compare::shortest(ground);
  for (const Row& row : rows) text += " --set " + row.setting + "=" + compare::shortest(row.suggested.value);
  return text;
}

void run_suggest(const SuggestOptions& options, const CommandContext& context) {
  const MeshInput input = read_mesh_input(options.mesh, options.reading);
  expect_solid(input);
  const bool is_solid = !input.mesh.tetrahedra.empty();
  const compare::Material material = is_solid ? soft_rubber() : layer_cloth();
  const double density = is_solid ? material.solid_density : material.density;
  const double fall = options.fall.value_or(default_fall(input.mesh));
  const Suggestion found = suggest(input.mesh, material, fall);
  const std::vector<Row> rows = rows_of(found);
  const std::string command = command_line(options.mesh, input.origin.y + lowest_point(input.mesh) - fall, rows);
  if (context.json) {
    Json json{{"mesh", options.mesh}, {"density", density}, {"fall", fall}, {"settings", Json::object()}};
    for (const auto& [setting, unit, suggested] : rows)
      json["settings"][setting] = {{"value", suggested.value}, {"unit", unit}, {"reason", suggested.reason}};
    json["excess_extension"] = found.excess_extension;
    json["command"] = command;
    return print_result(json);
  }
  std::vector<std::vector<std::string>> lines;
  for (const auto& [setting, unit, suggested] : rows)
    lines.push_back({setting, number(suggested.value), unit, suggested.reason});
  const std::string what = is_solid ? "a soft solid of " + compare::shortest(density) + " kg/m³"
                                    : "cloth of " + number(density) + " kg/m²";
  print_result(what + " that falls by " + number(fall) + " m:\n" + table(lines, 4) + "\n" + command + "\n");
}

}  // namespace

void add_suggest_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<SuggestOptions>();
  CLI::App* command = app.add_subcommand("suggest", "Settings to run a mesh with, each with its reason");
  command->add_option("MESH", options->mesh, "A mesh file")->required();
  add_mesh_options(*command, options->reading);
  command
      ->add_option("--fall", options->fall,
                   "The mesh falls so far before it meets something [m] (default: a tenth of its size)")
      ->check(real_number(compare::least_length, compare::most_length, "m"));
  command->add_flag("--json", context.json, "Print settings, reasons and the command as JSON on standard output");
  command->footer(
      "The contact radius follows from edges and gaps (nothing is in contact at the start where that can be), the\n"
      "stiffness from the weight of ten layers, or of as many as there are, and from the fall, the query radius and "
      "the\n"
      "step from how far a vertex may move between two detections, the iterations from how much longer what hangs "
      "gets\n"
      "by sweeps that end early (at most 1 %, or what 100 iterations leave, which is said), from contacts, and from "
      "how\n"
      "many layers lie on one another. The mesh is taken as cloth of 0.2 kg/m², or, if it has tetrahedra, as soft\n"
      "rubber; what is printed last runs it so. Lengths are in metres.\n\n"
      "Examples:\n"
      "  ogc suggest shirt.obj\n"
      "  ogc suggest shirt.obj --fall 0.5 --json");
  command->callback([options, &context] { run_suggest(*options, context); });
}

}  // namespace ogc::experiments
