// One case told whole: its inputs by name and unit, both answers, what is wrong, and the file that keeps it.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/judge/report/answers.hpp"

namespace ogc::compare {

/// What `ogc compare --problem` prints.
struct Explanation {
  std::string problem;                ///< the problem string
  std::vector<std::string> messages;  ///< what is wrong; none where the answer is right
  std::vector<Quantity> inputs;       ///< in the contract's order
  Answers answers;                    ///< of both sides
  std::string file{}, mesh{};         ///< as saved, to replay and to audit; empty where it is not
};

/// Asks both sides. `test` may be a smaller form of the case that its name makes.
Explanation explain(const TestCase& test, const Contestant& contestant, const Authority& authority);

/// For people: of long lists the first entries, and of long answers those that differ most.
std::string explanation_text(const Explanation& explanation);
/// Whole.
nlohmann::ordered_json explanation_json(const Explanation& explanation);

}  // namespace ogc::compare
