// Interrupts runs of the program by real signals and checks that their results equal those of an uninterrupted run.
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

/// Runs `ogc run COMMAND` with the output folder `run`, which takes about `seconds` in all. Sends `signal` (a name for
/// the command kill) after random fractions of this time. Resumes the run after each signal until it ends.
Cuts run_with_cuts(const std::string& command, const std::filesystem::path& run, const std::string& signal,
                   double seconds, unsigned seed);

/// Makes an uninterrupted run in `folder`. Then makes one run for each signal, interrupted by this signal, and checks
/// that all results are equal.
void check_cut_runs(const std::filesystem::path& folder, const std::string& command,
                    std::initializer_list<std::string> signals);

}  // namespace ogc::tests
