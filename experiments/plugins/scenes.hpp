// Puts the questions about whole scenes to a plug-in: rest_state, sweep and step.
#pragma once

#include "compare/contestant.hpp"
#include "compare/stages/step.hpp"
#include "experiments/plugins/process.hpp"

namespace ogc::experiments {

/// Return the plug-in's answer to the stage `rest_state`. All three functions throw compare::ContestantFailure if there
/// is no answer; ask_step also throws it if the lists of a trace are inconsistent.
compare::RestStateOut ask_rest_state(PluginProcess& plugin, const compare::RestStateIn& in);
/// Returns the plug-in's answer to the stage `sweep`.
compare::SweepOut ask_sweep(PluginProcess& plugin, const compare::SweepIn& in);
/// Returns the plug-in's answer to the stage `step`.
compare::StepOut ask_step(PluginProcess& plugin, const compare::StepIn& in);

}  // namespace ogc::experiments
