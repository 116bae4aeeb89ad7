// Tracks pairs of vertices whose faces intersect at the start of a run, for `ogc run --tolerate-start`. While a pair is
// open, the faces of its first vertex and the faces of its second vertex make no contacts, are not separated by bounds,
// and are not audited against each other. A pair closes for good when no two of its faces intersect. Faces that
// intersect therefore always have an open pair, and all other faces are held apart.
#pragma once

#include <vector>

#include "compare/oracle/audit.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds the pairs of one run.
class StartPairs {
 public:
  /// Finds all pairs that intersect at these positions [m], except those that the scene itself excludes. The scene must
  /// outlive this object.
  StartPairs(const compare::Scene& scene, const std::vector<compare::Vec3f>& start);
  /// Closes the open pairs that have no intersecting faces at these positions. Returns whether any pair was closed.
  bool close_apart(const std::vector<compare::Vec3f>& positions);
  /// `named` returns the number of pairs at the start, `open` the number of open pairs.
  std::size_t named() const { return named_; }
  std::size_t open() const { return open_.size(); }
  /// Returns the intersections at the start.
  const compare::AuditResult& at_start() const { return at_start_; }
  /// Returns the scene in which open pairs are excluded.
  compare::Scene tolerant_scene() const;

 private:
  compare::AuditResult audit(const std::vector<compare::Vec3f>& positions) const;
  const compare::Scene& scene_;
  compare::Topology topology_;
  compare::Exclusions exclusions_;
  compare::AuditResult at_start_;
  std::vector<compare::Edge> open_;  ///< ascending
  std::size_t named_ = 0;
};

}  // namespace ogc::experiments
