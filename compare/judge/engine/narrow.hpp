// Judges a contestant that may crash: finds the case of a batch that makes the contestant fail.
#pragma once

#include <mutex>

#include "compare/judge/engine/ask.hpp"

namespace ogc::compare {

/// Does the same as `ask`. If the contestant fails (ContestantFailure), the batch is halved until one case remains.
/// This case becomes a mismatch with the failure's message, and the cases after it are asked next. After `allowed`
/// failing cases the rest is skipped.
void ask_narrowing(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
                   std::mutex& contestant_turn, std::uint64_t allowed, Tally& tally);

}  // namespace ogc::compare
