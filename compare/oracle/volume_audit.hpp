// What volumes let in (§3.9): vertices inside by winding number, edges that meet their triangles, found by the oracle
// alone. A solver's own answer (compare/stages/volume_depth.hpp) asks the nearest face; the two agree on closed parts
// that do not pass through themselves, and each is what it is elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "compare/oracle/box_tree.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

/// What is inside at one state. Surfaces pass a volume for a moment: none of it is a failure by itself.
struct VolumePenetration {
  std::size_t vertices_inside = 0;  ///< vertices of surfaces and of free volumes that lie in some part
  Index deepest_vertex = -1;        ///< of them the one farthest from the triangles of a part that holds it
  double deepest = 0;               ///< that distance, rounded [m]
  /// edges of surfaces that meet a triangle of a volume, edges of volumes that meet a triangle of a surface, and, where
  /// one of both bodies is a free volume, edges of volumes that meet a triangle of one, itself included
  std::size_t edges_meeting = 0;
};

/// The volumes of one scene.
class VolumeAuditor {
 public:
  /// Valid indices; bodies cover the scene, which need not outlive it.
  explicit VolumeAuditor(const Scene& scene);
  /// Whether there are any.
  bool has_volumes() const { return !parts_.empty(); }
  /// Of vertices that are not fixed, and of edges of which an end is not. Winding numbers and meetings are decided
  /// without rounding, each part by itself: a connected component of triangles with its cavities, or the boundary of a
  /// body of tetrahedra. Of a part with rims each rim is closed by a fan about the mean of its ends. A vertex on the
  /// surface is outside.
  ///
  /// A vertex of a body of tetrahedra lies on its surface, and in the body itself where one of its tetrahedra of
  /// positive volume, without this vertex, holds it, its surface included; its distance is then that to triangles which
  /// have no vertex in common with those around it. Pairs with a common vertex do not meet.
  ///
  /// Does not depend on the number of threads. Throws InputError where positions are not of the scene, or not finite.
  VolumePenetration audit(std::span<const Vec3> positions) const;

 private:
  /// A part, its rims closed.
  struct Part {
    std::vector<Triangle> triangles;      ///< by vertices of the scene
    std::vector<std::vector<Edge>> rims;  ///< by closed rim: its edges as the missing triangles run through them
    std::vector<Tetrahedron> tetrahedra;  ///< of a body that has any
  };
  /// Who may be inside, and the part that it is of; −1: of a surface.
  struct Asker {
    Index vertex, part;
  };
  /// Edges that may meet triangles, by their numbers in the topology.
  struct Meeting {
    std::vector<Index> edges, triangles;
  };
  Topology topology_;
  std::vector<Part> parts_;
  std::vector<Asker> asking_;
  std::array<Meeting, 4> meetings_;
};

}  // namespace ogc::compare
