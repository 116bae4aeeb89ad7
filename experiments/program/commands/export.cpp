// `ogc export`: writes frames as mesh files.
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "compare/record/export.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/python_program.hpp"
#include "experiments/program/runs/sheet.hpp"

namespace ogc::experiments {

namespace {

struct ExportOptions {
  std::string folder, format = "vtp", out;
  bool yes = false;
};

/// Returns the files of a format that this program writes by itself.
std::vector<std::filesystem::path> meshes_of(const ExportOptions& options, const std::filesystem::path& out) {
  const compare::ExportFormat format = compare::parse_export_format(options.format);
  std::optional<Progress> progress;
  return compare::export_run(options.folder, format, out, [&](std::size_t done, std::size_t of) {
    if (!progress) progress.emplace(0, static_cast<std::int64_t>(of), "frame");
    progress->show(static_cast<std::int64_t>(done), "");
  });
}

/// Returns the one file of USD, which a Python program writes.
std::vector<std::filesystem::path> usd_of(const ExportOptions& options, const std::filesystem::path& out) {
  const compare::RunReader run(options.folder);
  if (run.frame_count() == 0)
    throw compare::InputError(options.folder + ": has no finished frame yet: let the run go on, or run it again");
  const ScratchFolder sheet;
  write_run_sheet(sheet.path(), options.folder, run.scene().mesh);
  const std::filesystem::path file = out / (run.scene().name + ".usdc");
  std::vector<std::string> words{sheet.path().string(), "--out", file.string()};
  if (options.yes) words.emplace_back("--yes");
  if (run_python("plots.usd", words) != 0) return {};
  return {file};
}

void run_export(const ExportOptions& options, CommandContext& context) {
  const std::filesystem::path out = options.out.empty() ? std::filesystem::path(options.folder) / options.format
                                                        : std::filesystem::path(options.out);
  const std::vector<std::filesystem::path> files = options.format == "usd" ? usd_of(options, out)
                                                                           : meshes_of(options, out);
  if (files.empty()) {
    context.status = exit_bad_input;
    return;
  }
  const std::filesystem::path trajectory = std::filesystem::path(options.folder) / "trajectory.vtkhdf";
  if (!std::filesystem::exists(trajectory)) {
    compare::assemble_trajectory(options.folder);
    log_line("the run had not been finished: assembled " + trajectory.string());
  }
  if (!context.json)
    return print_result(counted(files.size(), "file") + " in " + out.string() +
                        ", the last: " + files.back().filename().string() + "\n");
  Json json{{"folder", out.string()}, {"format", options.format}, {"files", Json::array()}};
  for (const std::filesystem::path& file : files) json["files"].push_back(file.string());
  print_result(json);
}

}  // namespace

void add_export_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "Write the frames of a run as mesh files");
  command->add_option("RUN", options->folder, "A run folder, finished or not")->required();
  command
      ->add_option("--format", options->format,
                   "obj, ply, vtp (with velocity, bound, body and a .pvd index for ParaView), or vtu (the same with "
                   "tetrahedra and their J, volume over volume at rest), or usd (one file; needs Python's usd-core)")
      ->check(CLI::IsMember({"obj", "ply", "vtp", "vtu", "usd"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for the files (default: RUN/FORMAT)");
  command->add_flag("--yes", options->yes, "usd: what is missing of Python's packages is installed without a question");
  command->add_flag("--json", context.json, "Print the names of the files as JSON on standard output");
  command->footer(
      "The run's own trajectory.vtkhdf opens in ParaView 5.13 and later without any export; it is assembled here where "
      "a run was killed\n"
      "before it could do so.\n\n"
      "Examples:\n"
      "  ogc export runs/twist-small-20250801-120000\n"
      "  ogc export runs/twist-small-20250801-120000 --format obj --out meshes\n"
      "  ogc export runs/twist-small-20250801-120000 --format usd");
  command->callback([options, &context] { run_export(*options, context); });
}

}  // namespace ogc::experiments
