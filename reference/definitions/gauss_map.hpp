// §3.1 as it is meant: the normals of each face by the closest-point principle, the kinds of vertices, Echeverria's
// indicatrix. Exact where something is decided; unit vectors in double where something is drawn or integrated.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

using Unit = std::array<double, 3>;  ///< of length 1 up to a rounding

/// Fig. 5, decided exactly.
enum class VertexKind : std::uint8_t {
  /// has normals, and the plane of each triangle at v leaves all neighbours on one side or on it (flat ones, corners of
  /// a sheet included)
  convex,
  mixed,   ///< has normals, but not convex
  saddle,  ///< has none: x_v is inside the convex hull of its neighbours
};
/// Which kind a vertex is; exact.
VertexKind classify(const Complex& mesh, Index vertex);

/// Whether an edge at v "remains as an edge in the convex hull of star(v)" (§3.2): the hull has a crease along it. Flat
/// edges have none.
bool is_hull_edge(const Complex& mesh, Index vertex, Index edge);

/// The normals of a face, to look at.
struct GaussMap {
  int dimension = -1;         ///< of N_a as a part of the sphere: −1 empty, 0 one or two points, 1 arcs, 2 a region
  std::vector<Unit> corners;  ///< in cyclic order for a region, in order along the arc for an arc
  bool closed = false;        ///< the whole circle or the whole sphere: `corners` only span it
};

/// N_a of a face of the surface, or with `edge_only` of M^e (§3.5).
GaussMap gauss_map(const Complex& mesh, Face face, bool edge_only = false);

/// Area of N_a on the unit sphere [sr]; 0 below dimension 2. For a convex inner vertex this is the angle deficit
/// (Gauss–Bonnet).
double solid_angle(const GaussMap& map);

/// Echeverria's polygon of a vertex: the normals of its triangles in order around it; inverted parts are kept.
struct Indicatrix {
  std::vector<Unit> normals;  ///< of its triangles, in order
  bool closed = false;        ///< false at a boundary vertex
  double area = 0;            ///< signed area enclosed [sr], the angle deficit for a closed one; 0 otherwise
};
/// Nothing where the triangles at the vertex are none, collapsed, the same one twice, or not one fan.
std::optional<Indicatrix> indicatrix(const Complex& mesh, Index vertex);

}  // namespace ogc::reference
