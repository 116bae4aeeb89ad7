// Measures what is inside volumes (§3.9): vertices, by winding number, and edges that meet the volumes' triangles. This
// code shares nothing with solvers, whose stage volume_depth (compare/stages/volume_depth.hpp) uses the nearest face.
// The audit and the stage agree on closed parts that do not pass through themselves. Elsewhere they may differ.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "compare/oracle/box_tree.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

/// Holds what is inside volumes at one state. Surfaces may be inside a volume for a moment, so this alone is no
/// failure.
struct VolumePenetration {
  std::size_t vertices_inside = 0;  ///< vertices of surfaces and of free volumes that lie inside a part
  Index deepest_vertex = -1;        ///< the vertex inside a part that is farthest from the part's triangles
  double deepest = 0;               ///< its distance from them, rounded [m]
  /// number of edges that meet a triangle, of these pairs:
  /// - an edge of a surface and a triangle of a volume, or an edge of a volume and a triangle of a surface
  /// - an edge of a volume and a triangle of a volume, at least one of them of a free volume
  std::size_t edges_meeting = 0;
};

/// Audits the volumes of one scene.
class VolumeAuditor {
 public:
  /// Takes the volumes of a scene, which need not outlive the auditor. Indices must be valid, and bodies must cover the
  /// scene.
  explicit VolumeAuditor(const Scene& scene);
  /// Returns whether the scene has volumes.
  bool has_volumes() const { return !parts_.empty(); }
  /// Audits vertices that are not fixed, and edges with an end that is not fixed. Winding numbers and meetings are
  /// decided exactly, for each part separately: a connected component of triangles with its cavities, or the boundary
  /// of a body of tetrahedra. Each rim is closed by a fan of triangles about the mean of the rim's vertices. A vertex
  /// on the surface is outside.
  ///
  /// A vertex of a body of tetrahedra lies on the body's own surface. It is inside the body if a closed tetrahedron of
  /// positive volume contains it, and it is no corner of this tetrahedron. Its depth is then its distance from the
  /// triangles that share no vertex with the triangles around it. Pairs with a common vertex do not meet.
  ///
  /// The answer does not depend on the number of threads. Throws InputError if the number of positions is not that of
  /// the scene, or a position is not finite.
  VolumePenetration audit(std::span<const Vec3> positions) const;

 private:
  /// A part with closed rims.
  struct Part {
    std::vector<Triangle> triangles;      ///< indices of the scene's vertices
    std::vector<std::vector<Edge>> rims;  ///< edges of each closed rim, each reversed against its triangle
    std::vector<Tetrahedron> tetrahedra;  ///< of a body of tetrahedra
  };
  /// A vertex that may be inside a volume. `part` is the vertex's own part; −1 for vertices of surfaces.
  struct Asker {
    Index vertex, part;
  };
  /// Edges that may meet triangles, and these triangles, as indices in the topology.
  struct Meeting {
    std::vector<Index> edges, triangles;
  };
  Topology topology_;
  std::vector<Part> parts_;
  std::vector<Asker> asking_;
  std::array<Meeting, 4> meetings_;
};

}  // namespace ogc::compare
