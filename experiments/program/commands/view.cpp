// `ogc view`: shows a run, meshes, a scene or frames. It reads them and starts the viewer, a Python program (plots/).
#include <array>
#include <memory>
#include <optional>

#include "compare/problem/error.hpp"
#include "compare/problem/ranges.hpp"
#include "experiments/program/commands.hpp"
#include "experiments/program/option_checks.hpp"
#include "experiments/program/python_program.hpp"
#include "experiments/program/runs/sheet.hpp"

namespace ogc::experiments {

namespace {

constexpr double most_megabytes = 1e6, most_rate = 1000;

struct ViewOptions {
  SheetRequest request;
  std::string beside, colour = "body", png, mp4, html;
  bool contacts = false, planes = false, yes = false, follow = false;
  std::optional<std::int64_t> step;
  std::optional<double> rate, megabytes;
};

/// Returns the viewer's words besides what it shows.
std::vector<std::string> words_of(const ViewOptions& options, bool is_run) {
  std::vector<std::string> words{"--colour", options.colour, "--name", options.request.source.paths.front()};
  const auto add = [&](bool wanted, std::vector<std::string> more) {
    if (wanted) words.insert(words.end(), more.begin(), more.end());
  };
  add(options.contacts, {"--contacts"});
  add(options.planes, {"--planes"});
  add(options.yes, {"--yes"});
  add(options.follow, {"--follow"});
  add(is_run, {"--every", std::to_string(options.request.every)});
  if (options.step) add(true, {"--step", std::to_string(*options.step)});
  if (options.rate) add(true, {"--fps", std::to_string(*options.rate)});
  if (options.megabytes) add(true, {"--megabytes", std::to_string(*options.megabytes)});
  add(!options.png.empty(), {"--png", options.png});
  add(!options.mp4.empty(), {"--mp4", options.mp4});
  add(!options.html.empty(), {"--html", options.html});
  return words;
}

bool is_run(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(std::filesystem::path(path) / "run.json", ignored);
}

int view(const ViewOptions& options) {
  const std::string& target = options.request.source.paths.front();
  if (options.follow && (!is_run(target) || !options.beside.empty() || !options.mp4.empty() || !options.html.empty()))
    throw compare::InputError("--follow shows a run that goes on, alone, in a window or by --png");
  // First whether there is a display and all packages: reading a long sequence may take minutes.
  std::vector<std::string> words = words_of(options, is_run(target));
  std::vector<std::string> check = words;
  check.insert(check.begin(), {target, "--check"});
  if (const int status = run_python("plots.view", check); status != 0) return status;
  const ScratchFolder first, second;
  write_sheet(first.path(), options.request);
  words.insert(words.begin(), first.path().string());
  if (!options.beside.empty()) {
    SheetRequest other = options.request;
    other.source.paths = {options.beside};
    write_sheet(second.path(), other);
    words.insert(words.end(), {"--beside", second.path().string()});
  }
  return run_python("plots.view", words);
}

}  // namespace

void add_view_command(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("view", "Show a run, meshes, a scene or frames, in a window or as a file");
  SheetRequest& request = options->request;
  command
      ->add_option("RUN|MESH|SCENE|FRAMES", request.source.paths,
                   "A run folder, finished or not; a scene's name or file; or meshes and frames of any program, as ogc "
                   "audit reads them")
      ->required();
  command->add_option("--beside", options->beside, "A second one, shown beside the first, at the same times");
  command->add_option("--png", options->png, "This file gets a picture of one frame; no display is needed");
  command->add_option("--mp4", options->mp4, "This file gets a movie of all frames; no display is needed");
  command->add_option("--html", options->html, "This file gets a page that any browser opens offline, with a timeline");
  command
      ->add_option(
          "--colour,--color", options->colour,
          "What vertices are coloured by: body, speed, bound, distance (to the nearest), contact force; and, of "
          "runs with --residual or --ledger, residual or cut")
      ->capture_default_str();
  command->add_flag("--contacts", options->contacts, "A segment joins the closest points of each contact");
  command->add_flag("--planes", options->planes, "A cross lies in the plane across the middle of each contact");
  command->add_option("--step", options->step, "The frame nearest to this step is shown first (default: the last)")
      ->check(whole_number(0, most_counted));
  command->add_option("--every", request.every, "Of the frames each of this distance is shown, and the last")
      ->check(whole_number(1, most_counted))
      ->capture_default_str();
  command->add_option("--fps", options->rate, "Frames of a movie in a second (default: as long as the motion)")
      ->check(real_number(0.1, most_rate, "1/s"));
  command
      ->add_option("--megabytes", options->megabytes,
                   "A page of more leaves out colours and contacts (default: 10, or 10 bytes for each vertex of each "
                   "frame)")
      ->check(real_number(0.1, most_megabytes, "MB"));
  command->add_option("--scale", request.scale, "A built-in scene has this size: smoke, small or paper");
  command
      ->add_option("--radius", request.radius, "The contact radius of meshes (default: a quarter of their median edge)")
      ->check(real_number(1e-9, compare::most_length, "m"));
  command->add_option("--mesh", request.source.topology, "The triangles of .npy or .pc2 frames are in this mesh");
  command->add_flag("--follow", options->follow, "The newest frame of a run that goes on is shown, as it comes");
  command->add_flag("--yes", options->yes, "Packages that are missing are installed without a question");
  command->footer(
      "Examples:\n"
      "  ogc view runs/my_run                                     # a window: scrub, colour, pick a vertex\n"
      "  ogc view runs/my_run --png view.png --colour distance --contacts\n"
      "  ogc view runs/my_run --beside runs/other --html both.html\n"
      "  ogc view my.obj --html my.html\n"
      "  ogc view cloth_on_sphere --scale smoke --png start.png\n"
      "  ogc view runs/my_run --mp4 my_run.mp4 --every 2\n\n"
      "Viewing needs Python, which this program does not contain: the interpreter that OGC_PYTHON names, else the one "
      "of the project's\n"
      ".venv, else python3. A window needs polyscope (14 MB), pictures PyVista (580 MB), movies imageio; what is "
      "missing "
      "is named, and installed\n"
      "into that interpreter's environment after a question. A page needs none of them: NumPy, and h5py for runs.\n"
      "A page stores positions as multiples of the largest extent over 65534, so that they are off by half of that at "
      "most, and values of\n"
      "colours as one of 255; its size and error are printed. Exit status 3: there is no display.");
  command->callback([options, &context] { context.status = view(*options); });
}

}  // namespace ogc::experiments
