// Repeats a measurement in several processes, because only processes are independent samples of the noise. All
// repetitions inside one process share its memory layout and everything else that is fixed when a process starts.
// Measured on 2 cores: a benchmark of 16 us differed by 16 % between two processes, while repetitions within each
// process agreed to 5 %.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ogc::experiments {

/// Runs this program `count` times with `arguments` and `--json PART`, one run after the other. Writes all results to
/// `file` in Google Benchmark's format, each with the number of its "process". Throws std::runtime_error if a run
/// fails, and compare::ResourceError if the file can't be written.
void bench_in_processes(const std::vector<std::string>& arguments, int count, const std::filesystem::path& file);

}  // namespace ogc::experiments
