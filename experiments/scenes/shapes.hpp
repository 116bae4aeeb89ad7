// The shapes that scenes are built from.
#pragma once

#include "compare/problem/mesh.hpp"

namespace ogc::experiments {

/// Square sheet in the plane y = `height`, centred on the y axis: `count` × `count` vertices [1] on `side` × `side` [m], two triangles a cell with
/// alternating ("cross") diagonals: cell (i, j) is cut from (i, j) to (i+1, j+1) where i + j is even. Vertex (i, j) has number i · count + j; i counts
/// along x, j along z; normals point up. `count` ≥ 2.
compare::Mesh grid(compare::Index count, double side, double height);

/// Icosahedron whose triangles are split in four `subdivisions` times, with every vertex on the sphere; outward normals; 10 · 4ⁿ + 2 vertices.
compare::Mesh icosphere(int subdivisions, double radius, const compare::Vec3& centre);

}  // namespace ogc::experiments
