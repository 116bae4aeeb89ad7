// The volumes of a scene before those who ask them: what a detection finds, in the words of the contract (§3.9).
#pragma once

#include <span>
#include <vector>

#include "compare/problem/volumes.hpp"
#include "compare/stages/volume_depth.hpp"

namespace ogc::reference {

/// All volumes of one scene.
class SceneVolumes {
 public:
  /// Of a rounded scene and its topology, which must outlive it.
  SceneVolumes(const compare::Scene& scene, const compare::Topology& topology);
  /// Whether there are any.
  bool has_any() const { return !surface_.triangles.empty(); }
  /// The contacts of all volume_askers, rounded to single precision, in canonical order, and the sheets without any
  /// way; `point` is the vertex, `triangle` and `face` are numbers of the scene. `positions`: by vertex, of all bodies
  /// [m].
  compare::VolumeDepthOut contacts(std::span<const compare::Vec3f> positions) const;

 private:
  const compare::Topology& topology_;
  compare::VolumeSurface surface_;
  std::vector<compare::Index> asking_;
  std::vector<compare::Index> own_;  ///< by who asks: the vertex of a volume that it is, or −1
  float contact_radius_;
};

}  // namespace ogc::reference
