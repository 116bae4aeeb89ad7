// Pairs of vertices whose faces meet where a run begins, for `ogc run --tolerate-start`. While a pair is open, a
// face of the one vertex and a face of the other are no contact; no bound keeps them apart, and they are not audited. A
// pair closes for good when no two faces that have it meet any more. So two faces that meet always have an open pair,
// and all other faces are held apart.
#pragma once

#include <vector>

#include "compare/oracle/audit.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// The pairs of one run.
class StartPairs {
 public:
  /// All that meet at these positions [m] beside what the scene leaves out itself. The scene must outlive it.
  StartPairs(const compare::Scene& scene, const std::vector<compare::Vec3f>& start);
  /// Closes the open ones of which no two faces meet here, and returns whether there was any.
  bool close_apart(const std::vector<compare::Vec3f>& positions);
  /// How many there were, and how many are open.
  std::size_t named() const { return named_; }
  std::size_t open() const { return open_.size(); }
  /// What meets at the start.
  const compare::AuditResult& at_start() const { return at_start_; }
  /// The scene in which open pairs are excluded.
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
