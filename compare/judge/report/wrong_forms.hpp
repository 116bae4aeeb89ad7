// Holds known mistakes of a stage, each with a name. A wrong answer may equal one of these forms.
//
// A form changes the question first (another activation, no damping), or changes the truth afterwards (a sign, a
// factor). The authority computes both, so a form is as exact as the truth itself. An answer equals a form if the
// stage's verdict accepts it, with the form as the truth.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// A case, and a contestant that repeats the judged contestant's answers (`remembered`).
struct Evidence {
  TestCase test;        ///< the question
  Contestant answered;  ///< repeats the judged answers
  bool fails = false;   ///< whether the judge finds a mismatch
};

/// A known mistake of a stage.
struct WrongForm {
  std::string name;     ///< "ogc_as_printed"
  std::string meaning;  ///< one line: what is computed instead of what
  /// checks whether the answer equals the form, within the stage's tolerances
  std::function<bool(const Evidence&, const Authority&)> fits;
  /// returns an authority whose truth is the form; empty if the form depends on the answer
  std::function<Authority(const Authority&)> wrong{};
  /// true if the form states what wrong answers have in common, not how they are computed; tried only if no other form
  /// fits
  bool is_vague = false;
};

/// Makes a form. `wrong(authority)` returns an authority that makes the mistake and whose answer is the form's truth.
WrongForm form_of(std::string name, std::string meaning, std::function<Authority(const Authority&)> wrong);

/// Returns the forms of a stage. Some have a parameter found from the answers, for example how many contacts a list
/// keeps. Stages with independent cases (CaseKind::single) also have `not_a_number`.
std::vector<WrongForm> wrong_forms(Stage stage, std::span<const Evidence> evidence);

/// Returns a contestant that calls the given one once for each stage, and repeats this first answer to every later
/// question. A failure is not remembered.
Contestant remembered(const Contestant& contestant);

/// Checks whether the judge accepts the answer with this authority.
bool agrees(const Evidence& evidence, const Authority& authority);

}  // namespace ogc::compare
