// Holds what the judge finds about the failures of a stage as a whole (compare/judge/report/diagnose.hpp finds it).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace ogc::compare {

/// A second mistake, in failing cases that the named form does not explain.
struct SecondMistake {
  std::string name, meaning;  ///< name and meaning of its form
  std::uint64_t fits = 0;     ///< failing cases that this form fits and no form before it
  bool together = false;      ///< in the same answer as the named form, not in its place
};

/// A known wrong form that the answers equal, and where they fail.
struct Diagnosis {
  std::string name, meaning;            ///< of the form (compare/judge/report/wrong_forms.hpp); empty where none fits
  std::vector<std::string> as_well;     ///< forms that fit equally many cases: these do not tell them apart
  std::uint64_t fits = 0, failing = 0;  ///< failing cases that the form fits, of all that were checked
  /// right cases that differ from the form, of all that were checked
  std::uint64_t otherwise = 0, right = 0;
  std::uint64_t forms = 0;  ///< number of forms that were tried
  /// what all failing cases have in common and right ones lack, for example "activation is ogc"; or empty
  std::string where{};
  std::uint64_t elsewhere = 0;           ///< number of right cases without it
  std::vector<SecondMistake> seconds{};  ///< forms that fit the failing cases that the named one misses
};

/// Returns a paragraph, and the same as JSON.
std::string diagnosis_text(const Diagnosis& diagnosis);
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

}  // namespace ogc::compare
