// Makes small solids for cases about whole scenes, and reverses bodies that a mirroring symmetry turned inside out.
#pragma once

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Returns up to 2 × 2 × 2 cells of side `size` [m], scaled by `height` along z. Each cell has six tetrahedra about the
/// same diagonal. Vertices are moved by up to a tenth of a cell. Only a block of 2 × 2 × 2 cells has an interior
/// vertex.
Mesh jittered_block(Random& random, double size, double height);
/// Returns the boundary of a block: outward triangles, without tetrahedra or interior vertices.
Mesh jittered_surface(Random& random, double size, double height);
/// Returns the boundary of a block with cells of side 3 `size`, and in its middle a void: a box of 0.3 to 0.5 of the
/// block's size. The normals of the box point into the void; its vertices are the last eight.
Mesh jittered_hollow(Random& random, double size, double height);
/// Returns a block of 2 × 2 × 2 cells.
Mesh jittered_cube(Random& random, double size, double height);

/// Reorders the corners of volumes, and of solids at rest, that a mirroring symmetry of the cube turned inside out.
void turn_mirrored(Scene& scene);

}  // namespace ogc::compare
