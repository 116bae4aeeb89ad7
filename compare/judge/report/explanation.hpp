// Explains one case whole: its inputs by name and unit, both answers, what is wrong, and the file that keeps it.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/report/answers.hpp"

namespace ogc::compare {

/// The content that `ogc compare --problem` prints.
struct Explanation {
  std::string problem;                ///< the problem string
  std::vector<std::string> messages;  ///< what is wrong; none where the answer is right
  std::vector<Quantity> inputs;       ///< in the contract's order
  Answers answers;                    ///< answers of both sides
  std::string file{}, mesh{};         ///< saved files, to replay and to audit; empty where not saved
};

/// Asks both sides. `test` may be a smaller form of the case of its name.
Explanation explain(const TestCase& test, const Contestant& contestant, const Authority& authority);

/// Prints for people: the first entries of long lists, and the entries of long answers that differ most.
std::string explanation_text(const Explanation& explanation);
/// Prints everything.
nlohmann::ordered_json explanation_json(const Explanation& explanation);

}  // namespace ogc::compare
