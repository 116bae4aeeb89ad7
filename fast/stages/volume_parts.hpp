// Makes the parts of a scene's volumes on the host; the facets of each part are in the order of a tree.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/scene.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// The facets of a part and its tetrahedra, if it has any, each in the order of a tree.
struct PartOrder {
  std::vector<int> facets, tetrahedra;
};
/// The parts of volumes, by number.
using VolumeParts = std::vector<PartOrder>;

/// Returns the parts of a scene's volumes in the order of their lowest-numbered triangles. Facets and tetrahedra are
/// sorted along a Hilbert curve through their rest positions: the order of a tree is the order in which a vertex's
/// contacts are added up, so that it must not depend on the state in which a scene begins (a trace begins at a later
/// one). Tetrahedra are numbered as in volume_tetrahedra.
VolumeParts volume_parts(const compare::Scene& scene, const compare::Topology& topology);

/// Returns the parts of one volume whose surface is all triangles of the topology, at `positions`. `cavities`: see
/// VolumeDepthIn.
VolumeParts volume_parts(const compare::Topology& topology, std::span<const compare::Tetrahedron> tetrahedra,
                         std::span<const compare::Edge> cavities, std::span<const compare::Vec3f> positions);

/// Returns the tetrahedra of a scene's volumes, body by body.
std::vector<compare::Tetrahedron> volume_tetrahedra(const compare::Scene& scene);

/// The vertices that are tested against volumes, by row (fast/kernels/volumes/contacts.hpp).
struct AskerRows {
  std::vector<int> askers;   ///< by row: the vertex; −1: none
  std::vector<int> slot_of;  ///< by vertex: its slot, or −1; empty if no volume is free
};

/// Returns the askers of a scene by row; no rows if the scene has no volumes. `order`: the scene's free vertices by
/// slot.
AskerRows asker_rows(const compare::Scene& scene, const compare::Topology& topology, const std::vector<int>& order);

/// The arrays of SolidView, on the host.
struct SolidTables {
  std::vector<SolidElement> elements;
  std::vector<int> offsets, items;  ///< by vertex: the tetrahedra that contain it
  std::vector<int> owner;           ///< by triangle: its tetrahedron; −1 if it has none
};

/// Returns the tables of these tetrahedra; all are empty if there are none.
SolidTables solid_tables(const compare::Topology& topology, std::span<const compare::Tetrahedron> tetrahedra);

}  // namespace ogc::fast
