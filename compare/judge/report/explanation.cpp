#include "compare/judge/report/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

#include <nlohmann/json.hpp>

#include "compare/judge/engine/judge.hpp"

namespace ogc::compare {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_entries = 12, most_differences = 6;

/// Prints nine digits, which distinguish any two numbers of single precision.
std::string number(double x) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.9g", x);
  return buffer;
}

std::string entry(const Quantity& quantity, std::size_t i) {
  if (i >= quantity.entries()) return "nothing";
  if (!quantity.words.empty()) return quantity.words[i];
  if (quantity.width == 1) return number(quantity.numbers[i]);
  std::string text;
  for (std::size_t k = 0; k < quantity.width; ++k)
    text += (k == 0 ? "(" : ", ") + number(quantity.numbers[i * quantity.width + k]);
  return text + ")";
}

std::string label(const Quantity& quantity, std::size_t i) {
  return i < quantity.labels.size() ? quantity.labels[i] : std::to_string(i);
}

std::string heading(const Quantity& quantity) {
  return quantity.name + (quantity.unit.empty() || quantity.unit == "1" ? "" : " [" + quantity.unit + "]");
}

std::string left_out(std::size_t count) { return "    … and " + std::to_string(count) + " more, whole with --json\n"; }

std::string input_text(const Quantity& quantity) {
  if (!quantity.is_list) return "  " + heading(quantity) + ": " + entry(quantity, 0) + "\n";
  std::string text = "  " + heading(quantity) + (quantity.entries() == 0 ? ": none\n" : ":\n");
  const std::size_t shown = std::min(most_entries, quantity.entries());
  for (std::size_t i = 0; i < shown; ++i) text += "    " + label(quantity, i) + ": " + entry(quantity, i) + "\n";
  return shown < quantity.entries() ? text + left_out(quantity.entries() - shown) : text;
}

/// Returns the relative difference of an entry from the exact one; infinite if one of the two is no number.
double difference(const AnswerPair& pair, std::size_t i) {
  const std::size_t width = pair.exact.width;
  double largest = 0;
  for (std::size_t k = i * width; k < (i + 1) * width; ++k) {
    const double given = pair.given.numbers[k], exact = pair.exact.numbers[k],
                 share = std::abs(given - exact) / std::max(std::abs(exact), 0x1p-126);
    largest = std::max(largest, std::isnan(share) ? INFINITY : share);
  }
  return largest;
}

/// Prints the words, for example contacts, that only one of the two lists has.
std::string words_text(const AnswerPair& pair) {
  const std::multiset<std::string> given(pair.given.words.begin(), pair.given.words.end()),
      exact(pair.exact.words.begin(), pair.exact.words.end());
  std::string text = "  " + heading(pair.exact) + ": " + std::to_string(given.size()) + " of yours, " +
                     std::to_string(exact.size()) + " exact\n";
  const auto alone = [&](const char* who, const auto& mine, const auto& theirs) {
    std::vector<std::string> names;
    std::set_difference(mine.begin(), mine.end(), theirs.begin(), theirs.end(), std::back_inserter(names));
    for (std::size_t i = 0; i < std::min(most_entries, names.size()); ++i)
      text += std::string("    ") + who + ": " + names[i] + "\n";
    if (names.size() > most_entries) text += left_out(names.size() - most_entries);
  };
  alone("yours alone", given, exact);
  alone("exact alone", exact, given);
  return text;
}

