// `ogc scenes`: lists the built-in scenes, and writes them to editable files.
#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "compare/files/durable_file.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/run_options.hpp"
#include "experiments/scenes/registry.hpp"

namespace ogc::experiments {

namespace {

constexpr std::array<std::string_view, 3> scale_names{"smoke", "small", "paper"};

struct ScenesOptions {
  std::string scene, folder, scale = "small";
  std::vector<std::string> assignments;
  bool schema = false, force = false;
};

struct Size {
  std::string scale;
  std::size_t vertices, triangles;
  std::int64_t steps;
};

Size size_of(const compare::Scene& scene, std::string_view scale) {
  return {std::string(scale), scene.mesh.positions.size(), scene.mesh.triangles.size(), scene.settings.steps};
}

std::vector<Size> sizes(const SceneInfo& info) {
  std::vector<Size> all;
  for (const std::string_view scale : scale_names)
    all.push_back(size_of(make_scene(info.name, parse_scale(scale)), scale));
  return all;
}

Json to_json(const SceneInfo& info) {
  Json json{{"name", info.name}, {"figure", info.figure}, {"summary", info.summary}, {"scales", Json::array()}};
  for (const Size& size : sizes(info))
    json["scales"].push_back(
        {{"scale", size.scale}, {"vertices", size.vertices}, {"triangles", size.triangles}, {"steps", size.steps}});
  return json;
}

void list(const CommandContext& context) {
  Json json{{"scenes", Json::array()}};
  std::vector<std::vector<std::string>> rows{{"scene", "figure", "scale", "vertices", "triangles", "steps"}};
  std::string summaries;
  for (const SceneInfo& info : scenes()) {
    if (context.json) {
      json["scenes"].push_back(to_json(info));
      continue;
    }
    for (const Size& size : sizes(info))
      rows.push_back({std::string(info.name), std::string(info.figure), size.scale, std::to_string(size.vertices),
                      std::to_string(size.triangles), std::to_string(size.steps)});
    summaries += std::string(info.name) + ": " + std::string(info.summary) + "\n";
  }
  if (context.json) return print_result(json);
  print_result(table(rows, 3) + "\n" + summaries);
}

void show(const std::string& name, const CommandContext& context) {
  const compare::Scene scene = make_scene(name, Scale::small);
  const SceneInfo& info = *std::ranges::find(scenes(), name, &SceneInfo::name);
  if (context.json) return print_result(to_json(info));
  std::vector<std::vector<std::string>> rows{{"scale", "vertices", "triangles", "steps"}};
  for (const Size& size : sizes(info))
    rows.push_back(
        {size.scale, std::to_string(size.vertices), std::to_string(size.triangles), std::to_string(size.steps)});
  std::vector<std::vector<std::string>> settings;
  for (const compare::SettingInfo& setting : compare::setting_table())
    settings.push_back({std::string(setting.name),
                        setting.choices.empty() ? number(compare::get_setting(scene.settings, setting), 6)
                                                : compare::setting_text(scene.settings, setting),
                        setting.unit == "1" ? "" : std::string(setting.unit)});
  print_result(name + " (" + std::string(info.figure) + "): " + std::string(info.summary) + "\n\n" + table(rows, 1) +
               "\nsettings at small\n" + table(settings, 3));
}

/// Moves the files of `from` to `folder`. Throws and moves no file if the folder already holds one of them and `force`
/// is false.
void move_files(const std::filesystem::path& from, const std::filesystem::path& folder, bool force) {
  std::string there;
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(from)) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  for (const auto& name : names)
    if (std::filesystem::exists(folder / name)) there += (there.empty() ? "" : ", ") + name.string();
  if (!there.empty() && !force)
    throw compare::InputError(folder.string() + ": holds " + there +
                              " already: name another folder, or write over them with --force");
  for (const auto& name : names) std::filesystem::rename(from / name, folder / name);
}

/// Writes the files of the scene. They first go to a folder beside the destination, because their names are known only
/// after writing.
std::filesystem::path write_files(const ScenesOptions& options) {
  const compare::Scene scene = make_scene(options.scene, parse_scale(options.scale), data_folder(options.assignments));
  const std::filesystem::path folder(options.folder), partial = compare::partial_name(folder / options.scene);
  std::filesystem::remove_all(partial);
  const std::filesystem::path name = compare::write_scene(partial, scene).filename();
  try {
    move_files(partial, folder, options.force);
  } catch (const std::exception&) {
    std::filesystem::remove_all(partial);
    throw;
  }
  std::filesystem::remove(partial);
  return folder / name;
}

void write(const ScenesOptions& options, const CommandContext& context) {
  const std::filesystem::path file = write_files(options);
  if (context.json) return print_result(Json{{"written", file.string()}});
  print_result(file.string() + "\n");
}

void run_scenes(const ScenesOptions& options, const CommandContext& context) {
  if (options.schema) return print_result(compare::scene_schema() + "\n");
  if (!options.folder.empty() && options.scene.empty())
    throw compare::InputError("--write needs a scene: ogc scenes NAME --write DIR");
  for (const std::string& assignment : options.assignments) {
    if (options.folder.empty() || !assignment.starts_with("data="))
      throw compare::InputError("--set " + assignment +
                                ": only data=DIR, and only with --write; settings stand in the file that is written");
  }
  if (options.force && options.folder.empty()) throw compare::InputError("--force belongs to --write DIR");
  if (options.scene.empty()) return list(context);
  if (options.folder.empty()) return show(options.scene, context);
  write(options, context);
}

}  // namespace

void add_scenes_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<ScenesOptions>();
  CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes, show one, or write one as files to edit");
  command->add_option("NAME", options->scene, "A scene; without it all are listed");
  command->add_option("--write", options->folder, "Write NAME.json and its meshes into this folder");
  command->add_flag("--force", options->force, "With --write: files of these names are written over");
  command->add_option("--scale", options->scale, "--write writes this size: smoke, small or paper")
      ->capture_default_str();
  command
      ->add_option("--set", options->assignments,
                   "data=DIR: dress is written from Codimensional IPC's published files in DIR")
      ->take_all()
      ->type_size(1)
      ->expected(1);
  command->add_flag("--schema", options->schema, "Print the JSON Schema of scene files");
  command->add_flag("--json", context.json, "Print the result as JSON on standard output");
  command->footer(
      "A scene file of your own needs only what differs from the defaults: experiments/examples/drop/drop.json has "
      "eight lines.\n\n"
      "Examples:\n"
      "  ogc scenes\n"
      "  ogc scenes cloth_on_sphere --write mine --scale smoke    # then edit mine/cloth_on_sphere.json and: ogc run "
      "mine/cloth_on_sphere.json");
  command->callback([options, &context] { run_scenes(*options, context); });
}

}  // namespace ogc::experiments
