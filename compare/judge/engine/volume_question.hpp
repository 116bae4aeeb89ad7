// The volumes of a scene before its free vertices, as the question of the stage volume_depth that a step asks with each
// detection; and its answers in the scene's numbers.
#pragma once

#include <optional>
#include <string>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

/// Owns what its questions look at; must stay where it is.
class VolumeQuestion {
 public:
  /// `topology`: of the scene; must outlive it.
  VolumeQuestion(const Scene& scene, const Topology& topology);
  VolumeQuestion(const VolumeQuestion&) = delete;
  VolumeQuestion& operator=(const VolumeQuestion&) = delete;

  /// Whether there are any volumes.
  bool has_any() const { return !surface_.triangles.empty(); }
  /// Who asks: volume_askers.
  const std::vector<Index>& asking() const { return asking_; }
  /// Asked at these positions of all vertices of the scene.
  VolumeDepthCase at(std::span<const Vec3f> positions) const;
  /// All accepted answers.
  static VolumeDepthTruth truth(const VolumeDepthCase& asked, const Authority& authority);
  /// The exact answer in the scene's numbers, rounded.
  std::vector<VolumeContact> exact(const VolumeDepthCase& asked, const Authority& authority) const;
  /// An answer in the scene's numbers as one to the question; empty, with the reason, where it is none.
  std::optional<VolumeDepthOut> answer_of(const VolumeDepthOut& in_scene, std::string& problem) const;

 private:
  const Topology& topology_;
  VolumeSurface surface_;
  std::shared_ptr<const Topology> own_;
  std::vector<Index> asking_, asking_as_;  ///< `asking_as_`: the vertex of a volume that each is, or −1
  float contact_radius_;
};

}  // namespace ogc::compare
