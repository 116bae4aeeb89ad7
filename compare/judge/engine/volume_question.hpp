// Makes the question of stage volume_depth that a step asks with each detection, from the volumes of a scene and the
// vertices that they may push; takes its answers back to the scene's numbers.
#pragma once

#include <optional>
#include <string>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

/// Owns what its questions point to; must not move.
class VolumeQuestion {
 public:
  /// Takes the topology of the scene, which must outlive this object.
  VolumeQuestion(const Scene& scene, const Topology& topology);
  VolumeQuestion(const VolumeQuestion&) = delete;
  VolumeQuestion& operator=(const VolumeQuestion&) = delete;

  /// Checks whether there are any volumes.
  bool has_any() const { return !surface_.triangles.empty(); }
  /// Returns the vertices that ask (volume_askers).
  const std::vector<Index>& asking() const { return asking_; }
  /// Returns the question with all vertices of the scene at these positions.
  VolumeDepthCase at(std::span<const Vec3f> positions) const;
  /// Returns all accepted answers.
  static VolumeDepthTruth truth(const VolumeDepthCase& asked, const Authority& authority);
  /// Returns the exact answer in the scene's numbers, rounded.
  std::vector<VolumeContact> exact(const VolumeDepthCase& asked, const Authority& authority) const;
  /// Takes an answer in the scene's numbers to the question's; empty, with the reason in `problem`, where it is no
  /// answer to the question.
  std::optional<VolumeDepthOut> answer_of(const VolumeDepthOut& in_scene, std::string& problem) const;

 private:
  const Topology& topology_;
  VolumeSurface surface_;
  std::shared_ptr<const Topology> own_;
  std::vector<Index> asking_, asking_as_;  ///< `asking_as_`: the vertex of a volume that each of them is, or −1
  float contact_radius_;
};

}  // namespace ogc::compare
