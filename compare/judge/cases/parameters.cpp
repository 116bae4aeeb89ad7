#include "compare/judge/cases/parameters.hpp"

#include <algorithm>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

namespace {

std::string names_of(Stage stage) {
  std::string names;
  for (const ParameterInfo& info : parameters(stage)) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names.empty() ? "none" : names;
}

}  // namespace

std::span<const ParameterInfo> parameters(Stage stage) { return traits_of(stage).parameters; }

void make_canonical(Stage stage, std::vector<Override>& overrides) {
  std::vector<Override> ordered;
  for (const ParameterInfo& info : parameters(stage)) {
    const auto is_it = [&](const Override& parameter) { return parameter.name == info.name; };
    const auto count = std::count_if(overrides.begin(), overrides.end(), is_it);
    if (count == 0) continue;
    if (count > 1) throw InputError("problem string: '" + std::string(info.name) + "' is given twice");
    const Override& given = *std::find_if(overrides.begin(), overrides.end(), is_it);
    if (!(given.value >= info.minimum && given.value <= info.maximum))
      throw InputError("problem string: " + std::string(info.name) + " (" + std::string(info.meaning) +
                       ") lies between " + shortest(as_typed(info.minimum)) + " and " +
                       shortest(as_typed(info.maximum)));
    ordered.push_back(given);
  }
  for (const Override& given : overrides)
    if (std::none_of(ordered.begin(), ordered.end(), [&](const Override& known) { return known.name == given.name; }))
      throw InputError("problem string: stage " + std::string(stage_name(stage)) + " has no parameter '" + given.name +
                       "'; it has: " + names_of(stage) + "; other keys: stage, gen, seed, index, states");
  overrides = std::move(ordered);
}

void apply_overrides(TestCase& test) {
  if (const std::string why = traits_of(test.name.stage).set(test.data, test.name.overrides); !why.empty())
    throw InputError("'" + print_problem(test.name) + "': " + why);
}

}  // namespace ogc::compare
