// Decides block membership by the definition (Eq. 7) instead of the half-spaces of Eq. 8–10.
#pragma once

#include <memory>

#include "reference/geometry/blocks.hpp"

namespace ogc::reference {

/// Tests Eq. 7 exactly, independently of `in_block`. The foot of the perpendicular from x must lie in the interior of
/// the face, and x minus the foot must lie in the cone of normals. Points of the interior itself belong to the block
/// even if the face has no normals (`has_normals`). Eq. 8 and 9 include these points; Eq. 7 read literally does not.
class DefinedBlocks {
 public:
  /// Finds the normals of all faces. Holds a view of the mesh, whose owner must outlive this.
  explicit DefinedBlocks(const Complex& mesh);
  ~DefinedBlocks();
  DefinedBlocks(const DefinedBlocks&) = delete;
  DefinedBlocks& operator=(const DefinedBlocks&) = delete;

  bool contains(Face face, const Vec3f& x, float contact_radius) const;            ///< x ∈ U_a, closed at r
  bool contains_edge_only(Face face, const Vec3f& x, float contact_radius) const;  ///< x ∈ U_a^E, for a vertex or edge
  bool in_contact(Face face, const Vec3f& x, float contact_radius) const;          ///< x ∈ U_a and d < r
  bool has_normals(Face face) const;                                               ///< N_a ≠ ∅

  struct Cones;
  /// the cones of normals, for tests of points that are fractions (defined_blocks_exact.hpp)
  const Cones& cones() const { return *cones_; }

 private:
  std::unique_ptr<Cones> cones_;
};

}  // namespace ogc::reference