std::string pair_text(const AnswerPair& pair) {
  const Quantity &given = pair.given, &exact = pair.exact;
  if (!exact.is_list) return "  " + heading(exact) + ": " + entry(given, 0) + ", exact " + entry(exact, 0) + "\n";
  if (!given.words.empty() || !exact.words.empty() || (given.numbers.empty() && exact.numbers.empty()))
    return words_text(pair);
  std::vector<std::size_t> order(std::max(given.entries(), exact.entries()));
  std::iota(order.begin(), order.end(), 0);
  std::string text = "  " + heading(exact);
  if (order.size() > most_entries && given.numbers.size() == exact.numbers.size()) {
    text += ", of " + std::to_string(order.size()) + " entries those that differ most, whole with --json";
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return difference(pair, a) > difference(pair, b); });
    order.resize(most_differences);
    std::erase_if(order, [&](std::size_t i) { return difference(pair, i) == 0; });
  } else if (order.size() > most_entries) {
    text += ", the first of " + std::to_string(order.size()) + " entries, whole with --json";
    order.resize(most_entries);
  }
  text += ":\n";
  for (const std::size_t i : order)
    text += "    " + label(exact, i) + ": " + entry(given, i) + ", exact " + entry(exact, i) + "\n";
  return text;
}

/// Returns an array if the quantity is a list, otherwise its single entry.
Json value_json(const Quantity& quantity) {
  Json all = Json::array();
  for (std::size_t i = 0; i < quantity.entries(); ++i) {
    if (!quantity.words.empty())
      all.push_back(quantity.words[i]);
    else if (quantity.width == 1)
      all.push_back(quantity.numbers[i]);
    else
      all.push_back(
          std::vector<double>(quantity.numbers.begin() + static_cast<std::ptrdiff_t>(i * quantity.width),
                              quantity.numbers.begin() + static_cast<std::ptrdiff_t>((i + 1) * quantity.width)));
  }
  if (quantity.is_list) return all;
  return all.empty() ? Json() : all[0];
}

Json named_json(const Quantity& quantity) {
  Json json{{"name", quantity.name}, {"unit", quantity.unit}};
  if (!quantity.labels.empty()) json["labels"] = quantity.labels;
  return json;
}

}  // namespace

Explanation explain(const TestCase& test, const Contestant& contestant, const Authority& authority) {
  Explanation explanation{print_problem(test.name), {}, inputs_of(test), answers_to(test, contestant, authority)};
  for (const StageReport& report : judge_cases({&test, 1}, contestant, authority))
    for (const Mismatch& mismatch : report.tally.mismatches) explanation.messages.push_back(mismatch.message);
  return explanation;
}

std::string explanation_text(const Explanation& explanation) {
  std::string text = explanation.problem + "\n";
  for (const std::string& message : explanation.messages) text += "  " + message + "\n";
  if (explanation.messages.empty()) text += "  right\n";
  text += "inputs\n";
  for (const Quantity& quantity : explanation.inputs) text += input_text(quantity);
  text += "your answer, and the exact one\n";
  if (!explanation.answers.note.empty()) text += "  (" + explanation.answers.note + ")\n";
  for (const AnswerPair& pair : explanation.answers.outputs) text += pair_text(pair);
  if (!explanation.file.empty()) text += "saved; again: ogc compare --replay " + explanation.file + "\n";
  if (!explanation.mesh.empty()) text += "its mesh: ogc audit " + explanation.mesh + "\n";
  return text;
}

Json explanation_json(const Explanation& explanation) {
  Json json{{"problem", explanation.problem},
            {"messages", explanation.messages},
            {"inputs", Json::array()},
            {"answers", Json::array()}};
  for (const Quantity& quantity : explanation.inputs) {
    json["inputs"].push_back(named_json(quantity));
    json["inputs"].back()["value"] = value_json(quantity);
  }
  for (const auto& [given, exact] : explanation.answers.outputs) {
    json["answers"].push_back(named_json(exact));
    json["answers"].back()["given"] = given.name.empty() ? Json() : value_json(given);
    json["answers"].back()["exact"] = value_json(exact);
  }
  json["note"] = explanation.answers.note;
  if (!explanation.file.empty()) json["file"] = explanation.file;
  if (!explanation.mesh.empty()) json["mesh"] = explanation.mesh;
  return json;
}

}  // namespace ogc::compare
