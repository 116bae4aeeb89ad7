// Drawings of blocks: triangulated boundaries, computed from the Gauss map. For drawing only; nothing is decided here.
#pragma once

#include <array>
#include <vector>

#include "reference/definitions/block_margins.hpp"
#include "reference/definitions/gauss_map.hpp"

namespace ogc::reference {

/// One boundary of a block as triangles over `BlockPicture::points`; a block without volume has its flat or straight
/// part as a patch.
struct BlockPatch {
  BlockMargin::Kind kind = BlockMargin::Kind::sphere;  ///< of the boundary
  bool closed = true;                                  ///< as printed; open boundaries are drawn dashed (Fig. 7, 8)
  std::vector<std::array<int, 3>> triangles;           ///< by numbers of points
  std::vector<std::vector<int>> outlines;              ///< polylines around the patch
};

/// A block as triangles and curves.
struct BlockPicture {
  std::vector<std::array<double, 3>> points;  ///< [m]
  std::vector<BlockPatch> patches;            ///< empty where the face has no normals or a vertex no edges
};

/// Returns the picture of U_a with radius r [m], or of U_a^E with `edge_only`; arcs are cut into pieces of at most
/// `step` [rad].
BlockPicture block_picture(const Complex& mesh, Face face, float contact_radius, bool edge_only = false,
                           double step = 0.1);

/// Returns the points of N_a's boundary on the unit sphere in order, arcs cut like those of the picture; a closed
/// region repeats its first point at the end.
std::vector<Unit> outline(const GaussMap& map, double step = 0.1);

}  // namespace ogc::reference
