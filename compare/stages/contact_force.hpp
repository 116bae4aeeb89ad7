// Stage contact_force: normal force and block of one vertex of one contact (Eq. 1, 16, 18 with Eq. 19 corrected; method.md §3, §4).
#pragma once

#include "compare/stages/force.hpp"

namespace ogc::compare {

/// The closed faces that meet, and their vertices in ContactForceCase::vertex, first side | second side.
enum class ContactSides : std::uint8_t {
  point_point,     ///< 0 | 1
  point_edge,      ///< 0 | 1 2
  edge_edge,       ///< 0 1 | 2 3, the first edge lower-numbered
  point_triangle,  ///< 0 | 1 2 3
};

/// Vertices of a contact between these sides.
constexpr std::int32_t vertex_count(ContactSides sides) {
  return sides == ContactSides::point_point ? 2 : sides == ContactSides::point_edge ? 3 : 4;
}

/// E = e_k g(d), d the distance of the contact points: the closest points of the closed faces, for nearly parallel edges those of closest_points. Force
/// −e_k g'(d) w n on a vertex with weight w, block e_k g''(d) w² n nᵀ (method.md §4). A contact acts while 0 < d < r. Below 2⁻²³ r slope and curvature are
/// those of 2⁻²³ r; at d = 0, which the bounds exclude, there is no normal, and force and block are 0. e_k = q(2 − q), q = c/ε for c < ε, else 1, with
/// c = ‖e × e'‖² at the last detection and ε = 10⁻³ ‖ē‖²‖ē'‖²; 1 for other sides and where the rest lengths are 0.
struct ContactForceCase {
  ContactSides sides = ContactSides::point_point;
  std::int32_t own = 0;                     ///< which vertex is asked about, 0 … vertex_count(sides) − 1
  std::array<Vec3f, 4> vertex;              ///< x [m]; what the sides lack is 0
  std::array<Vec3f, 4> detected;            ///< x at the last detection [m], for e_k
  std::array<float, 2> rest_squared{};      ///< ‖ē‖², ‖ē'‖² [m²]; 0 in meshes without triangles, where nothing is mollified
  float contact_radius = 0, stiffness = 0;  ///< r [m], k_c [N/m]
};

struct ContactForceIn {
  std::vector<ContactForceCase> cases;
};

}  // namespace ogc::compare
