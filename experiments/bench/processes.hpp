// Repeats a measurement in several processes. Repetitions inside one process share the placement of its memory and
// whatever else a start decides: measured on 2 cores, a part of 16 us differed by 16 % between two starts of one
// program, whose own repetitions agreed to 5 %. Only processes are samples of that noise.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ogc::experiments {

/// Runs this program `count` times with `arguments` and `--json PART`, one after the other, and writes all results to
/// `file`, each with its "process", in Google Benchmark's format. Throws std::runtime_error if one fails,
/// compare::ResourceError if the file can't be written.
void bench_in_processes(const std::vector<std::string>& arguments, int count, const std::filesystem::path& file);

}  // namespace ogc::experiments
