// Cavities of a volume of triangles (§3.9): closed shells whose normals point into a void, within a shell that faces
// outward. The solid between them is one part.
//
//        + + + + + + + + +      +  the shell of a part, normals outward
//        +  - - - - - -  +      -  a cavity of it, normals into the void
//        +  -  + + +  -  +      an island in the void is a part of its own, and may have cavities
//        +  -  + + +  -  +
//        +  - - - - - -  +
//        + + + + + + + + +
#pragma once

#include <span>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// A connected component of a body's triangles.
struct Shell {
  std::span<const Index> triangles;  ///< of the mesh
  double volume = 0;                 ///< that it encloses, times any positive factor; 0 where it has rims, or none
};

/// By shell of one body: the shell whose cavity it is, or −1. A shell of negative volume is a cavity of that of
/// positive volume that winds around all of its vertices, of several the one of least volume, unless another cavity of
/// the same one does, too: a void in a void is none. Decided without rounding, of positions [m] rounded to single
/// precision; a vertex on a shell counts as one beside it.
std::vector<int> enclosing_shells(const Mesh& mesh, std::span<const Shell> shells);

}  // namespace ogc::compare
