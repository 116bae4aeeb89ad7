// Cuts runs of the program off by real signals and checks that they end as an undisturbed run does.
#pragma once

#include <filesystem>
#include <string>

namespace ogc::tests {

/// Checks that both have the same frames byte by byte, rows of steps.csv and iterations.csv but for times, final hash
/// and audited states.
void check_same_run(const std::filesystem::path& whole, const std::filesystem::path& resumed);

struct Cuts {
  int killed = 0, in_time = 0;  ///< in_time: cuts that met a run which had begun
};

/// Makes `ogc run COMMAND` in `run`, cut off by the signal (a name that kill takes) after random fractions of
/// `seconds`, about the time of the whole run, and resumed each time until it ends.
Cuts run_with_cuts(const std::string& command, const std::filesystem::path& run, const std::string& signal,
                   double seconds, unsigned seed);

/// Makes the whole run in `folder`, then one cut off by each signal, and checks that each is the same.
void check_cut_runs(const std::filesystem::path& folder, const std::string& command,
                    std::initializer_list<std::string> signals);

}  // namespace ogc::tests
