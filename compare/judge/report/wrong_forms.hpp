// Holds known ways to get a stage wrong, each with a name: an answer that does not equal the truth may equal one of
// these forms.
//
// A form is the truth to a question that is changed first (another activation, no damping), or a truth that is changed
// afterwards (a sign, a factor). Both come from the authority, so a form is as exact as the truth itself, and an answer
// equals it within the verdict and the tolerances of its stage.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// A case, and a contestant that answers as the judged one did (`remembered`).
struct Evidence {
  TestCase test;        ///< the question
  Contestant answered;  ///< repeats the answers of the judged contestant
  bool fails = false;   ///< whether the judge finds a mismatch
};

/// One way to get a stage wrong.
struct WrongForm {
  std::string name;     ///< "ogc_as_printed"
  std::string meaning;  ///< one line: what is computed in place of what
  /// checks whether the answer is what the form gives, within what the stage accepts
  std::function<bool(const Evidence&, const Authority&)> fits;
  /// the authority that takes the form for the truth; empty where the form depends on the answer
  std::function<Authority(const Authority&)> wrong{};
  /// describes what the answers look like, not what was computed: tried where no other form is named
  bool is_vague = false;
};

/// Makes the form of an authority that takes it for the truth.
WrongForm form_of(std::string name, std::string meaning, std::function<Authority(const Authority&)> wrong);

/// Returns the forms of a stage. Some have a parameter that is read off the answers (how many contacts a list keeps). A
/// stage of single cases also has `not_a_number`.
std::vector<WrongForm> wrong_forms(Stage stage, std::span<const Evidence> evidence);

/// Returns the contestant with a memory: it is asked once a stage, and repeats its first answer to every later
/// question. A failure is not remembered.
Contestant remembered(const Contestant& contestant);

/// Checks whether the judge finds nothing wrong with the answer, given this authority.
bool agrees(const Evidence& evidence, const Authority& authority);

}  // namespace ogc::compare
