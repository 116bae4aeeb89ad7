#include "compare/judge/report/answers.hpp"

#include <stdexcept>

#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

Answers paired(const std::vector<Quantity>& given, const std::vector<Quantity>& exact, std::string note) {
  Answers answers{{}, std::move(note)};
  for (std::size_t i = 0; i < exact.size(); ++i)
    answers.outputs.push_back({i < given.size() ? given[i] : Quantity{}, exact[i]});
  return answers;
}

Answers answers_to(const TestCase& test, const Contestant& contestant, const Authority& authority) {
  try {
    return traits_of(test.name.stage).answers(test, contestant, authority);
  } catch (const std::out_of_range&) {
    return {{}, "an array of the answer does not have one entry for each case"};
  }
}

}  // namespace ogc::compare
