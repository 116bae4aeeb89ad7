// Reports what a comparison with a plug-in adds to the judge's table: the plug-in's time beside ours, and unusual
// outputs.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/judge.hpp"
#include "experiments/plugins/contestant.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// Holds what was observed of the judged plug-in before failing cases were repeated.
struct PluginSeen {
  std::string name, backend;  ///< name of the plug-in, and of our contestant that answered beside it
  Times ours;                 ///< times of our contestant
  PluginNotes notes;          ///< notes of the plug-in's process
};

/// Returns a table of times, followed by a line for each output that contained NaN or was not written. The plug-in's
/// times cover its functions alone; ours include copies to and from the backend.
std::string plugin_text(const PluginSeen& seen, std::span<const compare::StageReport> reports);
Json plugin_json(const PluginSeen& seen, std::span<const compare::StageReport> reports);

}  // namespace ogc::experiments
