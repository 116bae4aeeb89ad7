// Cuts runs of the program off by real signals and checks that their results equal those of an undisturbed run.
#pragma once

#include <filesystem>
#include <string>

namespace ogc::tests {

/// Checks that both runs have the same frames byte by byte, the same rows of steps.csv and iterations.csv except for
/// times, the same final hash, and the same number of audited states.
void check_same_run(const std::filesystem::path& whole, const std::filesystem::path& resumed);

struct Cuts {
  int killed = 0, in_time = 0;  ///< signals sent; signals that met a run after its start
};

/// Makes `ogc run COMMAND` in `run` and sends the signal (a name for kill) after random fractions of `seconds`, about
/// the duration of the whole run. Resumes the run each time until it ends.
Cuts run_with_cuts(const std::string& command, const std::filesystem::path& run, const std::string& signal,
                   double seconds, unsigned seed);

/// Makes the whole run in `folder`, then one run for each signal that is cut off by it, and checks that all results are
/// equal.
void check_cut_runs(const std::filesystem::path& folder, const std::string& command,
                    std::initializer_list<std::string> signals);

}  // namespace ogc::tests
