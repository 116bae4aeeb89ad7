// A small solid for cases about whole scenes, and what a symmetry that mirrors does to bodies with an inner side.
#pragma once

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Up to 2 × 2 × 2 cells of side `size` [m], `height` times as high, each of six tetrahedra about the same diagonal; of
/// 2 × 2 × 2, and of those alone, one vertex lies inside. Vertices are moved by up to a tenth of a cell.
Mesh jittered_block(Random& random, double size, double height);
/// The boundary of such a block: triangles alone, outward, and no vertex inside.
Mesh jittered_surface(Random& random, double size, double height);
/// The same, three times as large, with a void in its middle: a box of 0.3 to 0.5 of its size, normals into it, whose
/// vertices are the last eight.
Mesh jittered_hollow(Random& random, double size, double height);
/// The block of 2 × 2 × 2 cells.
Mesh jittered_cube(Random& random, double size, double height);

/// A symmetry of the cube that mirrors leaves volumes inside out, and solids at rest: their corners are then named the
/// other way round.
void turn_mirrored(Scene& scene);

}  // namespace ogc::compare
