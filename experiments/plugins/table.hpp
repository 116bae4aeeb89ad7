// Prints the descriptions of stages and structures as JSON: for `ogc compare --list --json`, and for the worker in
// Python.
#pragma once

#include <string>

#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// Returns `version` of compare/plugin.h, its `stages` and `structures`. A stage has the names of its function and of
/// its two structures, and the number of its input arrays. A structure has its size and its members in order. A member
/// has its `offset`, a `role`, a `type` (of NumPy, or a structure) and a `shape`, whose lengths are numbers or, for
/// arrays, members of the question, and for a list the member that counts it. `list` numbers lists; `question` is the
/// place of a number in QuestionSizes.
Json plugin_table();

/// Returns what a worker in Python receives first: the table, the layout of messages, and the source of
/// ogc_testbed.kernels.
std::string python_layout();

/// Returns the source of the worker in Python.
std::string python_worker();

/// Returns the source of ogc_testbed.kernels.
std::string python_kernels();

}  // namespace ogc::experiments
