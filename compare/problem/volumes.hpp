// Volumes (§3.9): bodies that others may enter, and that push them out. What they are called, which surfaces they have,
// and what makes a surface one that has an inner side.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/problem/validate.hpp"

namespace ogc::compare {

/// A part of a volume, which is asked by itself: a connected component of its surface, or of its tetrahedra, with its
/// cavities (compare/problem/cavities.hpp). Triangles that share a vertex are connected.
struct VolumePart {
  std::size_t body = 0;          ///< whose part it is
  std::vector<Index> triangles;  ///< of the scene, ascending
  std::vector<Edge> rims;        ///< edges of one triangle, in its sense, by triangle, then corner
};

/// The parts of all volumes of a scene, by body, then by their first triangle. Indices are valid, and bodies cover the
/// scene.
std::vector<VolumePart> volume_parts(const Scene& scene);

/// The cavities of a scene's volumes of triangles, as VolumeDepthIn::cavities has them: of each a vertex of its own and
/// one of the surface whose cavity it is.
std::vector<Edge> volume_cavities(const Scene& scene);

/// The surfaces of all volumes of a scene as one question of the stage volume_depth: vertices keep their numbers.
struct VolumeSurface {
  Topology topology;                    ///< of their triangles alone
  std::vector<Index> triangles;         ///< by triangle there: its number in the scene, ascending
  std::vector<Tetrahedron> tetrahedra;  ///< of those volumes that have any, body by body
  std::vector<Edge> cavities;           ///< volume_cavities
};

/// Of a scene without volumes: no triangle. Indices are valid, and bodies cover the scene.
VolumeSurface volume_surface(const Scene& scene);

/// A face there as one of the scene, whose topology is `scene`; the order of faces is the same.
Face scene_face(const VolumeSurface& volumes, const Topology& scene, const Face& face);

/// Whether any body is a volume.
bool has_volumes(const Scene& scene);

/// By vertex: whether its body is a volume.
std::vector<bool> volume_flags(const Scene& scene);

/// By body: whether it is a *free* volume, some of whose vertices no motion moves; those of tetrahedra may be.
std::vector<bool> free_volumes(const Scene& scene);

/// Who asks all volumes at each detection, ascending: the free vertices of surfaces and those on the boundary of free
/// volumes. Where there is a free volume, prescribed ones ask as well, as they may push it. `topology`: of the scene.
std::vector<Index> volume_askers(const Scene& scene, const Topology& topology);

/// What is wrong with the scene's volumes, body by body: loose edges, none or free triangles without tetrahedra, edges
/// of three triangles or of two that run through it in one sense, parts that are inside out or enclose nothing.
/// Indices are valid, and bodies cover the scene; coordinates may be bad.
void check_volume_bodies(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names,
                         std::size_t limit);

/// Throws InputError that names the scene's first volume, if it has any: `solver` does not simulate them, and
/// `remedy` says what to do.
void refuse_volumes(const Scene& scene, std::string_view solver, std::string_view remedy);

}  // namespace ogc::compare
