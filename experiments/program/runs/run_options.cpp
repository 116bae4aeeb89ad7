#include "experiments/program/runs/run_options.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/ranges.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate_mesh.hpp"
#include "compare/problem/volumes.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/runs/measured_simulation.hpp"
#include "experiments/program/runs/mesh_scene.hpp"
#include "experiments/program/runs/set_material.hpp"
#include "experiments/program/runs/solvers.hpp"
#include "experiments/scenes/driven_contact.hpp"
#include "experiments/scenes/registry.hpp"

namespace ogc::experiments {

namespace {

std::string value_text(const compare::Settings& settings, const compare::SettingInfo& info) {
  return info.choices.empty() ? number(compare::get_setting(settings, info)) : compare::setting_text(settings, info);
}

bool is_scene_file(const std::string& scene) { return scene.ends_with(".json"); }

constexpr std::string_view data_key = "data=", contact_key = "body_contact=";
/// One day.
constexpr double most_checkpoint_seconds = 86400;
constexpr std::uint64_t most_repeats = 1000;

void check_scene_options(const RunOptions& options, const std::string& data) {
  const bool is_mesh = compare::is_mesh_file(options.scene);
  if (!is_mesh && (options.ground || options.mesh != compare::MeshOptions{}))
    throw compare::InputError(
        "--ground, --weld, --strict, --no-triangulate and --no-drop-unused belong to a mesh file in place of the "
        "scene, "
        "for example ogc run shirt.obj");
  if (!is_mesh && !is_scene_file(options.scene)) return;
  if (!data.empty())
    throw compare::InputError("--set data=" + data + " belongs to the built-in scenes; a file names its meshes itself");
  if (!options.scale.empty())
    throw compare::InputError("--scale belongs to the built-in scenes (" + scene_names() + "); a file has one size");
}

/// Returns the scene before --set is applied, and its scale. Logs what was changed while its files were read.
compare::SceneFile load_scene(const RunOptions& options, std::string& scale) {
  const std::string data = data_folder(options.assignments);
  check_scene_options(options, data);
  if (compare::is_mesh_file(options.scene))
    return mesh_scene(options.scene, options.mesh, options.ground, options.assignments);
  if (is_scene_file(options.scene)) {
    compare::SceneFile file = compare::load_scene_file(options.scene);
    for (const std::string& note : file.notes) log_line("ogc: " + note);
    return file;
  }
  scale = options.scale.empty() ? "small" : options.scale;
  return {make_scene(options.scene, parse_scale(scale), data), {}, {}};
}

/// Sets the model named `value` for every body whose model is not `none`. Returns false if `key` is not `wanted_key`.
template <class Model>
bool set_model(compare::Scene& scene, const std::string& key, std::string_view wanted_key, const std::string& value,
               std::span<const std::string_view> names, Model compare::Material::*model) {
  if (key != wanted_key) return false;
  const auto found = std::find(names.begin(), names.end(), value);
  if (found == names.end()) throw compare::InputError(key + ": " + compare::unknown_name("model", value, names));
  for (compare::Body& body : scene.bodies)
    if (body.material.*model != Model::none) body.material.*model = static_cast<Model>(found - names.begin());
  return true;
}

}  // namespace

void expect_setting(const std::string& key) {
  std::vector<std::string_view> names{"membrane", "bending", "body_contact"};
  for (const MaterialSetting& constant : material_settings()) names.push_back(constant.name);
  for (const compare::SettingInfo& info : compare::setting_table()) names.push_back(info.name);
  if (std::ranges::find(names, key) != names.end()) return;
  throw compare::InputError(compare::unknown_setting(key, names));
}

void set_in_scene(compare::Scene& scene, const std::string& key, const std::string& value) {
  using compare::Material;
  expect_setting(key);
  if (!set_material(scene, key, value) &&
      !set_model(scene, key, "membrane", value, compare::choice_names<compare::MembraneModel>, &Material::membrane) &&
      !set_model(scene, key, "bending", value, compare::choice_names<compare::BendingModel>, &Material::bending))
    compare::set_setting(scene.settings, key, value);
}

namespace {

/// Sets body_contact. This precedes all settings, because it changes the setting detection_fraction.
void apply_contact(compare::Scene& scene, const std::string& value) {
  const auto names = compare::choice_names<compare::BodyContact>;
  const auto found = std::ranges::find(names, value);
  if (found == names.end())
    throw compare::InputError("body_contact: " + compare::unknown_name("contact", value, names));
  set_body_contact(scene, static_cast<compare::BodyContact>(found - names.begin()));
}

void apply_settings(compare::Scene& scene, const RunOptions& options) {
  for (const std::string& assignment : options.assignments)
    if (assignment.starts_with(contact_key)) apply_contact(scene, assignment.substr(contact_key.size()));
  for (const std::string& assignment : options.assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
      throw compare::InputError("--set " + assignment + ": give key=value, for example --set iterations=20");
    if (!assignment.starts_with(data_key) && !assignment.starts_with(contact_key))
      set_in_scene(scene, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  if (options.steps > 0) compare::set_setting(scene.settings, "steps", std::to_string(options.steps));
}

const std::vector<std::string> backend_names{"cpu", "cuda"};

}  // namespace

CLI::Option* add_run_options(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  const std::string kinds =
      "A built-in scene (" + scene_names() +
      "), a scene file, or a mesh file, which falls on a ground as cloth, or as a solid if it has tetrahedra";
  CLI::Option* scene = command.add_option("SCENE|FILE.json|MESH", options->scene, kinds)->required();
  command
      .add_option("--ground", options->ground,
                  "Mesh files: the ground has this height y [m] (default: a tenth of the mesh's size below it)")
      ->check(real_number(-compare::most_length, compare::most_length, "m"));
  add_mesh_options(command, options->mesh);
  command
      .add_option("--solver", options->solver,
                  "Steps are solved by this method; penalty is a baseline without bounds, which guarantees nothing")
      ->check(CLI::IsMember(std::vector<std::string>(solver_names().begin(), solver_names().end())))
      ->capture_default_str();
  command
      .add_option("--backend", options->backend,
                  "vbd is computed on the CPU or on a CUDA device; other solvers have the CPU alone")
      ->check(CLI::IsMember(backend_names))
      ->capture_default_str();
  command.add_option(
      "--scale", options->scale,
      "Built-in scenes: smoke takes seconds, small (the default) minutes on 2 cores, paper has the paper's sizes");
  command.add_option("--steps", options->steps, "The run ends with the step of this number (default: the scene's)")
      ->check(whole_number(1, most_counted));
  command.add_option("--set", options->assignments, "key=value, repeatable; the settings are listed below")
      ->take_all()
      ->type_size(1)
      ->expected(1);
  command
      .add_option("--audit", options->audit,
                  "The audit judges the state after every step, each stored frame, the last state (end), or none (off)")
      ->check(CLI::IsMember({"every", "frame", "end", "off"}))
      ->capture_default_str();
  command.add_option(
      "--audit-meetings", options->audit_meetings,
      "FROM:TO, or off: count exactly the pairs of faces that meet on the way in these steps (compare/meetings.md). "
      "Default: off; with --audit every and curves all steps, but none at scale paper");
  command
      .add_option("--deepest", options->deepest,
                  "A state fails where a vertex lies deeper inside a volume than this (default: no state does)")
      ->check(real_number(0, compare::most_length, "m"));
  command.add_option("--from-state", options->from_state,
                     "The run starts from this frame file (RUN/frames/…) in place of the scene's start");
  command
      .add_option("--jitter", options->jitter.largest,
                  "Each coordinate of each free vertex of the start moves by a random offset of at most this, which is "
                  "less than a tenth of contact_radius; the start is audited as always")
      ->check(real_number(0, compare::most_length, "m"));
  command
      .add_option("--seed", options->jitter.seed,
                  "--jitter draws its offsets by this seed; the same seed gives the same bits on every machine")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->needs("--jitter")
      ->capture_default_str();
  command.add_flag("--tolerate-start", options->tolerate_start,
                   "The run begins although faces meet. Their pairs of vertices have no contact, no bound and no audit "
                   "until they are apart (experiments/garments.md); start_pairs.csv counts them at each frame");
  command.add_flag("--profile", options->profile,
                   "steps.csv gets the time of each stage, which slows the run down a little; with --iterations their "
                   "rows get measured times");
  command.add_flag("--residual", options->residual,
                   "steps.csv gets the residual of Eq. 29 with the contacts and the friction of the end of the step, "
                   "and frames each vertex's part of it; it is measured beside the run (slow)");
  command.add_flag("--iterations", options->iterations,
                   "iterations.csv gets a row an iteration, which is measured beside the run");
  command
      .add_option("--repeats", options->repeats,
                  "Each step is done once to warm up, and so often again from the same state; its times are those of "
                  "the repetition whose time is the median")
      ->check(whole_number(1, most_repeats));
  command.add_flag(
      "--ledger", options->ledger,
      "vbd: steps.csv gets what each part of a step does to energy and momentum, what truncation takes and in which "
      "direction, and how many vertices stand still (reference/ledger.md), and frames which vertices the last "
      "iteration cut; it is measured beside the run (slow)");
  command.add_flag("--condition", options->condition,
                   "newton: iterations.csv gets the condition number of each matrix, of it without friction, and of it "
                   "without contact (slow)");
  command.add_option("--out", options->out, "The run goes into this folder (default: runs/SCENE-SCALE-TIME)");
  command.add_option("--show", options->show,
                     "If the start or a later state is refused, a .vtp of what intersects goes into this folder");
  command
      .add_option("--checkpoint", options->checkpoint_seconds,
                  "The run writes a checkpoint after at least so many seconds; 0: at each state that is judged")
      ->check(real_number(1e-3, most_checkpoint_seconds, "s", true))
      ->capture_default_str();
  return scene;
}

std::string data_folder(const std::vector<std::string>& assignments) {
  std::string folder;
  for (const std::string& assignment : assignments) {
    if (!assignment.starts_with(data_key)) continue;
    folder = assignment.substr(data_key.size());
    if (folder.empty())
      throw compare::InputError("--set data=: give the folder of the data, for example --set data=input");
  }
  return folder;
}

std::string scene_names() {
  std::string names;
  for (const SceneInfo& info : scenes()) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

std::string settings_help() {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> meanings;
  const auto add = [&](std::string_view name, std::string_view unit, std::string_view value, const std::string& range,
                       std::string_view meaning) {
    rows.push_back({"  " + std::string(name), std::string(unit), std::string(value), range});
    meanings.emplace_back(meaning);
  };
  add("setting", "unit", "default", "range", "what it means");
  const compare::Settings defaults;
  for (const compare::SettingInfo& info : compare::setting_table())
    add(info.name, info.unit, value_text(defaults, info), compare::range_text(info), info.meaning);
  add("membrane", "1", "the scene's", compare::joined(compare::choice_names<compare::MembraneModel>),
      "every body that resists stretch does so by this model");
  add("bending", "1", "the scene's", compare::joined(compare::choice_names<compare::BendingModel>),
      "every body that resists bending does so by this model");
  for (const MaterialSetting& constant : material_settings())
    add(constant.name, constant.unit, "the scene's", constant.range, constant.meaning);
  add("body_contact", "1", "the scene's", compare::joined(compare::choice_names<compare::BodyContact>),
      "bodies that a motion moves whole, and bodies with tetrahedra: nothing enters them (surface), or they push out "
      "what enters (volume); where a motion moves one, detection_fraction becomes 0 or 0.01");
  add("data", "folder", "none", "a folder",
      "scene dress: its bodies come from the published files of Codimensional IPC in this folder");
  std::istringstream lines(table(rows, 4));
  const std::string head = "Settings for --set (a scene brings its own values; defaults are those of a scene file ";
  std::string text = head + "that says nothing):\n", line;
  for (const std::string& meaning : meanings) text += (std::getline(lines, line), line) + "\n      " + meaning + "\n";
  return text;
}

/// Returns the steps whose meetings (pairs that touch during a straight motion) are counted. For scenes with curves,
/// audits of every step count meetings by default, because two states of curves prove nothing about the motion between
/// them. At paper scale, where traces are slow, meetings are counted only on request.
std::optional<StepRange> meetings_of(const RunOptions& options, const RunRequest& request) {
  if (options.audit_meetings == "off") return std::nullopt;
  try {
    if (!options.audit_meetings.empty()) return step_range(options.audit_meetings);
  } catch (const compare::InputError& error) {
    throw compare::InputError(std::string("--audit-meetings: ") + error.what() + ", or off");
  }
  const bool asks = request.audit == AuditMode::every && request.scale != "paper" &&
                    !request.scene.mesh.loose_edges.empty();
  return asks ? std::optional(StepRange{1, request.scene.settings.steps}) : std::nullopt;
}

RunRequest request_of(const RunOptions& options, const CommandContext& context) {
  const SolverOptions solver = options_of(parse_solver(options.solver));
  if (!std::ranges::count(backend_names, options.backend))
    throw compare::InputError("--backend " + options.backend + " does not exist; there are: " + backend_names[0] +
                              ", " + backend_names[1]);
  if (!solver.has_backends && options.backend != "cpu")
    throw compare::InputError("--solver " + options.solver + " runs on the CPU; leave --backend out");
  if (!solver.has_condition && options.condition) throw compare::InputError("--condition belongs to --solver newton");
  if (!solver.has_measured_residual && options.residual)
    throw compare::InputError("--solver " + options.solver +
                              " has a measure of its own in that column; leave --residual out");
  if (!solver.has_traced_rows && options.ledger)
    throw compare::InputError("--ledger belongs to --solver vbd: it is written from the trace of a step");
  RunRequest request;
  compare::SceneFile file = load_scene(options, request.scale);
  request.origin = file.origin;
  request.scene = std::move(file.scene);
  request.sources = std::move(file.sources);
  apply_settings(request.scene, options);
  require_settings(parse_solver(options.solver), options.assignments, request.scene.settings);
  check_jitter(options.jitter, request.scene.settings);
  request.jitter = options.jitter;
  request.tolerate_start = options.tolerate_start;
  request.solver = options.solver;
  request.backend = options.backend;
  request.iterations = options.iterations || options.condition;
  request.condition = options.condition;
  if (options.devices > 1 && options.backend != "cuda")
    throw compare::InputError("--devices " + std::to_string(options.devices) +
                              ": only CUDA devices divide a run; add --backend cuda, or leave --devices out");
  if (options.devices > 1 && (options.profile || options.iterations || options.ledger))
    throw compare::InputError("--devices " + std::to_string(options.devices) +
                              ": --profile, --iterations and --ledger follow one device; leave them or --devices out");
  request.audit_beside = options.backend == "cuda";
  request.residual = options.residual;
  request.ledger = options.ledger;
  request.repeats = options.repeats;
  request.audit = audit_mode(options.audit);
  request.meetings = meetings_of(options, request);
  request.deepest = options.deepest;
  request.checkpoint_seconds = options.checkpoint_seconds;
  if (!options.from_state.empty()) request.from_state = options.from_state;
  request.profile = options.profile;
  const std::string scale = request.scale.empty() ? "" : "-" + request.scale;
  request.folder = options.out.empty() ? "runs/" + request.scene.name + scale + "-" + utc_stamp() : options.out;
  request.show = options.show;
  request.command_line = context.command_line;
  return request;
}

compare::Contestant contestant_of(const RunOptions& options, const std::optional<StepRange>& meetings) {
  const Solver solver = parse_solver(options.solver);
  const Measured what{.residual = options.residual,
                      .iterations = options.iterations && options_of(solver).has_traced_rows,
                      .ledger = options.ledger,
                      .repeats = options.repeats,
                      .meetings = meetings};
  const compare::Contestant contestant = contestant_of(solver, options.backend == "cuda", options.devices);
  return what.any() ? measured(contestant, what) : contestant;
}

}  // namespace ogc::experiments
