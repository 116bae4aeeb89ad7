// Describes a contact as a stencil, for the stages contact_force and friction_force.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "compare/judge/stages/force_forms.hpp"
#include "compare/judge/stages/force_stage.hpp"
#include "compare/judge/stages/pairs.hpp"

namespace ogc::compare {

/// Returns the role of each vertex of a contact in words.
std::vector<std::string> contact_roles(ContactSides sides);

/// Notes what makes the contact illegal.
void check_contact(const ContactForceCase& c, FirstProblem& problem);

/// Returns the first 2, 3 or 4 entries of `all`, one per vertex of a contact with these sides.
template <class Vertices>
auto vertices_of(Vertices& all, ContactSides sides) {
  return std::span(all).first(static_cast<std::size_t>(vertex_count(sides)));
}

Shape contact_shape(const ContactForceCase& c);  ///< Returns the contact's faces, with a dot at the question's vertex.

/// Throws InputError if c.own is not the index of a vertex of the contact.
void check_own(const ContactForceCase& c);

/// Returns a pointer to the number that the parameter "r" or "k_c" sets.
inline float* contact_parameter(ContactForceCase& c, std::string_view name) {
  return name == ranges::contact_radius.name ? &c.contact_radius : &c.stiffness;
}

/// A wrong order of a triangle's corners: corner of[k] takes the place of corner k.
struct CornerOrder {
  const char* name;                ///< "swapped_01"
  std::array<std::int32_t, 3> of;  ///< corner that takes the place of corner k
};
/// All orders except the right one.
inline constexpr std::array<CornerOrder, 5> corner_orders{{{"swapped_01", {1, 0, 2}},
                                                           {"swapped_12", {0, 2, 1}},
                                                           {"swapped_02", {2, 1, 0}},
                                                           {"rotated_120", {1, 2, 0}},
                                                           {"rotated_201", {2, 0, 1}}}};

/// Adds forms that change the contact of a question; `contact(case)` returns this contact.
template <class In, class Contact>
void add_contact(std::vector<WrongForm>& forms, ForceMember<In> stage, Contact contact) {
  using Case = std::decay_t<decltype(In{}.cases[0])>;
  const auto changed = [&](std::string name, std::string meaning, auto change) {
    forms.push_back(
        case_asked(std::move(name), std::move(meaning), stage, [contact, change](Case& c) { change(contact(c)); }));
  };
  for (const auto& [kind, name, meaning] : other_activations)
    changed(name, std::string(meaning) + ", where `ogc` is asked for", [to = kind](ContactForceCase& c) {
      if (c.activation == ContactActivation::ogc) c.activation = to;
    });
  changed("ogc_for_every_activation", "`ogc`, whichever activation is asked for",
          [](ContactForceCase& c) { c.activation = ContactActivation::ogc; });
  // A negative squared rest length switches off mollifier and overlap share: e_k is 1.
  changed("mollifier_missing", "e_k is 1: nearly parallel edges act in full", [](ContactForceCase& c) {
    if (c.rest_squared[0] > 0) c.rest_squared = {-1, -1};
  });
  changed("overlap_share_missing", "e_k is 1 for nearly parallel edges without triangles", [](ContactForceCase& c) {
    if (c.rest_squared == std::array<float, 2>{}) c.rest_squared = {-1, -1};
  });
  changed("mollifier_of_present_edges", "e_k of the present edges, not of those at the last detection",
          [](ContactForceCase& c) { c.previous = c.vertex; });
  changed("block_of_own_weight_alone", "w² in the block where other vertices are updated together with it",
          [](ContactForceCase& c) { c.together = 0; });
  changed("ends_exchanged", "the weight of the edge's other end", [](ContactForceCase& c) {
    if (c.sides == ContactSides::edge_edge) c.own ^= 1;
    if (c.sides == ContactSides::point_edge && c.own > 0) c.own = 3 - c.own;
  });
  changed("sides_exchanged", "the weight and side of the other edge", [](ContactForceCase& c) {
    if (c.sides == ContactSides::edge_edge) c.own ^= 2;
  });
  for (const auto& [name, of] : corner_orders)
    changed("triangle_weights_" + std::string(name), "the weights of the triangle's corners exchanged in this way",
            [order = of](ContactForceCase& c) {
              if (c.sides == ContactSides::point_triangle && c.own > 0)
                c.own = 1 + order[static_cast<std::size_t>(c.own - 1)];
            });
  for (const auto& [text, epsilon] : thresholds)
    changed("mollifier_below_" + std::string(text),
            "e_k by an absolute threshold: ε is " + std::string(text) + " m⁴ for edges of every length",
            [squared = static_cast<float>(std::sqrt(1e3 * epsilon))](ContactForceCase& c) {
              if (c.rest_squared[0] > 0) c.rest_squared = {squared, squared};
            });
}

}  // namespace ogc::compare
