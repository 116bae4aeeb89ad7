// The columns of what a step sums up for its row.
#pragma once

namespace ogc::fast {

/// Sums over the mesh that a row needs, in this order.
enum SumColumn : int {
  sum_kinetic = 0,        ///< Σ m/2 ‖v‖² [J]
  sum_gravity = 1,        ///< −Σ m a·x [J]
  sum_lost = 2,           ///< Σ m (x − y), three columns [kg m]
  sum_moved = 5,          ///< Σ m (y − xᵗ), three columns [kg m]
  sum_last = 8,           ///< Σ m ‖x − x before the last sweep‖² [kg m²]
  sum_way = 9,            ///< Σ m ‖x − xᵗ‖² [kg m²]
  sum_membrane = 10,      ///< [J]
  sum_bending = 11,       ///< and of springs [J]
  sum_vertex_facet = 12,  ///< and of contacts with volumes [J]
  sum_edge_edge = 13,     ///< [J]
  sum_solid = 14,         ///< [J]
  sum_inverted = 15,      ///< tetrahedra with J ≤ 0
  sum_rod = 16,           ///< stretch, shear, bend and twist of rods [J]
  sum_stretch = 17,       ///< Σ ‖D‖/l − 1 over segments [1]
  sum_columns = 18
};
/// After the guess loop: the columns of vertices alone.
inline constexpr int guess_columns = sum_membrane;

/// Sums over free vertices of what a step leaves of forces, in this order.
enum LeftColumn : int {
  left_reference = 0,  ///< Σ ‖f*‖ [N]
  left_force = 1,      ///< Σ ‖f‖ over those that no bound holds [N]
  left_rounding = 2,   ///< how much of that rounded positions may make [N]
  left_held = 3,       ///< those that a bound holds
  left_columns = 4
};

}  // namespace ogc::fast
