// Draws blocks as triangulated boundaries that follow from the Gauss map.
#pragma once

#include <array>
#include <vector>

#include "reference/definitions/block_margins.hpp"
#include "reference/definitions/gauss_map.hpp"

namespace ogc::reference {

/// One boundary of a block as triangles over `BlockPicture::points`. If the block has no volume, the patch is the
/// surface or line to which it shrinks.
struct BlockPatch {
  BlockMargin::Kind kind = BlockMargin::Kind::sphere;  ///< kind of the boundary
  /// whether the boundary belongs to the block, as printed; open boundaries are drawn dashed (Fig. 7, 8)
  bool closed = true;
  std::vector<std::array<int, 3>> triangles;  ///< as indices of points
  std::vector<std::vector<int>> outlines;     ///< polylines around the patch
};

/// A block as triangles and curves.
struct BlockPicture {
  std::vector<std::array<double, 3>> points;  ///< [m]
  std::vector<BlockPatch> patches;            ///< empty if the face has no normals, or if it is a vertex without edges
};

/// Returns the picture of U_a with radius r [m], or of U_a^E with `edge_only`; arcs are cut into pieces of at most
/// `step` [rad].
BlockPicture block_picture(const Complex& mesh, Face face, float contact_radius, bool edge_only = false,
                           double step = 0.1);

/// Returns the boundary of N_a on the unit sphere as points in order; neighbours on an arc are at most `step` [rad]
/// apart. A closed region repeats its first point at the end.
std::vector<Unit> outline(const GaussMap& map, double step = 0.1);

}  // namespace ogc::reference
