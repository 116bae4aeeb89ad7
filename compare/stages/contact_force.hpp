// Stage contact_force: normal force and block of one vertex of one contact (Eq. 1, 16, 18 with Eq. 19 corrected;
// method.md §3.5, §4.2).
#pragma once

#include "compare/problem/settings.hpp"
#include "compare/stages/force.hpp"

namespace ogc::compare {

/// The kinds of the closed faces in contact. Comments give indices into ContactForceCase::vertex: vertices of the first
/// face | vertices of the second face.
enum class ContactSides : std::uint8_t {
  point_point,     ///< 0 | 1
  point_edge,      ///< 0 | 1 2
  edge_edge,       ///< 0 1 | 2 3, the first edge lower-numbered
  point_triangle,  ///< 0 | 1 2 3
};

/// Returns the number of vertices of a contact between these faces.
constexpr std::int32_t vertex_count(ContactSides sides) {
  return sides == ContactSides::point_point ? 2 : sides == ContactSides::point_edge ? 3 : 4;
}

/// E = e_k g(d). g is the case's activation (compare/stages/activation.hpp). d is the distance of the contact points.
/// These are the closest points of the closed faces or, for nearly parallel edges, the points that closest_points
/// defines.
///
/// The force on a vertex with weight w is −e_k g'(d) w n. The block is e_k g''(d) |w| Σ |w_u| n nᵀ over all vertices u
/// that are updated together with the vertex, the vertex itself included. If it is updated alone, this is e_k g''(d) w²
/// n nᵀ (method.md §4.2, §7.4). Slope and curvature are taken at d, clamped to 2⁻²³ r … r. Beyond r the force is 0, and
/// the block has its value at r (k_c with `ogc`). At d = 0, which the bounds exclude, n is undefined; then force and
/// block are 0.
///
/// e_k = q(2 − q), q = c/ε for c < ε, else 1, with c = ‖e × e'‖² at the last detection and ε = 10⁻³ ‖ē‖²‖ē'‖². e_k = 1
/// for contacts other than edge–edge, and if a rest length is 0. Exception: if both rest lengths are 0 and the edges
/// were nearly parallel at the last detection (closest_points: decided exactly), e_k is the length of their overlap
/// along the first edge over the length of the shorter edge.
///
/// All shapes are legal. A *needle* has a height below 2⁻⁹ of its longest side, or an edge below 2⁻⁹ of the other edge;
/// its closest point is not known to first order. For a needle the judge also accepts any force of at most −e_k g' and
/// any block of at most e_k g'' at the exact distance; no point of the needle has a larger force or block. The limit of
/// the block is 2 e_k g'' if other vertices are updated with the vertex. d is 0 or at least 2⁻⁶³ m, whose square is a
/// normal number.
struct ContactForceCase {
  ContactSides sides = ContactSides::point_point;  ///< the faces that meet
  std::int32_t own = 0;           ///< the vertex whose force and block are returned, 0 … vertex_count(sides) − 1
  std::array<Vec3f, 4> vertex;    ///< x [m]; 0 for vertices that the sides lack
  std::array<Vec3f, 4> previous;  ///< X_prev, x at the last detection [m]; e_k uses it
  std::array<float, 2> rest_squared{};      ///< ‖ē‖², ‖ē'‖² [m²]; 0 for an edge without triangles
  float contact_radius = 0, stiffness = 0;  ///< r [m], k_c [N/m]
  ContactActivation activation = ContactActivation::ogc;  ///< g
  std::uint8_t together = 0;  ///< bit k: vertex k is updated together with vertex `own`; bit `own` is ignored
};

/// Input of the stage.
struct ContactForceIn {
  std::vector<ContactForceCase> cases;  ///< independent of each other
};

/// Largest error of the force in units of u · scale, u = 2⁻²⁴. Rounding errors on the longest way from an input to the
/// force; the largest sum decides:
///
/// - Force, up to n: a difference (1); the first edge's parameter: two cross products (4), their scalar product (3),
///   the square in its denominator (2 + 3), a quotient (1); the second edge's parameter: two scalar products (6), a
///   product, a difference, a quotient (3), the square in its denominator (3); one minus a parameter (1); the vector
///   between the contact points: a product, two sums (3); its length (3 + 1); n (2): 36.
/// - Force, in all: 36 up to n; g' (4; 10.5 for ipc_log, see activation_tolerance); its products with w and n (2):
///   48.5, rounded up.
/// - e_k: a difference, a cross product, twice (4), squares (3), ε (3), a quotient, q(2 − q), its product with k_c: 15.
/// - e_k as a share of the overlap: a difference, two scalar products (6), a quotient for each end, their difference,
///   the root of a quotient of squares (6 / 2 + 2), two products: 16.
inline constexpr double contact_force_tolerance = 49;
/// Largest error of the block in units of u · scale. Rounding errors: n (36, see contact_force_tolerance), g'' (5; with
/// ipc_log 8.5), Σ |w_u| of four vertices (3), the products of this sum with |w| and g'' (2), an outer product (2):
/// 51.5, rounded up.
inline constexpr double contact_block_tolerance = 52;
/// Largest error of a distance in units of u · scale. Rounding errors: a difference (1), a product and two sums (3),
/// squares (3), a root (1): 8. The limit is 16, since rounded weights differ slightly from those of the closest points.
/// A contact is grey if this error could change the closest feature, make d = 0 or, with ogc_as_printed, move d across
/// the jump at τ. If d may be 0, n is unknown. Then any force and block are accepted that are not larger than the right
/// ones at d = 2⁻²³ r.
inline constexpr double contact_grey = 16;

}  // namespace ogc::compare
