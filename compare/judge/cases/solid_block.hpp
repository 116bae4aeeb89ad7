// Makes a small solid for cases about whole scenes, and corrects bodies with an inner side after a symmetry that
// mirrors.
#pragma once

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Returns up to 2 × 2 × 2 cells of side `size` [m], `height` times as high, each of six tetrahedra about the same
/// diagonal. Only a block of 2 × 2 × 2 cells has a vertex inside. Vertices are moved by up to a tenth of a cell.
Mesh jittered_block(Random& random, double size, double height);
/// Returns the boundary of a block: triangles alone, outward, and no vertex inside.
Mesh jittered_surface(Random& random, double size, double height);
/// Returns a boundary three times as large, with a void in its middle: a box of 0.3 to 0.5 of its size, normals into
/// it, whose vertices are the last eight.
Mesh jittered_hollow(Random& random, double size, double height);
/// Returns the block of 2 × 2 × 2 cells.
Mesh jittered_cube(Random& random, double size, double height);

/// Renames the corners of volumes, and of solids at rest, that a mirroring symmetry of the cube has turned inside out.
void turn_mirrored(Scene& scene);

}  // namespace ogc::compare
