// Makes the question of stage volume_depth for a detection of a step, from the volumes of a scene and the vertices that
// the volumes may push. Also converts answers between the indices of the scene and of the question.
#pragma once

#include <optional>
#include <string>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {

/// Owns the data that its questions view; must not move.
class VolumeQuestion {
 public:
  /// The topology of the scene must outlive this object.
  VolumeQuestion(const Scene& scene, const Topology& topology);
  VolumeQuestion(const VolumeQuestion&) = delete;
  VolumeQuestion& operator=(const VolumeQuestion&) = delete;

  /// Checks whether the scene has volumes.
  bool has_any() const { return !surface_.triangles.empty(); }
  /// Returns the vertices that are tested against volumes (volume_askers).
  const std::vector<Index>& asking() const { return asking_; }
  /// Returns the question for a scene whose vertices are at these positions.
  VolumeDepthCase at(std::span<const Vec3f> positions) const;
  /// Returns all accepted answers to the question.
  static VolumeDepthTruth truth(const VolumeDepthCase& asked, const Authority& authority);
  /// Returns the exact answer with the scene's indices, rounded.
  std::vector<VolumeContact> exact(const VolumeDepthCase& asked, const Authority& authority) const;
  /// Converts an answer from the scene's indices to the question's indices. If the answer does not fit the question,
  /// returns nothing and writes the reason into `problem`.
  std::optional<VolumeDepthOut> answer_of(const VolumeDepthOut& in_scene, std::string& problem) const;

 private:
  const Topology& topology_;
  VolumeSurface surface_;
  std::shared_ptr<const Topology> own_;
  /// tested vertices; for each, its index as a vertex of a volume, or −1 if it belongs to no volume
  std::vector<Index> asking_, asking_as_;
  float contact_radius_;
};

}  // namespace ogc::compare
