// Lists the members of the cases of force stages by name and unit. Files and printed explanations use this list.
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string_view>
#include <type_traits>

#include "compare/judge/cases/cases.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"

namespace ogc::compare {

// Each function calls visit(name, unit, member) for every member. The unit is "m" for lengths, "1" for pure numbers,
// and "" for choices and indices of vertices.

/// Visits the members of a membrane case.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, MembraneCase>
void visit_members(Case& c, Visit visit) {
  visit("corner", "m", c.corner);
  visit("start", "m", c.start);
  visit("gradient_1", "1/m", c.gradient[0]);
  visit("gradient_2", "1/m", c.gradient[1]);
  visit("area", "m²", c.area);
  visit("lame_lambda", "N/m", c.lame_lambda);
  visit("lame_mu", "N/m", c.lame_mu);
  visit("damping", "1", c.damping);
  visit("model", "", c.model);
  visit("damping_form", "", c.damping_form);
}

/// Visits the members of a bending case.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, BendingCase>
void visit_members(Case& c, Visit visit) {
  visit("vertex", "m", c.vertex);
  visit("start", "m", c.start);
  visit("stiffness", "J", c.stiffness);
  visit("rest_angle", "rad", c.rest_angle);
  visit("damping", "1", c.damping);
  visit("own", "", c.own);
  visit("model", "", c.model);
  visit("weight", "1/m", c.weight);
  visit("damping_form", "", c.damping_form);
}

/// Visits the members of a spring case.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, SpringCase>
void visit_members(Case& c, Visit visit) {
  visit("vertex", "m", c.vertex);
  visit("start", "m", c.start);
  visit("stiffness", "N/m", c.stiffness);
  visit("rest_length", "m", c.rest_length);
  visit("damping", "1", c.damping);
  visit("ratio", "1", c.ratio);
  visit("own", "", c.own);
  visit("damping_form", "", c.damping_form);
}

/// Visits the members of a tetrahedron case.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, TetrahedronCase>
void visit_members(Case& c, Visit visit) {
  visit("corner", "m", c.corner);
  visit("start", "m", c.start);
  visit("weight", "m", c.weight);
  visit("inverse", "1/m³", c.inverse);
  visit("gradient_1", "1/m", c.gradient[0]);
  visit("gradient_2", "1/m", c.gradient[1]);
  visit("gradient_3", "1/m", c.gradient[2]);
  visit("volume", "m³", c.volume);
  visit("lame_lambda", "Pa", c.lame_lambda);
  visit("lame_mu", "Pa", c.lame_mu);
  visit("damping", "1", c.damping);
  visit("damping_form", "", c.damping_form);
}

/// Visits the members of a segment of a rod.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, RodCase>
void visit_members(Case& c, Visit visit) {
  visit("vertex", "m", c.vertex);
  visit("start", "m", c.start);
  visit("orientation", "1", c.orientation);
  visit("orientation_start", "1", c.orientation_start);
  visit("rest_length", "m", c.rest_length);
  visit("stretch", "N", c.stretch);
  visit("damping", "1", c.damping);
  visit("own", "", c.own);
  visit("damping_form", "", c.damping_form);
}

/// Visits the members of a segment with its neighbours.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, OrientationCase>
void visit_members(Case& c, Visit visit) {
  visit("vertex", "m", c.vertex);
  visit("start", "m", c.start);
  visit("orientation", "1", c.orientation);
  visit("orientation_start", "1", c.orientation_start);
  visit("rest_length", "m", c.rest_length);
  visit("stretch", "N", c.stretch);
  visit("damping", "1", c.damping);
  visit("behind", "N m", c.behind.weight);
  visit("behind_now", "1", c.behind.now);
  visit("behind_start", "1", c.behind.start);
  visit("behind_rest", "1", c.behind.rest);
  visit("ahead", "N m", c.ahead.weight);
  visit("ahead_now", "1", c.ahead.now);
  visit("ahead_start", "1", c.ahead.start);
  visit("ahead_rest", "1", c.ahead.rest);
}

/// Visits the members of a contact.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, ContactForceCase>
void visit_members(Case& c, Visit visit) {
  visit("sides", "", c.sides);
  visit("own", "", c.own);
  visit("vertex", "m", c.vertex);
  visit("previous", "m", c.previous);
  visit("rest_squared", "m²", c.rest_squared);
  visit("contact_radius", "m", c.contact_radius);
  visit("stiffness", "N/m", c.stiffness);
  visit("activation", "", c.activation);
  visit("together", "", c.together);
}

/// Visits the members of a contact with friction.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, FrictionForceCase>
void visit_members(Case& c, Visit visit) {
  visit_members(c.contact, visit);
  visit("start", "m", c.start);
  visit("friction", "1", c.friction);
  visit("slip_limit", "m", c.slip_limit);
}

/// Visits the members of a contact with a volume.
template <class Case, class Visit>
requires std::same_as<std::remove_const_t<Case>, VolumeForceCase>
void visit_members(Case& c, Visit visit) {
  visit("own", "", c.own);
  visit("vertex", "m", c.vertex);
  visit("start", "m", c.start);
  visit("weights", "1", c.weights);
  visit("direction", "1", c.direction);
  visit("contact_radius", "m", c.contact_radius);
  visit("stiffness", "N/m", c.stiffness);
  visit("friction", "1", c.friction);
  visit("slip_limit", "m", c.slip_limit);
}

/// Names of contact sides, in the order of ContactSides.
inline constexpr std::array<std::string_view, 4> side_names{"point_point", "point_edge", "edge_edge", "point_triangle"};

/// Returns the names of an enumeration's values, in their order.
inline std::span<const std::string_view> names_of(ContactSides) { return side_names; }
inline std::span<const std::string_view> names_of(MembraneModel) { return choice_names<MembraneModel>; }
inline std::span<const std::string_view> names_of(BendingModel) { return choice_names<BendingModel>; }
inline std::span<const std::string_view> names_of(ContactActivation) { return choice_names<ContactActivation>; }
inline std::span<const std::string_view> names_of(DampingForm) { return choice_names<DampingForm>; }

/// A type that has names_of.
template <class T>
concept Named = std::is_enum_v<T>;

}  // namespace ogc::compare
