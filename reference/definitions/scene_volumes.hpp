// Finds the contacts of a scene's volumes with all vertices that are tested against them (§3.9), as a VolumeDepthOut.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/volumes.hpp"
#include "compare/stages/volume_depth.hpp"

namespace ogc::reference {

/// All volumes of one scene.
class SceneVolumes {
 public:
  /// The scene must be rounded; scene and topology must outlive this.
  SceneVolumes(const compare::Scene& scene, const compare::Topology& topology);
  /// Returns whether the scene has volumes.
  bool has_any() const { return !surface_.triangles.empty(); }
  /// Returns the contacts and the unresolved sheets (VolumeDepthOut) of all volume_askers, the vertices that are tested
  /// against volumes. Contacts are sorted and rounded to single precision. `point` is the vertex; `triangle` and `face`
  /// are indices in the scene. `positions` [m] are by vertex of the scene.
  compare::VolumeDepthOut contacts(std::span<const compare::Vec3f> positions) const;

 private:
  const compare::Topology& topology_;
  compare::VolumeSurface surface_;
  std::vector<compare::Index> asking_;
  std::vector<compare::Index> own_;  ///< by asker: its own vertex if it belongs to a volume, otherwise −1
  float contact_radius_;
};

}  // namespace ogc::reference
