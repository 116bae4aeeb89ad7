// How forms are written: as a change of what the authority is asked, or of what it says.
#pragma once

#include <array>
#include <utility>

#include "compare/judge/explain/wrong_forms.hpp"

namespace ogc::compare {

template <class Truth, class In>
using Ask = std::function<Truth(const In&)>;

/// A form whose truth is made from that of the stage: `change(right, in)` returns what the form says of the question.
template <class Truth, class In, class Change>
WrongForm form(std::string name, std::string meaning, Ask<Truth, In> Authority::*stage, Change change) {
  return form_of(std::move(name), std::move(meaning), [stage, change](const Authority& authority) {
    Authority wrong = authority;
    wrong.*stage = [right = authority.*stage, change](const In& in) -> Truth { return change(right, in); };
    return wrong;
  });
}

/// The question is changed: `change(In&)`.
template <class Truth, class In, class Change>
WrongForm asked(std::string name, std::string meaning, Ask<Truth, In> Authority::*stage, Change change) {
  return form(std::move(name), std::move(meaning), stage, [change](const Ask<Truth, In>& right, const In& in) {
    In other = in;
    change(other);
    return right(other);
  });
}

/// The truth is changed: `change(const In&, Truth&)`.
template <class Truth, class In, class Change>
WrongForm told(std::string name, std::string meaning, Ask<Truth, In> Authority::*stage, Change change) {
  return form(std::move(name), std::move(meaning), stage, [change](const Ask<Truth, In>& right, const In& in) {
    Truth truth = right(in);
    change(in, truth);
    return truth;
  });
}

/// An activation by name.
struct NamedActivation {
  ContactActivation kind;
  const char *name, *meaning;
};

/// What may stand in place of `ogc`.
inline constexpr std::array<NamedActivation, 4> other_activations{
    {{ContactActivation::ogc_as_printed, "ogc_as_printed", "Eq. 19 as printed: k' = τ k_c (τ − r)², numbers in metres"},
     {ContactActivation::quadratic, "quadratic", "k_c/2 (r − d)² at every distance"},
     {ContactActivation::ipc_log, "ipc_log", "IPC's barrier −k_c (d − r)² ln(d/r)"},
     {ContactActivation::cubic, "cubic", "2 k_c/(3r) (r − d)³"}}};

/// By file: forms_scalars.cpp, forms_forces.cpp, forms_pairs.cpp, forms_sets.cpp, forms_scenes.cpp.
std::vector<WrongForm> activation_forms();
std::vector<WrongForm> truncate_forms();
std::vector<WrongForm> initial_guess_forms();
std::vector<WrongForm> bound_forms();
std::vector<WrongForm> contact_force_forms();
std::vector<WrongForm> friction_force_forms();
std::vector<WrongForm> membrane_forms();
std::vector<WrongForm> bending_forms();
std::vector<WrongForm> spring_forms();
std::vector<WrongForm> closest_face_forms();
std::vector<WrongForm> closest_points_forms();
std::vector<WrongForm> block_forms();
std::vector<WrongForm> detect_vertex_facet_forms(std::span<const Evidence> evidence);
std::vector<WrongForm> detect_edge_edge_forms(std::span<const Evidence> evidence);
std::vector<WrongForm> rest_state_forms();
std::vector<WrongForm> sweep_forms();

}  // namespace ogc::compare
