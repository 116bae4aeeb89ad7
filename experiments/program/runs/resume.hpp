// Going on with a run that was cut off (`ogc run --resume RUN`) to the bits that it would have come to. What it needs
// stands in the folder: run.json says by what and with which options it was computed, scene/ holds the scene with its
// settings, checkpoint.h5 the state. What could change a bit is compared and refused, the cheapest first, and all of it
// before anything is computed.
#pragma once

#include "experiments/program/runs/run_options.hpp"

namespace ogc::experiments {

/// What run.json says under a key that only `ogc` knows; `otherwise` where it says nothing.
std::string text_in(const compare::Provenance& provenance, const std::string& key, const std::string& otherwise = "");

/// What a run that goes on is computed by, and what it is asked.
struct ResumedRun {
  RunOptions options;  ///< for contestant_of
  RunRequest request;  ///< for RunSession
};

/// The run of the folder. Throws compare::InputError that says what to do: no run, finished, still going on, of another
/// program or device; scene, checkpoint or rows changed or damaged. Throws compare::ResourceError where there is no
/// such device. Changes nothing in the folder.
ResumedRun resumed_run(const std::filesystem::path& folder);

}  // namespace ogc::experiments
