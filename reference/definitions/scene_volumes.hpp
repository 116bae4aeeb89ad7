// The volumes of a scene and the vertices that they are tested against: their contacts in a detection, in the form of
// the contract (§3.9).
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
  /// Returns the contacts of all volume_askers, rounded to single precision, in canonical order, and the sheets without
  /// any way; `point` is the vertex, `triangle` and `face` are numbers of the scene. `positions`: by vertex, of all
  /// bodies [m].
  compare::VolumeDepthOut contacts(std::span<const compare::Vec3f> positions) const;

 private:
  const compare::Topology& topology_;
  compare::VolumeSurface surface_;
  std::vector<compare::Index> asking_;
  std::vector<compare::Index> own_;  ///< by asker: its vertex if it belongs to a volume, or −1
  float contact_radius_;
};

}  // namespace ogc::reference
