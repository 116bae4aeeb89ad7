// Saved cases of the force stages.
#pragma once

#include "compare/judge/cases.hpp"
#include "compare/judge/numbers_json.hpp"

namespace ogc::compare {

Json force_case_to_json(const MembraneCase& c);
Json force_case_to_json(const BendingCase& c);
Json force_case_to_json(const SpringCase& c);
Json force_case_to_json(const ContactForceCase& c);
Json force_case_to_json(const FrictionForceCase& c);

/// Throws what the JSON library throws for a missing key or a wrong type, InputError for a value that no case can have.
CaseData to_force_case(Stage stage, const Json& data);

}  // namespace ogc::compare
