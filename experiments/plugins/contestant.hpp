// Makes a contestant of a plug-in, so that the judge drives it exactly as it drives ours.
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

/// Time that our contestant took for the questions that the plug-in answered, by stage [s].
using Times = std::map<std::string, double, std::less<>>;

/// Returns the plug-in as a contestant that asks `ours` the same question right after it, adds our time to `times`, and
/// discards our answer.
compare::Contestant timed_beside(compare::Contestant plugin, const compare::Contestant& ours,
                                 std::shared_ptr<Times> times);

}  // namespace ogc::experiments
