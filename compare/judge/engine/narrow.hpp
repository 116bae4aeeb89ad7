// Asks a contestant that may crash: narrows a batch without an answer down to the case that provokes it.
#pragma once

#include <mutex>

#include "compare/judge/engine/ask.hpp"

namespace ogc::compare {

/// Does what `ask` does. Where the contestant gives no answer (ContestantFailure), halves the batch until one case is
/// left; the case becomes a mismatch with the failure's message, and the rest is asked again. After `allowed` cases of
/// this kind the rest is left out.
void ask_narrowing(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
                   std::mutex& contestant_turn, std::uint64_t allowed, Tally& tally);

}  // namespace ogc::compare
