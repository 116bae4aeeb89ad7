// What is known of the tetrahedra of volumes at rest: host code makes it (fast/stages/volume_parts.cpp).
#pragma once

namespace ogc::fast {

/// A tetrahedron and who lies behind its sides.
struct alignas(16) SolidElement {
  int corner[4];  ///< vertices
  int behind[4];  ///< by corner: the tetrahedron across the opposite side, or −1
};

}  // namespace ogc::fast
