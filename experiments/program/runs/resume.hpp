// Continues an interrupted run (`ogc run --resume RUN`) with the bits that it would have computed. The folder has all
// that this needs: run.json the program and options, scene/ the scene with its settings, checkpoint.h5 the state.
// Everything that could change a bit is compared before anything is computed, the cheapest first; a difference is
// refused.
#pragma once

#include "experiments/program/runs/run_options.hpp"

namespace ogc::experiments {

/// Returns the text of run.json under a key that only `ogc` uses; `otherwise` if the key is missing.
std::string text_in(const compare::Provenance& provenance, const std::string& key, const std::string& otherwise = "");

/// Holds what continues a run.
struct ResumedRun {
  RunOptions options;  ///< for contestant_of
  RunRequest request;  ///< for RunSession
};

/// Reads the run of the folder. Throws compare::InputError with a remedy: no run; a run that is finished, still
/// running, or of another program or device; a scene, checkpoint or rows that were changed or damaged. Throws
/// compare::ResourceError if the device does not exist. Changes nothing in the folder.
ResumedRun resumed_run(const std::filesystem::path& folder);

}  // namespace ogc::experiments
