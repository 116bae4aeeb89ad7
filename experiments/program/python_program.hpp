// Starts the Python programs of this project: the viewer and the reader and writer of USD (plots/). The program `ogc`
// contains no Python. It takes the interpreter that OGC_PYTHON of the environment names, else that of the project's
// .venv, else python3; and the project that OGC_ROOT names, else the one whose folder contains this program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ogc::experiments {

/// Runs `python -m MODULE WORDS…` and returns its exit status as a shell reports it. Standard output and standard error
/// are ours. Interrupts of the terminal are left to it. Throws compare::InputError if there is no project or no
/// interpreter, and says how to name one.
int run_python(const std::string& module, std::vector<std::string> words);

/// Starts the same and does not wait. The process has a lower priority and a session of its own, so that it neither
/// slows this program nor ends with it; it has no input, and prints on a terminal alone. Throws as run_python does.
void start_python(const std::string& module, std::vector<std::string> words);

/// A new folder in the system's folder of temporary files, which the destructor removes if it is still there. Throws
/// compare::ResourceError if it can't be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Leaves the folder to another process, which removes it.
  void release() { released_ = true; }

 private:
  std::filesystem::path path_;
  bool released_ = false;
};

}  // namespace ogc::experiments
