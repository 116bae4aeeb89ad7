// Makes small solids for cases about whole scenes, and reverses bodies that a mirroring symmetry turned inside out.
#pragma once

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Returns up to 2 × 2 × 2 cells of side `size` [m], scaled by `height` along z. Each cell is cut into six tetrahedra
/// about one diagonal, which has the same direction in all cells. Vertices are moved by up to a tenth of a cell. Only a
/// block of 2 × 2 × 2 cells has an interior vertex.
Mesh jittered_block(Random& random, double size, double height);
/// Returns the boundary of a block: outward triangles, without tetrahedra or interior vertices.
Mesh jittered_surface(Random& random, double size, double height);
/// Returns the boundary of a block with a void in its middle. The block has cells of side 3 `size`. The void is a box
/// of 0.3 to 0.5 of the block's size. The normals of the box point into the void; its vertices are the last eight.
Mesh jittered_hollow(Random& random, double size, double height);
/// Returns a block of 2 × 2 × 2 cells.
Mesh jittered_cube(Random& random, double size, double height);

/// Reorders the corners of triangles and tetrahedra of bodies whose volume a mirroring symmetry of the cube made
/// negative. Volumes of solids are those of their rest shapes.
void turn_mirrored(Scene& scene);

}  // namespace ogc::compare
