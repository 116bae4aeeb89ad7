// Continues an interrupted run (`ogc run --resume RUN`) with the bits of an uninterrupted one. The folder has all that
// this needs: program and options in run.json, the scene with its settings in scene/, the state in checkpoint.h5.
// Before anything is computed, all data that could change a bit are compared with this program and device. A difference
// is an error.
#pragma once

#include "experiments/program/runs/run_options.hpp"

namespace ogc::experiments {

/// Returns the text of run.json under a key that only `ogc` uses, or `otherwise` if the key is missing.
std::string text_in(const compare::Provenance& provenance, const std::string& key, const std::string& otherwise = "");

/// Holds the data with which a run continues.
struct ResumedRun {
  RunOptions options;  ///< argument of contestant_of
  RunRequest request;  ///< argument of RunSession
};

/// Reads the run in the folder and changes nothing there. Throws compare::InputError with a remedy if there is no run;
/// if the run is finished, still active, or from another program or device; or if its scene, checkpoint or rows were
/// changed or damaged. Throws compare::ResourceError if the device does not exist.
ResumedRun resumed_run(const std::filesystem::path& folder);

}  // namespace ogc::experiments
