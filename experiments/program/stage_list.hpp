// Implements `ogc compare --list` and `--determinism`: lists what the registry of stages declares, and checks whether
// the bits are as repeatable as declared.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/determinism.hpp"
#include "experiments/program/output.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

/// Returns the table of compare/README.md: a row for each stage with its contract, its question, the implementations
/// that have it, its generators, agreement tests and determinism.
std::string stage_list_markdown();

/// Returns the same list for a terminal, with the names of each stage's generators and parameters.
std::string stage_list_text();

/// Checks the determinism of stages on a backend: on the CPU with one and two threads besides all of them, on a device
/// with other block sizes and with the launches of devices of other sizes.
std::vector<compare::DeterminismReport> determinism_of(fast::Backend backend, std::span<const compare::Stage> stages,
                                                       std::uint64_t cases, std::uint64_t seed);

/// Returns the report of `ogc compare --determinism --json`.
Json determinism_json(std::span<const compare::DeterminismReport> reports);

}  // namespace ogc::experiments
