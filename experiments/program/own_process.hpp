// Other processes of this program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace ogc::experiments {

/// Starts this program with these words. What it prints as its result is dropped; what it logs goes to the file `log`,
/// and then an interrupt from the terminal does not reach it; or, where that is empty, to where ours goes. It is killed
/// where this process ends before it. Throws std::runtime_error.
pid_t start_self(std::vector<std::string> words, const std::filesystem::path& log = {});

/// Waits for it. Exit status, as a shell has it.
int status_of(pid_t child);

/// A command of this program, and how it is called on the screen.
struct OwnCommand {
  std::string name;
  std::vector<std::string> words;
  std::filesystem::path log;  ///< removed where it ends with status 0
};

/// Runs them in their order, at most `jobs` at a time. After an interrupt (interrupt.hpp) it starts none, asks those
/// that run to stop, and waits for them. Throws std::runtime_error.
void run_side_by_side(const std::vector<OwnCommand>& commands, int jobs);

}  // namespace ogc::experiments
