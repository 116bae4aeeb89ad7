// From cases to the questions of a stage.
#pragma once

#include <mutex>

#include "compare/judge/tally.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

/// Puts cases of one stage to both sides and judges the answers. `contestant_turn` is held while the contestant is
/// asked; its name says nothing of whether it may be asked by two threads at once.
void ask(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
         std::mutex& contestant_turn, Tally& tally);

}  // namespace ogc::compare
