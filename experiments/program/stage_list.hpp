// `ogc compare --list` and `--determinism`: what the registry of stages says, and whether the bits are as repeatable as
// it says.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/determinism.hpp"
#include "experiments/program/output.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

/// The table of compare/README.md: a row for each stage with its contract, its question, who answers it, its
/// generators, agreement tests and determinism.
std::string stage_list_markdown();

/// The same for a terminal, with each stage's generators and parameters by name.
std::string stage_list_text();

/// Checks determinism of the stages on a backend; on the CPU with one and two threads beside all of them, on a
/// device with other blocks and as on devices of other sizes.
std::vector<compare::DeterminismReport> determinism_of(fast::Backend backend, std::span<const compare::Stage> stages,
                                                       std::uint64_t cases, std::uint64_t seed);

/// The report of `ogc compare --determinism --json`.
Json determinism_json(std::span<const compare::DeterminismReport> reports);

}  // namespace ogc::experiments
