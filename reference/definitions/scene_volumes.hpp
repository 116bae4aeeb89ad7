// The volumes of a scene before its free vertices: what a detection finds, in the words of the contract (§3.9).
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
  /// The contacts of all free vertices of surfaces, rounded to single precision, in canonical order; `point` is the
  /// vertex, `triangle` and `face` are numbers of the scene. `positions`: by vertex, of all bodies [m].
  std::vector<compare::VolumeContact> contacts(std::span<const compare::Vec3f> positions) const;

 private:
  const compare::Topology& topology_;
  compare::VolumeSurface surface_;
  std::vector<compare::Index> asking_;
  float contact_radius_;
};

}  // namespace ogc::reference
