// Computes the normals of each face by the closest-point principle, as §3.1 intends, the kinds of vertices, and
// Echeverria's indicatrix. Decisions are exact; unit vectors for drawing and integrals are in double.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

using Unit = std::array<double, 3>;  ///< unit vector, up to rounding

/// The kinds of vertices of Fig. 5.
enum class VertexKind : std::uint8_t {
  /// has normals, and all neighbours of v lie on one side of the plane of each triangle at v, or on the plane (includes
  /// flat vertices and corners of a sheet)
  convex,
  mixed,   ///< has normals, but is not convex
  saddle,  ///< has no normals: x_v is inside the convex hull of its neighbours
};
/// Returns the kind of a vertex, exactly.
VertexKind classify(const Complex& mesh, Index vertex);

/// Returns whether an edge at v "remains as an edge in the convex hull of star(v)" (§3.2): the hull has a crease along
/// it. A flat edge has no crease.
bool is_hull_edge(const Complex& mesh, Index vertex, Index edge);

/// The normals of a face, for drawing.
struct GaussMap {
  int dimension = -1;         ///< dimension of N_a on the sphere: −1 empty, 0 one or two points, 1 arcs, 2 a region
  std::vector<Unit> corners;  ///< corners of N_a in order: around a region, or along an arc
  bool closed = false;  ///< true if N_a is the whole circle or the whole sphere; `corners` are then its generators
};

/// Returns N_a of a face of the surface, or with `edge_only` of M^e (§3.5).
GaussMap gauss_map(const Complex& mesh, Face face, bool edge_only = false);

/// Returns the area of N_a on the unit sphere [sr]; 0 below dimension 2. For a convex inner vertex this is the angle
/// deficit (Gauss–Bonnet).
double solid_angle(const GaussMap& map);

/// Echeverria's polygon of a vertex: the normals of its triangles in order around it. The polygon may have parts of
/// negative area.
struct Indicatrix {
  std::vector<Unit> normals;  ///< normals of the vertex's triangles, in order
  bool closed = false;        ///< false at a boundary vertex
  double area = 0;            ///< signed enclosed area [sr], which is the angle deficit; 0 if not closed
};
/// Returns the indicatrix of a vertex. Empty if the vertex has no triangles, a collapsed triangle, the same triangle
/// twice, or triangles in more than one fan.
std::optional<Indicatrix> indicatrix(const Complex& mesh, Index vertex);

}  // namespace ogc::reference
