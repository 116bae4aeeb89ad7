// A plug-in as a contestant, so that the judge drives it exactly as it drives ours.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "compare/contestant.hpp"
#include "experiments/plugins/process.hpp"

namespace ogc::experiments {

/// The stages that the plug-in offers. Each throws ContestantFailure where there is no answer that can be judged.
compare::Contestant plugin_contestant(std::shared_ptr<PluginProcess> plugin);

/// Time that ours took for the questions that the plug-in answered, by stage [s].
using Times = std::map<std::string, double, std::less<>>;

/// The plug-in, and, asked the same question right after it, ours, whose answer is timed and thrown away.
compare::Contestant timed_beside(compare::Contestant plugin, const compare::Contestant& ours,
                                 std::shared_ptr<Times> times);

}  // namespace ogc::experiments
