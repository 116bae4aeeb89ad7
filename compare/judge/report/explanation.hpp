// Explains one case: its inputs by name and unit, both answers, what is wrong, and the file that stores it.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/report/answers.hpp"

namespace ogc::compare {

/// What `ogc compare --problem` prints.
struct Explanation {
  std::string problem;                ///< the problem string
  std::vector<std::string> messages;  ///< what is wrong; empty if the answer is right
  std::vector<Quantity> inputs;       ///< in the contract's order
  Answers answers;                    ///< answers of contestant and authority
  std::string file{}, mesh{};         ///< saved files, for replay and audit; empty if not saved
};

/// Asks the contestant and the authority. `test` may be a shrunk case: it has the name of the generated case, but may
/// be smaller.
Explanation explain(const TestCase& test, const Contestant& contestant, const Authority& authority);

/// Prints a text for readers: the first entries of long lists, and those entries of long answers that differ most.
std::string explanation_text(const Explanation& explanation);
/// Returns everything as JSON.
nlohmann::ordered_json explanation_json(const Explanation& explanation);

}  // namespace ogc::compare
