// Wraps a plug-in as a contestant, so that the judge treats it exactly like ours.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "compare/contestant.hpp"
#include "experiments/plugins/process.hpp"

namespace ogc::experiments {

/// Returns a contestant with the stages that the plug-in offers. Each stage throws ContestantFailure if there is no
/// answer that can be judged.
compare::Contestant plugin_contestant(std::shared_ptr<PluginProcess> plugin);

/// Times of our contestant by stage [s], for the questions that the plug-in answered.
using Times = std::map<std::string, double, std::less<>>;

/// Returns the plug-in as a contestant that also puts each question to `ours`, right after the plug-in's answer. The
/// result adds our time to `times` and discards our answer.
compare::Contestant timed_beside(compare::Contestant plugin, const compare::Contestant& ours,
                                 std::shared_ptr<Times> times);

}  // namespace ogc::experiments
