// Generates the shapes from which scenes are built.
#pragma once

#include <array>

#include "compare/problem/mesh.hpp"

namespace ogc::experiments {

/// Returns a square sheet in the plane y = `height`, centred on the y axis: `count` × `count` vertices [1] on `side` ×
/// `side` [m], two triangles a cell with alternating ("cross") diagonals: cell (i, j) is cut from (i, j) to (i+1, j+1)
/// where i + j is even. Vertex (i, j) has number i · count + j; i counts along x, j along z; normals point up. `count`
/// ≥ 2.
compare::Mesh grid(compare::Index count, double side, double height);

/// Returns the triangles of a sheet like that with `rows` × `columns` vertices; vertex (i, j) has number i · `columns`
/// + j. Both ≥ 2.
std::vector<compare::Triangle> cross_diagonals(compare::Index rows, compare::Index columns);

/// Returns a ground of 4 m × 4 m at `height` [m] for a cloth of 1 m with `vertices_a_side`; its triangles are at most a
/// hundred times as large as the cloth's.
compare::Mesh ground(compare::Index vertices_a_side, double height);

/// Returns an icosahedron whose triangles are split in four `subdivisions` times, with every vertex on the sphere;
/// outward normals; 10 · 4ⁿ + 2 vertices.
compare::Mesh icosphere(int subdivisions, double radius, const compare::Vec3& centre);

/// Holds the resolution of a closed cylinder: `around` vertices a ring, `along` rings from end to end, `cap` rings
/// inside each end besides its centre.
struct CylinderCells {
  compare::Index around = 47, along = 16, cap = 5;  ///< around (along + 2 cap) + 2 vertices: 1,224
};

/// Returns a closed cylinder about an axis through `centre` along z: rings from −`length`/2 to `length`/2 [m], ends as
/// discs; outward normals. Its cross-section is a polygon of `around` ≥ 3 corners on the circle, so that the surface
/// never leaves the round cylinder; `along` ≥ 2, `cap` ≥ 0.
compare::Mesh cylinder(const CylinderCells& cells, double radius, double length, const compare::Vec3& centre);

/// Holds the resolution of a capsule: `around` vertices a ring, `along` cells of its straight part, `cap` cells from
/// its end to its pole.
struct CapsuleCells {
  compare::Index around = 12, along = 6, cap = 3;  ///< around (along + 2 cap − 1) + 2 vertices
};

/// Returns a closed round bar from `from` to `to` [m] with half balls of `radius` as ends; outward normals, every
/// vertex on the surface. `around` ≥ 3, the others ≥ 1.
compare::Mesh capsule(const CapsuleCells& cells, double radius, const compare::Vec3& from, const compare::Vec3& to);

/// Returns a closed box from corner `low` to corner `high` [m] in `cells` along x, y and z, each ≥ 1; outward normals.
compare::Mesh box(const std::array<compare::Index, 3>& cells, const compare::Vec3& low, const compare::Vec3& high);

/// Rounds coordinates to multiples of 2⁻²⁰ m, about a micrometre. This removes the last bits of sines, so that places
/// that should coincide do.
compare::Vec3 tidy(const compare::Vec3& v);

}  // namespace ogc::experiments
