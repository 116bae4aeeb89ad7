#include "compare/judge/engine/determinism.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/ask.hpp"
#include "compare/judge/engine/judge.hpp"

namespace ogc::compare {

namespace {

/// Returns the bits of the answers if cases are asked in batches of `size`.
std::vector<std::string> in_batches(Stage stage, Cases cases, std::size_t size, const Contestant& contestant,
                                    const Authority& authority) {
  std::vector<std::string> all;
  for (std::size_t first = 0; first < cases.size(); first += size) {
    const auto part = answer_bits(stage, cases.subspan(first, std::min(size, cases.size() - first)), contestant,
                                  authority);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// Returns a random order that is the same for the same count.
std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random("determinism", "shuffle", 1, count);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  return order;
}

std::uint64_t digest_of(const std::vector<std::string>& bits) {
  std::uint64_t digest = 0xcbf29ce484222325u;
  for (const std::string& answer : bits)
    for (const char c : answer) digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return digest;
}

std::vector<TestCase> cases_of(Stage stage, std::uint64_t count, std::uint64_t seed) {
  std::vector<TestCase> cases;
  double shares = 0;
  for (const Generator& row : generators(stage)) shares += row.least > 0 ? 0 : row.share;
  for (const Generator& row : generators(stage)) {
    if (row.least > 0) continue;
    const auto wanted = static_cast<std::uint64_t>(static_cast<double>(count) * row.share / shares) + 1;
    for (std::uint64_t i = 0; i < wanted; ++i)
      cases.push_back(generate({stage, std::string(row.name), seed, i, "", {}}));
  }
  return cases;
}

/// Returns a text with the number of generic cases that change if vertices and triangles are renumbered, and with the
/// first such case. The text is empty if no case changes, or if the stage's answers depend on indices.
std::string changed_by_numbers(Stage stage, Cases cases, const Contestant& contestant) {
  const auto is_same = traits_of(stage).is_same_renumbered;
  if (is_same == nullptr) return {};
  std::size_t count = 0;
  const TestCase* first = nullptr;
  for (const TestCase& test : cases) {
    if (!find_generator(stage, test.name.generator).generic) continue;
    Random random("determinism", "renumbered", test.name.seed, test.name.index);
    if (is_same(test, random, contestant)) continue;
    ++count;
    if (first == nullptr) first = &test;
  }
  return count == 0 ? "" : "renumbered: " + std::to_string(count) + " cases, the first " + print_problem(first->name);
}

}  // namespace

std::vector<std::string> answer_bits(Stage stage, std::span<const TestCase> cases, const Contestant& contestant,
                                     const Authority& authority) {
  if (cases.empty()) return {};
  return traits_of(stage).bits(cases, contestant, authority);
}

DeterminismReport check_determinism(Stage stage, std::uint64_t cases, std::uint64_t seed, const Contestant& contestant,
                                    const Authority& authority, std::span<const Surrounding> surroundings) {
  DeterminismReport report;
  report.stage = stage;
  if (!can_judge(stage, contestant, authority)) {
    report.skipped = true;
    return report;
  }
  const std::vector<TestCase> all = cases_of(stage, cases, seed);
  const std::vector<std::string> right = answer_bits(stage, all, contestant, authority);
  report.cases = all.size();
  report.digest = digest_of(right);
  const auto compare_with = [&](const std::string& way, const std::vector<std::string>& bits) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = right.size(); i-- > 0;)
      if (i >= bits.size() || bits[i] != right[i]) {
        ++count;
        first = i;
      }
    if (count > 0)
      report.changed.push_back(way + ": " + std::to_string(count) + " cases, the first " +
                               print_problem(all[first].name));
  };
  compare_with("again", answer_bits(stage, all, contestant, authority));
  for (const Surrounding& surrounding : surroundings)
    surrounding.run([&] { compare_with(surrounding.name, answer_bits(stage, all, contestant, authority)); });
  const std::vector<std::size_t> order = shuffled(all.size());
  std::vector<TestCase> mixed;
  for (const std::size_t i : order) mixed.push_back(all[i]);
  const std::vector<std::string> answers = answer_bits(stage, mixed, contestant, authority);
  std::vector<std::string> sorted(all.size());
  for (std::size_t i = 0; i < order.size() && i < answers.size(); ++i) sorted[order[i]] = answers[i];
  compare_with("shuffled", sorted);
  if (const std::string wrong = changed_by_numbers(stage, all, contestant); !wrong.empty())
    report.changed.push_back(wrong);
  if (!is_mesh_stage(stage))
    for (const std::size_t size : {1u, 2u, 3u, 5u, 10u, 50u})
      compare_with("batches of " + std::to_string(size), in_batches(stage, all, size, contestant, authority));
  return report;
}

std::string determinism_table(std::span<const DeterminismReport> reports) {
  std::string text;
  for (const DeterminismReport& report : reports) {
    char line[160];
    std::snprintf(line, sizeof line, "%-20s %-12s %8llu  %016llx  %s\n", std::string(stage_name(report.stage)).c_str(),
                  std::string(determinism_name(stage_info(report.stage).determinism)).c_str(),
                  static_cast<unsigned long long>(report.cases), static_cast<unsigned long long>(report.digest),
                  report.skipped           ? "skipped"
                  : report.changed.empty() ? "the same bits"
                                           : "CHANGES:");
    text += line;
    for (const std::string& change : report.changed) text += "  " + change + "\n";
  }
  return text;
}

}  // namespace ogc::compare
