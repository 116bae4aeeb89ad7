// Saved cases of rest_state, block and initial_guess.
#pragma once

#include "compare/judge/cases.hpp"
#include "compare/judge/numbers_json.hpp"

namespace ogc::compare {

Json case_to_json(const BlockCase& c);
/// What the stage reads of the scene, and the start positions, which it must not read.
Json case_to_json(const RestStateCase& c);
Json case_to_json(const InitialGuessCase& c);

/// Throw what the JSON library throws for a missing key or a wrong type, InputError for a value that no case can have.
BlockCase to_block_case(const Json& data);
RestStateCase to_rest_state_case(const Json& data);
InitialGuessCase to_initial_guess_case(const Json& data);

}  // namespace ogc::compare
