// §3.1 as it is meant: the normals of each face by the closest-point principle, the kinds of vertices, Echeverria's
// indicatrix. Exact where something is decided; unit vectors in double where something is drawn or integrated.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

using Unit = std::array<double, 3>;  ///< of length 1 up to a rounding

/// The kinds of Fig. 5, decided exactly.
enum class VertexKind : std::uint8_t {
  /// has normals, and the plane of each triangle at v has all neighbours on one side or on it (flat vertices and
  /// corners of a sheet included)
  convex,
  mixed,   ///< has normals, but is not convex
  saddle,  ///< has no normals: x_v is inside the convex hull of its neighbours
};
/// Returns the kind of a vertex, exactly.
VertexKind classify(const Complex& mesh, Index vertex);

/// Returns whether an edge at v "remains as an edge in the convex hull of star(v)" (§3.2): the hull has a crease along
/// it. Flat edges have none.
bool is_hull_edge(const Complex& mesh, Index vertex, Index edge);

/// The normals of a face, for drawing.
struct GaussMap {
  int dimension = -1;         ///< of N_a as a part of the sphere: −1 empty, 0 one or two points, 1 arcs, 2 a region
  std::vector<Unit> corners;  ///< in cyclic order for a region, in order along the arc for an arc
  bool closed = false;        ///< whether it is the whole circle or the whole sphere: `corners` only span it
};

/// Returns N_a of a face of the surface, or with `edge_only` of M^e (§3.5).
GaussMap gauss_map(const Complex& mesh, Face face, bool edge_only = false);

/// Returns the area of N_a on the unit sphere [sr]; 0 below dimension 2. For a convex inner vertex this is the angle
/// deficit (Gauss–Bonnet).
double solid_angle(const GaussMap& map);

/// Echeverria's polygon of a vertex: the normals of its triangles in order around it; inverted parts are kept.
struct Indicatrix {
  std::vector<Unit> normals;  ///< of the vertex's triangles, in order
  bool closed = false;        ///< false at a boundary vertex
  double area = 0;            ///< signed area enclosed [sr], the angle deficit for a closed one; 0 otherwise
};
/// Returns the indicatrix of a vertex; empty where it has no triangles, a collapsed one, the same one twice, or more
/// than one fan.
std::optional<Indicatrix> indicatrix(const Complex& mesh, Index vertex);

}  // namespace ogc::reference
