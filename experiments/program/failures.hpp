// Shrinks, saves, explains and diagnoses failing cases.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/judge/cases/states.hpp"
#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/explanation.hpp"

namespace ogc::experiments {

/// Opens run folders, each of them once.
class OpenStates {
 public:
  explicit OpenStates(const compare::Authority& authority) : authority_(authority) {}
  /// Returns the states of a run folder; null if `folder` is empty.
  const compare::States* of(const std::string& folder);

 private:
  const compare::Authority& authority_;
  std::map<std::string, std::unique_ptr<compare::States>> open_;
};

/// Treats the failing cases of one comparison. `given`: cases that the command line names one by one; empty otherwise.
class Failures {
 public:
  Failures(const compare::Contestant& contestant, const compare::Authority& authority, OpenStates& states,
           std::span<const compare::TestCase> given)
      : contestant_(contestant), authority_(authority), states_(states), given_(given) {}

  /// Shrinks and saves the first failing cases of each generator, and writes their problem strings to a batch file.
  /// Returns the paths. Also explains the first failing case of each stage in full, unless the cases were given.
  std::vector<std::string> save(const std::vector<compare::StageReport>& reports, const std::filesystem::path& folder);

  /// Explains given cases in full: a single case in any event, several cases only if they fail.
  void explain_given(const std::vector<compare::StageReport>& reports);

  /// Compares the failures of each stage with the known wrong forms. `seed`: seed of further cases that are drawn for
  /// this.
  void diagnose(std::vector<compare::StageReport>& reports, std::uint64_t seed);

  /// Returns the explanations of all cases so far.
  const std::vector<compare::Explanation>& explanations() const { return explanations_; }

 private:
  compare::TestCase case_again(const compare::CaseName& name);
  /// Returns the shrunk case, and the message with the numbers of primitives before and after. Returns both unchanged
  /// if no time is left.
  std::pair<compare::TestCase, std::string> small(const compare::TestCase& test, const std::string& message);
  void explain(const compare::TestCase& test, const std::filesystem::path& file);

  const compare::Contestant& contestant_;
  const compare::Authority& authority_;
  OpenStates& states_;
  std::span<const compare::TestCase> given_;
  std::vector<compare::Explanation> explanations_;
  double spent_ = 0;
};

}  // namespace ogc::experiments
