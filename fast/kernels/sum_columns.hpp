// Names the columns of a step's sums.
#pragma once

namespace ogc::fast {

/// Columns of the sums over the mesh that a step reports.
enum SumColumn : int {
  sum_kinetic = 0,        ///< Σ m/2 ‖v‖² [J]
  sum_gravity = 1,        ///< −Σ m a·x [J]
  sum_lost = 2,           ///< Σ m (x − y), three columns [kg m]
  sum_moved = 5,          ///< Σ m (y − xᵗ), three columns [kg m]
  sum_last = 8,           ///< Σ m ‖x − x before the last sweep‖² [kg m²]
  sum_way = 9,            ///< Σ m ‖x − xᵗ‖² [kg m²]
  sum_membrane = 10,      ///< energy of triangles [J]
  sum_bending = 11,       ///< energy of hinges and springs [J]
  sum_vertex_facet = 12,  ///< energy of vertex–facet contacts and contacts with volumes [J]
  sum_edge_edge = 13,     ///< energy of edge–edge contacts [J]
  sum_solid = 14,         ///< energy of tetrahedra [J]
  sum_inverted = 15,      ///< tetrahedra with J ≤ 0
  sum_rod = 16,           ///< stretch, shear, bend and twist of rods [J]
  sum_stretch = 17,       ///< Σ ‖D‖/l − 1 over segments [1]
  sum_columns = 18
};
/// Number of columns that are summed after the guess loop: the columns of vertices, which come first.
inline constexpr int guess_columns = sum_membrane;

/// Columns of the sums over free vertices that give the residual of a step (Eq. 29).
enum LeftColumn : int {
  left_reference = 0,  ///< Σ ‖f*‖ [N]
  left_force = 1,      ///< Σ ‖f‖ over vertices that no bound holds [N]
  left_rounding = 2,   ///< bound of the part of left_force that rounded positions cause [N]
  left_held = 3,       ///< number of vertices that a bound holds
  left_columns = 4
};

}  // namespace ogc::fast
