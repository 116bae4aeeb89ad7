// What a comparison with a plug-in says beyond the judge's table: its time beside ours, and what else was seen.
#pragma once

#include <span>
#include <string>

#include "compare/judge/engine/judge.hpp"
#include "experiments/plugins/contestant.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

/// What was seen while the plug-in was judged; taken before failing cases are asked again.
struct PluginSeen {
  std::string name, backend;  ///< of the plug-in, and ours that answered beside it
  Times ours;                 ///< of our contestant
  PluginNotes notes;          ///< of the plug-in's process
};

/// A table of times (the plug-in's functions alone; ours with its copies to and from the backend), then a line for each
/// output that held NaN or was not written.
std::string plugin_text(const PluginSeen& seen, std::span<const compare::StageReport> reports);
Json plugin_json(const PluginSeen& seen, std::span<const compare::StageReport> reports);

}  // namespace ogc::experiments
