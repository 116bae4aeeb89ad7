// Questions to a contestant that may crash: from a batch without an answer to the case that provokes it.
#pragma once

#include <mutex>

#include "compare/judge/engine/ask.hpp"

namespace ogc::compare {

/// As `ask`. Where the contestant gives no answer (ContestantFailure), halves of the batch are asked until one case is
/// left; it becomes a mismatch with the failure's message, and the rest is asked again. After `allowed` such cases the
/// rest is left out.
void ask_narrowing(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
                   std::mutex& contestant_turn, std::uint64_t allowed, Tally& tally);

}  // namespace ogc::compare
