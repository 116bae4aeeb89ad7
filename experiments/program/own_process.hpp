// Starts further processes of this program and waits for them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace ogc::experiments {

/// Starts this program with these words. Its standard output is dropped. Its standard error goes to the file `log`, and
/// then an interrupt from the terminal does not reach it; with an empty `log` it goes to our standard error. The
/// process is killed if this process ends first. Throws std::runtime_error.
pid_t start_self(std::vector<std::string> words, const std::filesystem::path& log = {});

/// Waits for the process and returns its exit status in the form of a shell.
int status_of(pid_t child);

/// One command of this program and its name on the screen.
struct OwnCommand {
  std::string name;
  std::vector<std::string> words;
  std::filesystem::path log;  ///< is removed if the command ends with status 0
};

/// Runs the commands in their order, at most `jobs` at a time. After an interrupt (interrupt.hpp) it starts no more,
/// requests that the running ones stop, and waits for them. Throws std::runtime_error.
void run_side_by_side(const std::vector<OwnCommand>& commands, int jobs);

}  // namespace ogc::experiments
