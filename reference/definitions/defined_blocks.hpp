// Blocks by their definition (Eq. 7) instead of the constructive equations.
#pragma once

#include <memory>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Decides whether the foot of the perpendicular lies in the interior of the face and the connection in the cone of
/// normals, which is given by its generators. Exact, and independent of `in_block`. The points of the interior itself
/// (w = 0) belong to a block even where the face has no normals: Eq. 8 and 9 say so, Eq. 7, read literally, does not
/// (see `has_normals`).
class DefinedBlocks {
 public:
  /// Finds the normals of all faces. What the mesh views must outlive this.
  explicit DefinedBlocks(const Complex& mesh);
  ~DefinedBlocks();
  DefinedBlocks(const DefinedBlocks&) = delete;
  DefinedBlocks& operator=(const DefinedBlocks&) = delete;

  bool contains(Face face, const Vec3f& x, float contact_radius) const;            ///< x ∈ U_a, closed at r
  bool contains_edge_only(Face face, const Vec3f& x, float contact_radius) const;  ///< x ∈ U_a^E, for a vertex or edge
  bool in_contact(Face face, const Vec3f& x, float contact_radius) const;          ///< x ∈ U_a and d < r
  bool has_normals(Face face) const;                                               ///< N_a ≠ ∅

  struct Cones;
  const Cones& cones() const { return *cones_; }  ///< for exact points (defined_blocks_exact.hpp)

 private:
  std::unique_ptr<Cones> cones_;
};

}  // namespace ogc::reference
