#include "experiments/program/runs/start_pairs.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace ogc::experiments {

StartPairs::StartPairs(const compare::Scene& scene, const std::vector<compare::Vec3f>& start)
    : scene_(scene),
      topology_(compare::build_topology(scene)),
      exclusions_(compare::exclusions(scene)),
      at_start_(audit(start)),
      open_(vertex_pairs(at_start_, topology_)),
      named_(open_.size()) {}

compare::AuditResult StartPairs::audit(const std::vector<compare::Vec3f>& positions) const {
  return compare::audit(topology_, compare::to_double(positions), exclusions_,
                        {.limit = std::numeric_limits<std::size_t>::max()});
}

bool StartPairs::close_apart(const std::vector<compare::Vec3f>& positions) {
  if (open_.empty()) return false;
  std::vector<compare::Edge> still;
  std::ranges::set_intersection(open_, vertex_pairs(audit(positions), topology_), std::back_inserter(still));
  const bool any = still.size() < open_.size();
  open_ = std::move(still);
  return any;
}

compare::Scene StartPairs::tolerant_scene() const {
  compare::Scene scene = scene_;
  scene.excluded_pairs.insert(scene.excluded_pairs.end(), open_.begin(), open_.end());
  return scene;
}

}  // namespace ogc::experiments
