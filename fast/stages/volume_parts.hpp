// The parts of a scene's volumes, each with its facets in the order of a tree: made on the host.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/scene.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// A part: its facets and its tetrahedra, if it has any, each in the order of a tree.
struct PartOrder {
  std::vector<int> facets, tetrahedra;
};
/// The parts of volumes.
using VolumeParts = std::vector<PartOrder>;

/// Returns the parts of a scene's volumes in the order of their lowest-numbered triangles; facets and tetrahedra lie
/// along a Hilbert curve at the scene's start. Tetrahedra are numbered as volume_tetrahedra lists them.
VolumeParts volume_parts(const compare::Scene& scene, const compare::Topology& topology);

/// Returns the parts of one volume that has all triangles of the topology, at `positions`. `cavities`: as in
/// VolumeDepthIn.
VolumeParts volume_parts(const compare::Topology& topology, std::span<const compare::Tetrahedron> tetrahedra,
                         std::span<const compare::Edge> cavities, std::span<const compare::Vec3f> positions);

/// Returns the tetrahedra of a scene's volumes, body by body.
std::vector<compare::Tetrahedron> volume_tetrahedra(const compare::Scene& scene);

/// The vertices that are tested against volumes, by row (fast/kernels/volumes/contacts.hpp).
struct AskerRows {
  std::vector<int> askers;   ///< by row: the vertex; −1: nobody
  std::vector<int> slot_of;  ///< by vertex: its slot, or −1; empty where no volume is free
};

/// Returns the rows of a scene, none if it has no volumes. `order`: its free vertices by slot.
AskerRows asker_rows(const compare::Scene& scene, const compare::Topology& topology, const std::vector<int>& order);

/// The arrays of SolidView, on the host.
struct SolidTables {
  std::vector<SolidElement> elements;
  std::vector<int> offsets, items;  ///< by vertex: tetrahedra that contain it
  std::vector<int> owner;           ///< by triangle; −1 where it is of no tetrahedron
};

/// Returns the tables of these tetrahedra; all are empty if there are none.
SolidTables solid_tables(const compare::Topology& topology, std::span<const compare::Tetrahedron> tetrahedra);

}  // namespace ogc::fast
