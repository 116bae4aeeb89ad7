// Finds the volumes (§3.9) of a scene: bodies that push out vertices that enter them. Lists their parts and surfaces,
// and checks that each surface has an inner side.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/problem/validate.hpp"

namespace ogc::compare {

/// A part of a volume, which stages treat separately: a connected component of its surface, or of its tetrahedra, with
/// its cavities (compare/problem/cavities.hpp). Triangles that share a vertex are connected.
struct VolumePart {
  std::size_t body = 0;          ///< number of its body
  std::vector<Index> triangles;  ///< numbers in the scene, ascending
  std::vector<Edge> rims;        ///< edges of one triangle each, directed as in this triangle, by triangle, then corner
};

/// Returns the parts of all volumes of a scene, by body, then by first triangle. Indices must be valid, and bodies must
/// cover the scene.
std::vector<VolumePart> volume_parts(const Scene& scene);

/// Returns the cavities of all volumes of triangles as VolumeDepthIn::cavities holds them: for each cavity one of its
/// vertices and one vertex of the surface around it.
std::vector<Edge> volume_cavities(const Scene& scene);

/// Holds the surfaces of all volumes of a scene as one input of stage volume_depth; vertices keep their numbers.
struct VolumeSurface {
  Topology topology;                    ///< topology of the volumes' triangles alone
  std::vector<Index> triangles;         ///< number in the scene of each triangle, ascending
  std::vector<Tetrahedron> tetrahedra;  ///< tetrahedra of all volumes that have any, body by body
  std::vector<Edge> cavities;           ///< as volume_cavities returns them
};

/// Returns the surface of all volumes; it has no triangles if the scene has no volumes. Indices must be valid, and
/// bodies must cover the scene.
VolumeSurface volume_surface(const Scene& scene);

/// Returns the scene's face with the same vertices as `face`, a face of `volumes`. `scene` is the topology of the
/// scene.
Face scene_face(const VolumeSurface& volumes, const Topology& scene, const Face& face);

/// Returns whether any body is a volume.
bool has_volumes(const Scene& scene);

/// Returns for each vertex whether its body is a volume.
std::vector<bool> volume_flags(const Scene& scene);

/// Returns for each body whether it is a *free* volume, that is, a volume with vertices that no motion moves. Only
/// volumes of tetrahedra may be free.
std::vector<bool> free_volumes(const Scene& scene);

/// Returns the vertices that each detection tests against all volumes, ascending: the free vertices of surfaces and
/// those on the boundary of free volumes. If there is a free volume, prescribed vertices are tested, too, since they
/// may push it. `topology` is that of the scene.
std::vector<Index> volume_askers(const Scene& scene, const Topology& topology);

/// Adds the problems of the scene's volumes, body by body: loose edges; no triangles; free triangles without
/// tetrahedra; edges of three triangles; edges that two triangles run through in the same direction; parts that are
/// inside out or enclose no volume. Indices must be valid, and bodies must cover the scene; coordinates may be bad.
void check_volume_bodies(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names,
                         std::size_t limit);

/// Throws InputError that names the scene's first volume if it has any, because `solver` does not simulate volumes.
/// `remedy` tells the user what to do.
void refuse_volumes(const Scene& scene, std::string_view solver, std::string_view remedy);

}  // namespace ogc::compare
