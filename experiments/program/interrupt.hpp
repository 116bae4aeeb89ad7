// Ctrl-C asks a run to stop after the step that it computes, so that its folder stays whole; a second one ends the
// program at once.
#pragma once

#include <csignal>

namespace ogc::experiments {

/// Exit status of a command that was stopped so: what a shell reports for a program that Ctrl-C ended.
inline constexpr int exit_interrupted = 128 + SIGINT;

/// From now on the first SIGINT or SIGTERM sets the flag, the second one does what it always does.
void catch_interrupts();

/// Whether the flag is set.
bool interrupted();

}  // namespace ogc::experiments
