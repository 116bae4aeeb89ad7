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

/// Holds run folders, each of which is opened once.
class OpenStates {
 public:
  explicit OpenStates(const compare::Authority& authority) : authority_(authority) {}
  /// Returns the states of a run folder; null if `folder` is empty.
  const compare::States* of(const std::string& folder);

 private:
  const compare::Authority& authority_;
  std::map<std::string, std::unique_ptr<compare::States>> open_;
};

/// Works on the failures of one comparison. `given`: the cases that the command line names one by one; empty otherwise.
class Failures {
 public:
  Failures(const compare::Contestant& contestant, const compare::Authority& authority, OpenStates& states,
           std::span<const compare::TestCase> given)
      : contestant_(contestant), authority_(authority), states_(states), given_(given) {}

  /// Saves the first failing cases of each generator, shrunk, and their problem strings as a batch file. Returns the
  /// paths. Explains the first failing case of each stage in full, unless the cases were given.
  std::vector<std::string> save(const std::vector<compare::StageReport>& reports, const std::filesystem::path& folder);

  /// Explains given cases in full: a single one whether it fails or not, of several ones those that fail.
  void explain_given(const std::vector<compare::StageReport>& reports);

  /// Compares the failures of each stage with the known wrong forms. `seed`: of the further cases that this draws.
  void diagnose(std::vector<compare::StageReport>& reports, std::uint64_t seed);

  /// of all cases explained so far
  const std::vector<compare::Explanation>& explanations() const { return explanations_; }

 private:
  compare::TestCase case_again(const compare::CaseName& name);
  /// Returns the shrunk case and its message, which then names the sizes; returns both unchanged if no time is left.
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
