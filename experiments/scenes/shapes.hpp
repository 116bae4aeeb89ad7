// Generates the shapes from which scenes are built.
#pragma once

#include <array>

#include "compare/problem/mesh.hpp"

namespace ogc::experiments {

/// Returns a square sheet of `side` × `side` [m] in the plane y = `height`, centred on the y axis, with `count` ×
/// `count` vertices, `count` ≥ 2. Each cell has two triangles with alternating ("cross") diagonals: cell (i, j) is cut
/// from (i, j) to (i+1, j+1) if i + j is even. Vertex (i, j) has index i · count + j, where i counts along x and j
/// along z. Normals point up.
compare::Mesh grid(compare::Index count, double side, double height);

/// Returns the triangles of a sheet of `rows` × `columns` vertices, both ≥ 2, which is cut like `grid`. Vertex (i, j)
/// has index i · `columns` + j.
std::vector<compare::Triangle> cross_diagonals(compare::Index rows, compare::Index columns);

/// Returns a square ground of 4 m × 4 m at y = `height` [m]. Its triangles have at most a hundred times the area of the
/// triangles of a cloth of 1 m × 1 m with `vertices_a_side` vertices along each side.
compare::Mesh ground(compare::Index vertices_a_side, double height);

/// Returns an icosahedron after `subdivisions` divisions of every triangle into four. All 10 · 4ⁿ + 2 vertices (n =
/// `subdivisions`) lie on the sphere. Normals point outward.
compare::Mesh icosphere(int subdivisions, double radius, const compare::Vec3& centre);

/// Holds the resolution of a closed cylinder: `around` vertices in each ring, and `along` rings from end to end. Each
/// end is a disc of `cap` more rings around a centre.
struct CylinderCells {
  compare::Index around = 47, along = 16, cap = 5;  ///< number of vertices: around (along + 2 cap) + 2, here 1,224
};

/// Returns a closed cylinder about the axis along z through `centre`, from −`length`/2 to `length`/2 [m], with discs as
/// ends and outward normals. The cross-section is a polygon with `around` ≥ 3 corners on the circle, so that the mesh
/// never leaves the round cylinder. `along` ≥ 2, `cap` ≥ 0.
compare::Mesh cylinder(const CylinderCells& cells, double radius, double length, const compare::Vec3& centre);

/// Holds the resolution of a capsule: `around` vertices in each ring, `along` cells on the straight part, `cap` cells
/// from each end to the pole.
struct CapsuleCells {
  compare::Index around = 12, along = 6, cap = 3;  ///< number of vertices: around (along + 2 cap − 1) + 2
};

/// Returns a capsule: a round bar from `from` to `to` [m] that ends in half balls of `radius`. All vertices lie on the
/// round surface; normals point outward. `around` ≥ 3, `along` and `cap` ≥ 1.
compare::Mesh capsule(const CapsuleCells& cells, double radius, const compare::Vec3& from, const compare::Vec3& to);

/// Returns a closed box from corner `low` to corner `high` [m] with `cells` ≥ 1 along x, y and z. Normals point
/// outward.
compare::Mesh box(const std::array<compare::Index, 3>& cells, const compare::Vec3& low, const compare::Vec3& high);

/// Rounds coordinates to multiples of 2⁻²⁰ m, about a micrometre. Points that should coincide then do, because the
/// rounding errors of sines are gone.
compare::Vec3 tidy(const compare::Vec3& v);

}  // namespace ogc::experiments
