// What becomes of failing cases: made small, saved, told whole, and diagnosed.
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

/// Run folders, each opened once.
class OpenStates {
 public:
  explicit OpenStates(const compare::Authority& authority) : authority_(authority) {}
  /// Null for no folder.
  const compare::States* of(const std::string& folder);

 private:
  const compare::Authority& authority_;
  std::map<std::string, std::unique_ptr<compare::States>> open_;
};

/// Works on the failures of one comparison. `given`: its cases, where they were given one by one.
class Failures {
 public:
  Failures(const compare::Contestant& contestant, const compare::Authority& authority, OpenStates& states,
           std::span<const compare::TestCase> given)
      : contestant_(contestant), authority_(authority), states_(states), given_(given) {}

  /// Saves the first failing cases of each generator, as small as they still fail, and their problem strings as a batch
  /// file; returns the paths. Tells the first one of each stage whole.
  std::vector<std::string> save(const std::vector<compare::StageReport>& reports, const std::filesystem::path& folder);

  /// Tells a case that is given alone whole, right or wrong; of several those that fail.
  void explain_given(const std::vector<compare::StageReport>& reports);

  /// Holds the failures of each stage to the known wrong forms. `seed`: of the cases that are asked beside them.
  void diagnose(std::vector<compare::StageReport>& reports, std::uint64_t seed);

  const std::vector<compare::Explanation>& explanations() const { return explanations_; }  ///< of all cases told so far

 private:
  compare::TestCase case_again(const compare::CaseName& name);
  /// The smaller case, as long as there is time, and its message with what became of it.
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
