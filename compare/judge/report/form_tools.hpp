// Makes wrong forms, by changing the authority's question or its answer.
#pragma once

#include <array>
#include <utility>

#include "compare/judge/report/wrong_forms.hpp"
#include "compare/problem/names.hpp"

namespace ogc::compare {

template <class Truth, class In>
using Ask = std::function<Truth(const In&)>;

/// Makes a form: `change(right, in)` returns its answer to the question `in`, where `right` is the authority's function
/// of the stage.
template <class Truth, class In, class Change>
WrongForm form(std::string name, std::string meaning, Ask<Truth, In> Authority::*stage, Change change) {
  return form_of(std::move(name), std::move(meaning), [stage, change](const Authority& authority) {
    Authority wrong = authority;
    wrong.*stage = [right = authority.*stage, change](const In& in) -> Truth { return change(right, in); };
    return wrong;
  });
}

/// Makes a form that changes the question by `change(In&)`.
template <class Truth, class In, class Change>
WrongForm asked(std::string name, std::string meaning, Ask<Truth, In> Authority::*stage, Change change) {
  return form(std::move(name), std::move(meaning), stage, [change](const Ask<Truth, In>& right, const In& in) {
    In other = in;
    change(other);
    return right(other);
  });
}

/// Makes a form that changes the truth by `change(const In&, Truth&)`.
template <class Truth, class In, class Change>
WrongForm told(std::string name, std::string meaning, Ask<Truth, In> Authority::*stage, Change change) {
  return form(std::move(name), std::move(meaning), stage, [change](const Ask<Truth, In>& right, const In& in) {
    Truth truth = right(in);
    change(in, truth);
    return truth;
  });
}

/// An activation, and the wrong form that uses it.
struct NamedActivation {
  ContactActivation kind;
  const char *name, *meaning;  ///< of the form
};

/// Activations that a contestant may use by mistake in place of `ogc`.
inline constexpr std::array<NamedActivation, 4> other_activations{
    {{ContactActivation::ogc_as_printed, "ogc_as_printed", "Eq. 19 as printed: k' = τ k_c (τ − r)², numbers in metres"},
     {ContactActivation::quadratic, "quadratic", "k_c/2 (r − d)² at every distance"},
     {ContactActivation::ipc_log, "ipc_log", "IPC's barrier −k_c (d − r)² ln(d/r)"},
     {ContactActivation::cubic, "cubic", "2 k_c/(3r) (r − d)³"}}};
static_assert(other_activations.size() + 1 == choice_count<ContactActivation>);

}  // namespace ogc::compare
