// Runs of the program that real signals cut off, and what must not tell them from one that was left alone.
#pragma once

#include <filesystem>
#include <string>

namespace ogc::tests {

/// Frames byte by byte, rows of steps.csv and iterations.csv but for times, final hash, audited states.
void check_same_run(const std::filesystem::path& whole, const std::filesystem::path& resumed);

struct Cuts {
  int killed = 0, in_time = 0;  ///< of the cuts: those that met a run which had begun
};

/// `ogc run COMMAND` to its end in `run`, cut off by the signal (a name as kill takes it) after random fractions of
/// `seconds`, which should be about what the whole run takes, and resumed each time.
Cuts run_with_cuts(const std::string& command, const std::filesystem::path& run, const std::string& signal,
                   double seconds, unsigned seed);

/// Makes the whole run in `folder`, then one cut by each signal, and checks that each is the same.
void check_cut_runs(const std::filesystem::path& folder, const std::string& command,
                    std::initializer_list<std::string> signals);

}  // namespace ogc::tests
