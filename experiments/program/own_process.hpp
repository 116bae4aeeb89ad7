// Starts further processes of this program and waits for them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace ogc::experiments {

/// Starts this program with these words and discards its standard output. If `log` is not empty, standard error goes to
/// this file, and the terminal's interrupts do not reach the new process. If `log` is empty, standard error is ours,
/// and interrupts reach the new process. The new process is killed if this process ends first. Throws
/// std::runtime_error.
pid_t start_self(std::vector<std::string> words, const std::filesystem::path& log = {});

/// Waits for the process and returns its exit status as a shell reports it.
int status_of(pid_t child);

/// Holds one command of this program and its displayed name.
struct OwnCommand {
  std::string name;
  std::vector<std::string> words;
  std::filesystem::path log;  ///< removed if the command ends with status 0
};

/// Runs the commands in their order, at most `jobs` at a time. After an interrupt (interrupt.hpp) it starts no more
/// commands, asks the running ones to stop, and waits for them. Throws std::runtime_error.
void run_side_by_side(const std::vector<OwnCommand>& commands, int jobs);

}  // namespace ogc::experiments
