// Measures what volumes let in (§3.9): vertices inside by winding number, and edges that meet their triangles, found by
// the oracle alone. A solver's own answer (compare/stages/volume_depth.hpp) uses the nearest face; the two agree on
// closed parts that do not pass through themselves, and may differ elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "compare/oracle/box_tree.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

/// What is inside at one state. Surfaces may be in a volume for a moment, so nothing of this is a failure by itself.
struct VolumePenetration {
  std::size_t vertices_inside = 0;  ///< vertices of surfaces and of free volumes that lie in some part
  Index deepest_vertex = -1;        ///< the one of them farthest from the triangles of a part that holds it
  double deepest = 0;               ///< that distance, rounded [m]
  /// edges of surfaces that meet a triangle of a volume, edges of volumes that meet a triangle of a surface, and, if
  /// one of the two bodies is a free volume, edges of volumes that meet a triangle of a volume, their own included
  std::size_t edges_meeting = 0;
};

/// Audits the volumes of one scene.
class VolumeAuditor {
 public:
  /// Takes the volumes of a scene, which need not outlive the auditor. Indices are valid; bodies cover the scene.
  explicit VolumeAuditor(const Scene& scene);
  /// Returns whether there are any.
  bool has_volumes() const { return !parts_.empty(); }
  /// Audits vertices that are not fixed, and edges with an end that is not fixed. Winding numbers and meetings are
  /// decided without rounding, for each part by itself: a connected component of triangles with its cavities, or the
  /// boundary of a body of tetrahedra. Each rim is closed by a fan about the mean of its vertices. A vertex on the
  /// surface is outside.
  ///
  /// A vertex of a body of tetrahedra lies on its surface, and in the body itself if one of its tetrahedra of positive
  /// volume, without this vertex, holds it, its surface included; its distance is then taken to triangles that have no
  /// vertex in common with those around it. Pairs with a common vertex do not meet.
  ///
  /// The answer does not depend on the number of threads. Throws InputError if positions are not of the scene, or not
  /// finite.
  VolumePenetration audit(std::span<const Vec3> positions) const;

 private:
  /// A part with closed rims.
  struct Part {
    std::vector<Triangle> triangles;      ///< vertex numbers of the scene
    std::vector<std::vector<Edge>> rims;  ///< for each closed rim its edges in the sense of the missing triangles
    std::vector<Tetrahedron> tetrahedra;  ///< of a body of tetrahedra
  };
  /// A vertex that may be inside a volume, and the part to which it belongs; −1 if it belongs to a surface.
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
