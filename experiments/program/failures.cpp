#include "experiments/program/failures.hpp"

#include <algorithm>
#include <chrono>

#include "compare/files/bytes.hpp"
#include "compare/judge/engine/shrink.hpp"
#include "compare/judge/report/corpus.hpp"
#include "compare/judge/report/diagnose.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

namespace {

// Largest number of failing cases that are saved for each generator.
constexpr std::ptrdiff_t saved_cases = 4;
// Time limits for shrinking all failing cases, and for shrinking one case [s].
constexpr double shrinking_seconds = 30, shrinking_one = 2;
// Largest number of cases that are explained in full.
constexpr std::size_t most_explained = 5;

}  // namespace

const compare::States* OpenStates::of(const std::string& folder) {
  if (folder.empty()) return nullptr;
  auto& states = open_[folder];
  if (!states) states = std::make_unique<compare::States>(folder, authority_);
  return states.get();
}

/// Returns the case with this name. Given cases keep their data; all others are generated again from their names.
compare::TestCase Failures::case_again(const compare::CaseName& name) {
  for (const compare::TestCase& test : given_)
    if (test.name == name) return test;
  return compare::generate(name, states_.of(name.states));
}

std::pair<compare::TestCase, std::string> Failures::small(const compare::TestCase& test, const std::string& message) {
  const auto start = std::chrono::steady_clock::now();
  compare::ShrinkOptions options;
  options.seconds = std::min(shrinking_one, shrinking_seconds - spent_);
  if (options.seconds <= 0) return {test, message};
  compare::TestCase shrunk = compare::shrink_failure(test, message, contestant_, authority_, options);
  spent_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::size_t before = compare::primitive_count(test), after = compare::primitive_count(shrunk);
  if (before == after) return {std::move(shrunk), message};
  return {std::move(shrunk), message + " (message of the whole case; shrunk from " + std::to_string(before) + " to " +
                                 counted(after, "primitive") + ")"};
}

void Failures::explain(const compare::TestCase& test, const std::filesystem::path& file) {
  compare::Explanation explanation = compare::explain(test, contestant_, authority_);
  explanation.file = file.string();
  const std::filesystem::path mesh = std::filesystem::path(file).replace_extension(".obj");
  if (!file.empty() && std::filesystem::exists(mesh)) explanation.mesh = mesh.string();
  explanations_.push_back(std::move(explanation));
}

std::vector<std::string> Failures::save(const std::vector<compare::StageReport>& reports,
                                        const std::filesystem::path& folder) {
  std::vector<std::string> paths;
  std::string problems;
  for (const compare::StageReport& report : reports) {
    std::vector<compare::CaseName> saved;
    for (const compare::Mismatch& mismatch : report.tally.mismatches) {
      const auto same_generator = [&](const compare::CaseName& name) {
        return name.generator == mismatch.name.generator;
      };
      if (std::count_if(saved.begin(), saved.end(), same_generator) == saved_cases) continue;
      if (std::find(saved.begin(), saved.end(), mismatch.name) != saved.end()) continue;
      const auto [test, message] = small(case_again(mismatch.name), mismatch.message);
      const std::filesystem::path path = compare::save_case(folder, test, message);
      if (saved.empty() && given_.empty()) explain(test, path);
      saved.push_back(mismatch.name);
      paths.push_back(path.string());
      problems += "# " + message + "\n" + compare::print_problem(test.name) + "\n";
    }
  }
  if (!paths.empty()) compare::write_bytes(folder / "problems.txt", problems);
  return paths;
}

void Failures::explain_given(const std::vector<compare::StageReport>& reports) {
  const auto fails = [&](const compare::TestCase& test) {
    return std::any_of(reports.begin(), reports.end(), [&](const compare::StageReport& report) {
      const auto& all = report.tally.mismatches;
      return std::any_of(all.begin(), all.end(), [&](const compare::Mismatch& one) { return one.name == test.name; });
    });
  };
  const auto is_skipped = [&](const compare::TestCase& test) {
    return std::any_of(reports.begin(), reports.end(), [&](const compare::StageReport& report) {
      return report.skipped && report.tally.stage == test.name.stage;
    });
  };
  for (const compare::TestCase& test : given_)
    if (explanations_.size() < most_explained && !is_skipped(test) && (given_.size() == 1 || fails(test)))
      explain(test, {});
}

void Failures::diagnose(std::vector<compare::StageReport>& reports, std::uint64_t seed) {
  for (compare::StageReport& report : reports) {
    std::vector<compare::TestCase> failing;
    for (const compare::Mismatch& mismatch : report.tally.mismatches) {
      const auto is_it = [&](const compare::TestCase& test) { return test.name == mismatch.name; };
      if (mismatch.message.starts_with("no answer") || std::any_of(failing.begin(), failing.end(), is_it)) continue;
      failing.push_back(case_again(mismatch.name));
    }
    if (!failing.empty())
      report.diagnosis = compare::diagnose(report.tally.stage, failing, contestant_, authority_, seed);
  }
}

}  // namespace ogc::experiments
