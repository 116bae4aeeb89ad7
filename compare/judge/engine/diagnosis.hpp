// Holds the common cause of a stage's failures; compare/judge/report/diagnose.hpp finds it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace ogc::compare {

/// A second mistake, which explains failing cases that the first form does not explain.
struct SecondMistake {
  std::string name, meaning;  ///< name and meaning of the wrong form
  std::uint64_t fits = 0;     ///< failing cases that this form fits and no earlier form fits
  /// true if the answers contain both mistakes, false if they contain the second mistake instead of the first
  bool together = false;
};

/// A wrong form that matches the answers, and the inputs for which they fail.
struct Diagnosis {
  /// name and meaning of the form (compare/judge/report/wrong_forms.hpp); empty if none fits
  std::string name, meaning;
  std::vector<std::string> as_well;  ///< other forms that fit equally well, so that these cases do not distinguish them
  std::uint64_t fits = 0, failing = 0;  ///< failing cases that the form fits, and all failing cases that were tried
  /// right cases that contradict the form, and all right cases that were tried
  std::uint64_t otherwise = 0, right = 0;
  std::uint64_t forms = 0;  ///< number of forms that were tried
  /// what all failing cases have in common and right ones lack, for example "activation is ogc"; may be empty
  std::string where{};
  std::uint64_t elsewhere = 0;           ///< right cases that lack what `where` states
  std::vector<SecondMistake> seconds{};  ///< forms that fit failing cases which the first form does not fit
};

/// Return the diagnosis: as a paragraph; as JSON.
std::string diagnosis_text(const Diagnosis& diagnosis);
nlohmann::ordered_json diagnosis_json(const Diagnosis& diagnosis);

}  // namespace ogc::compare
