// Names the columns of a step's sums.
#pragma once

namespace ogc::fast {

/// Sums over the mesh for the row of a step, in this order.
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
/// The sums after the guess loop: only columns of vertices.
inline constexpr int guess_columns = sum_membrane;

/// Sums over free vertices of the forces that a step leaves, in this order.
enum LeftColumn : int {
  left_reference = 0,  ///< Σ ‖f*‖ [N]
  left_force = 1,      ///< Σ ‖f‖ over vertices that no bound holds [N]
  left_rounding = 2,   ///< largest part of left_force that rounded positions may cause [N]
  left_held = 3,       ///< number of vertices that a bound holds
  left_columns = 4
};

}  // namespace ogc::fast
