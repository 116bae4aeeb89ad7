// Lets Ctrl-C stop a run after its current step, so that the run folder stays complete. A second Ctrl-C ends the
// program at once.
#pragma once

#include <csignal>

namespace ogc::experiments {

/// Exit status after an interruption; a shell reports the same status for a program that Ctrl-C ended.
inline constexpr int exit_interrupted = 128 + SIGINT;

/// Makes the first SIGINT or SIGTERM set a flag. A second signal has its default effect.
void catch_interrupts();

/// Returns whether the flag is set.
bool interrupted();

}  // namespace ogc::experiments
