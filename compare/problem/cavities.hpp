// Finds the cavities of a volume of triangles (§3.9): closed shells whose normals point into a void, inside a shell
// whose normals point outward. The solid between both shells is one part.
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
  std::span<const Index> triangles;  ///< indices into the mesh's triangles
  /// enclosed volume times a positive factor, the same for all shells of the body; 0 if the shell has rims or encloses
  /// no volume
  double volume = 0;
};

/// Returns for each shell of one body the index of the shell in which it is a cavity, or −1. A shell of negative volume
/// is a cavity in the shell of positive volume that winds around all of its vertices (in the smallest of these if there
/// are several). Exception: a shell inside another cavity of the same shell is no cavity. Positions [m] are rounded to
/// single precision; then all is decided exactly. A vertex on a shell is treated as if it were beside the shell.
std::vector<int> enclosing_shells(const Mesh& mesh, std::span<const Shell> shells);

}  // namespace ogc::compare
