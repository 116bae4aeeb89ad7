#include "compare/judge/cases/cases.hpp"

#include <charconv>
#include <sstream>

#include "compare/judge/cases/parameters.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {

namespace {

std::uint64_t parse_number(const std::string& key, const std::string& value) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc{} || end != value.data() + value.size() || value.empty())
    throw InputError("problem string: '" + key + "=" + value + "' is not a whole number from 0 to 2^64 - 1");
  return number;
}

float parse_value(const std::string& key, const std::string& value) {
  float number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc{} || end != value.data() + value.size() || value.empty())
    throw InputError("problem string: '" + key + "=" + value + "' is not a number of single precision");
  return number;
}

/// Returns the shortest text that reads back as the same number.
std::string print_value(float value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

Stage parse_stage(const std::string& value) {
  if (const auto stage = find_stage(value)) return *stage;
  std::string known;
  for (const Stage stage : all_stages) known += (known.empty() ? "" : ", ") + std::string(stage_name(stage));
  throw InputError("problem string: there is no stage '" + value + "'; known: " + known);
}

}  // namespace

std::string print_problem(const CaseName& name) {
  std::string line = "stage=" + std::string(stage_name(name.stage)) + " gen=" + name.generator +
                     " seed=" + std::to_string(name.seed) + " index=" + std::to_string(name.index);
  for (const Override& parameter : name.overrides) line += " " + parameter.name + "=" + print_value(parameter.value);
  if (!name.states.empty()) line += " states=" + name.states;
  return line;
}

CaseName parse_problem(const std::string& line) {
  CaseName name;
  std::string rest = line;
  // A path may hold spaces, so `states` takes the rest of the line.
  if (const auto at = rest.find(" states="); at != std::string::npos) {
    name.states = rest.substr(at + 8);
    rest.resize(at);
  }
  bool has_stage = false;
  std::istringstream words(rest);
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    const std::string key = word.substr(0, equals), value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (key == "stage") {
      name.stage = parse_stage(value);
      has_stage = true;
    } else if (key == "gen") {
      name.generator = value;
    } else if (key == "seed") {
      name.seed = parse_number(key, value);
    } else if (key == "index") {
      name.index = parse_number(key, value);
    } else if (equals == std::string::npos) {
      throw InputError("problem string: '" + word + "' in '" + line +
                       "' is no key=value; keys: stage, gen, seed, index, states and the stage's parameters");
    } else {
      name.overrides.push_back({key, parse_value(key, value)});
    }
  }
  if (!has_stage || name.generator.empty())
    throw InputError("problem string: '" + line +
                     "' lacks stage or gen; example: stage=closest_face gen=ladder.needle seed=7 index=1234");
  make_canonical(name.stage, name.overrides);
  return name;
}

}  // namespace ogc::compare
