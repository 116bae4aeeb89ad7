#include "experiments/program/python_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "compare/problem/error.hpp"
#include "experiments/program/own_process.hpp"

extern char** environ;

namespace ogc::experiments {

namespace {

namespace fs = std::filesystem;

/// Lower priority of programs that nobody waits for.
constexpr int nice_value = 10;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

/// Returns the folder of the project, which has `plots`.
fs::path project() {
  const auto is_project = [](const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(folder / "plots" / "view.py", ignored);
  };
  if (const std::string named = variable("OGC_ROOT"); !named.empty()) {
    if (is_project(named)) return fs::absolute(named);
    throw compare::InputError("OGC_ROOT names " + named +
                              ", which has no plots/view.py; name a checkout of this project");
  }
  for (fs::path folder = own_folder(); folder != folder.root_path(); folder = folder.parent_path())
    if (is_project(folder)) return folder;
  throw compare::InputError(
      "pictures and USD files are made by Python in the project's folder plots, and no folder above this program has "
      "it; "
      "name a checkout of this project by the environment's OGC_ROOT");
}

std::string interpreter(const fs::path& root) {
  if (std::string named = variable("OGC_PYTHON"); !named.empty()) return named;
  std::error_code ignored;
  if (const fs::path own = root / ".venv" / "bin" / "python"; fs::exists(own, ignored)) return own.string();
  return "python3";
}

/// Returns our environment with the path of the project's modules, and the folder of the compiled ones.
std::vector<std::string> environment(const fs::path& root) {
  const std::string path = "PYTHONPATH=", modules = "OGC_MODULES=";
  const fs::path built = own_folder() / "python" / "ogc_testbed";
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (const std::string_view text = *entry; !text.starts_with(path) && !text.starts_with(modules))
      result.emplace_back(text);
  const std::string before = variable("PYTHONPATH");
  result.push_back(path + root.string() + (before.empty() ? "" : ":" + before));
  std::error_code ignored;
  if (fs::is_directory(built, ignored)) result.push_back(modules + built.string());
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

pid_t spawn(const std::string& module, std::vector<std::string> words, bool alone) {
  const fs::path root = project();
  const std::string python = interpreter(root);
  words.insert(words.begin(), {python, "-m", module});
  std::vector<std::string> variables = environment(root);
  const std::vector<char*> arguments = pointers(words), settings = pointers(variables);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t interrupts;
  sigemptyset(&interrupts);
  sigaddset(&interrupts, SIGINT);
  posix_spawnattr_setsigdefault(&attributes, &interrupts);
  posix_spawnattr_setflags(&attributes, static_cast<short>(POSIX_SPAWN_SETSIGDEF | (alone ? POSIX_SPAWN_SETSID : 0)));
  if (alone) {
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    // A pipe would have no end as long as the viewer is open, and its reader would wait for it.
    if (isatty(STDERR_FILENO) == 0) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  }
  pid_t process = -1;
  const int error = posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), settings.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw compare::InputError("the interpreter " + python + " can't be started (" + std::strerror(error) +
                              "); name one by the environment's OGC_PYTHON, or make the project's own by tests/run");
  if (alone) setpriority(PRIO_PROCESS, static_cast<id_t>(process), nice_value);
  return process;
}

}  // namespace

int run_python(const std::string& module, std::vector<std::string> words) {
  // An interrupt of the terminal reaches both processes. Python ends by it, and its status is ours.
  const auto before = std::signal(SIGINT, SIG_IGN);
  try {
    const int status = status_of(spawn(module, std::move(words), false));
    std::signal(SIGINT, before);
    return status;
  } catch (...) {
    std::signal(SIGINT, before);
    throw;
  }
}

void start_python(const std::string& module, std::vector<std::string> words) { spawn(module, std::move(words), true); }

ScratchFolder::ScratchFolder() {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "ogc-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr)
    throw compare::ResourceError("no temporary folder can be made (" + std::string(std::strerror(errno)) +
                                 "); name another place by the environment's TMPDIR");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!released_) fs::remove_all(path_, ignored);
}

}  // namespace ogc::experiments
