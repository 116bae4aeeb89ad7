// The stages that are asked about a whole scene: rest_state, sweep and step.
#pragma once

#include "compare/contestant.hpp"
#include "compare/stages/step.hpp"
#include "experiments/plugins/process.hpp"

namespace ogc::experiments {

/// The plug-in's answers. Throw compare::ContestantFailure where there is none, and ask_step where the lists of a trace
/// do not fit together.
compare::RestStateOut ask_rest_state(PluginProcess& plugin, const compare::RestStateIn& in);
/// Stage sweep of the plug-in.
compare::SweepOut ask_sweep(PluginProcess& plugin, const compare::SweepIn& in);
/// Stage step of the plug-in.
compare::StepOut ask_step(PluginProcess& plugin, const compare::StepIn& in);

}  // namespace ogc::experiments
