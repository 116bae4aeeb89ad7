// Implements `ogc compare --list` and `--determinism`: lists the registry of stages, and checks whether bits are as
// repeatable as the registry declares.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/determinism.hpp"
#include "experiments/program/output.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

/// Returns the table of compare/README.md with a row for each stage: contract, question, implementations, generators,
/// agreement tests and determinism.
std::string stage_list_markdown();

/// Returns the same list for a terminal, with each stage's generators and parameters.
std::string stage_list_text();

/// Returns the same list for programs.
Json stage_list_json();

/// Checks whether the stages return the same bits in repeated calls on a backend. The CPU also repeats them with one
/// thread and with two threads. A device also repeats them with other block sizes, and with launches that are divided
/// for other numbers of multiprocessors.
std::vector<compare::DeterminismReport> determinism_of(fast::Backend backend, std::span<const compare::Stage> stages,
                                                       std::uint64_t cases, std::uint64_t seed);

/// Returns the report of `ogc compare --determinism --json`.
Json determinism_json(std::span<const compare::DeterminismReport> reports);

}  // namespace ogc::experiments
