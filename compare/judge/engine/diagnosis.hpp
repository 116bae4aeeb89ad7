// What the judge says of the failures of a stage as a whole (compare/judge/report/diagnose.hpp finds it).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace ogc::compare {

/// A second mistake, of failing cases that the named form does not explain.
struct SecondMistake {
  std::string name, meaning;  ///< of its form
  std::uint64_t fits = 0;     ///< of the failing cases, those that no form before it fits
  bool together = false;      ///< with the named one in the same answer, not in its place
};

/// A known wrong form that the answers equal, and where they fail.
struct Diagnosis {
  std::string name, meaning;            ///< of the form (compare/judge/report/wrong_forms.hpp); empty where none fits
  std::vector<std::string> as_well;     ///< forms that fit just as many cases: these do not tell them apart
  std::uint64_t fits = 0, failing = 0;  ///< failing cases that were looked at, and how many of them the form fits
  std::uint64_t otherwise = 0, right = 0;  ///< likewise of right cases, and how many are not as the form says
  std::uint64_t forms = 0;                 ///< forms that were tried
  std::string where{};  ///< what all failing cases have in common, and right ones lack: "activation is ogc"; or empty
  std::uint64_t elsewhere = 0;           ///< right cases without it
  std::vector<SecondMistake> seconds{};  ///< what the failing cases that it misses equal
};

/// A paragraph.
std::string diagnosis_text(const Diagnosis& diagnosis);
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

}  // namespace ogc::compare
