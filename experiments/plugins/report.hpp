// Reports what a comparison with a plug-in adds to the judge's table: its time beside ours, and unusual outputs.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/judge.hpp"
#include "experiments/plugins/contestant.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// Observations of the judged plug-in; taken before failing cases are asked again.
struct PluginSeen {
  std::string name, backend;  ///< name of the plug-in, and of our contestant that answered beside it
  Times ours;                 ///< times of our contestant
  PluginNotes notes;          ///< notes of the plug-in's process
};

/// Returns a table of times (the plug-in's functions alone; ours with its copies to and from the backend), then a line
/// for each output that held NaN or was not written.
std::string plugin_text(const PluginSeen& seen, std::span<const compare::StageReport> reports);
Json plugin_json(const PluginSeen& seen, std::span<const compare::StageReport> reports);

}  // namespace ogc::experiments
